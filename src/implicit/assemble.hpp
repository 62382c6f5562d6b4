// The global equations of a step: K^ = (2/h^2 + 2a/h) M + (2/h) D + K (Eq. 11) with the elastic,
// boundary and contact springs of Eqs. 26-36, and what is out of balance at a trial position.
#pragma once

#include "implicit/newmark.hpp"

namespace edda {

/// Rows for the free blocks; pattern of the matrix from the faces that may carry.
void set_pattern(ImplicitSolver& solver, const ImplicitScene& scene, const State& state,
                 const FaceSet& faces);

/// The same for a pattern and rows that are known.
void lay_out(ImplicitSolver& solver, const ImplicitScene& scene,
             const std::vector<std::vector<Id>>& columns);

/// Fills the matrix. False if a face has come to carry that the pattern does not know.
bool assemble(ImplicitSolver& solver, const ImplicitScene& scene, const ImplicitSettings& settings,
              const State& state, const Pose& pose, const FaceSet& faces);

/// Forces of the viscous strain of the block in that row at its trial position, N; none without
/// dynamics.
Vector6 viscous_force(const ImplicitSolver& solver, const BlockSet& blocks,
                      const ImplicitSettings& settings, const State& state, std::size_t row);

/// residual = f(x_n + D) - M (2 D/h^2 - 2 v_n/h) - a M (2 D/h - v_n), N, f with that of the viscous
/// strain. Returns the largest of a
/// block over what it may be: 1 and less is in balance; NaN where a block has lost its shape.
double measure_residual(ImplicitSolver& solver, const ImplicitScene& scene,
                        const ImplicitSettings& settings, const State& state, const FaceSet& faces,
                        const NodalForces& forces);

}  // namespace edda
