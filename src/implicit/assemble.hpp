// The global equations of a step: K^ = (2/h^2 + 2a/h) M + D/h + K (Eq. 11) with the elastic,
// boundary and contact springs of Eqs. 26-36, and the residual at a trial position. Theory,
// section 12.1.
#pragma once

#include "implicit/newmark.hpp"

namespace edda {

/// Assigns rows to the free blocks, and sets the pattern of the matrix from the faces that may
/// carry load.
void set_pattern(ImplicitSolver& solver, const ImplicitScene& scene, const State& state,
                 const Pose& pose, const TrialFaces& faces);

/// Allocates the matrix for a given pattern, and computes the matrices of the blocks.
void lay_out(ImplicitSolver& solver, const ImplicitScene& scene,
             const std::vector<std::vector<Id>>& columns);

/// Fills the matrix. Returns false if a face carries load that is not in the pattern.
bool assemble(ImplicitSolver& solver, const ImplicitScene& scene, const ImplicitSettings& settings,
              const State& state, const Pose& pose, const FaceSet& faces);

/// residual = f(x_n + D) - M (2 D/h^2 - 2 v_n/h) - a M (2 D/h - v_n), N, with the viscous force
/// included in f. Returns the largest ratio of the residual to its tolerance, of single blocks and
/// of all together: up to 1 the step is in balance; NaN where a block has lost its shape.
double measure_residual(ImplicitSolver& solver, const ImplicitScene& scene,
                        const ImplicitSettings& settings, const State& state,
                        const TiledFaces& faces, const BodyVectors& forces);

}  // namespace edda
