// Forces of a block on itself at a trial position, on its nodes and modes.
#pragma once

#include "implicit/newmark.hpp"

namespace edda {

/// Elastic force on block i, N: minus the derivative of what it stores (stored_energy()).
BodyColumn elastic_force(const ImplicitScene& scene, const State& state, std::size_t i);

/// Viscous force of strain damping on the block of that row, N, at the mean rates of its strain and
/// its modes in the step, so that it takes energy (of a block that does not turn in the step:
/// section 12.8); zero in a static analysis.
BodyColumn viscous_force(const ImplicitSolver& solver, const ImplicitScene& scene,
                         const ImplicitSettings& settings, const State& state, std::size_t row);

}  // namespace edda
