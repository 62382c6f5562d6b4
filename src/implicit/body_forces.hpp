// Forces of a block on itself at a trial position, on its nodes and modes.
#pragma once

#include "implicit/newmark.hpp"

namespace edda {

/// What strain and bending of block i store, J.
double stored_energy(const ImplicitScene& scene, const State& state, std::size_t i);

/// Elastic force on it, N: minus the derivative of that.
BodyVector elastic_force(const ImplicitScene& scene, const State& state, std::size_t i);

/// Viscous force of strain damping on the block of that row, N, at the mean rates of its strain and
/// its modes in the step, so that it takes energy (of a block that does not turn in the step:
/// section 12.8); zero in a static analysis.
BodyVector viscous_force(const ImplicitSolver& solver, const ImplicitScene& scene,
                         const ImplicitSettings& settings, const State& state, std::size_t row);

}  // namespace edda
