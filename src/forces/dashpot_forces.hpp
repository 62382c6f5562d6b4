// Forces of the dashpots at viscous boundaries, centred in the step.
#pragma once

#include <array>
#include <vector>

#include "attachments/dashpots.hpp"
#include "forces/nodal_forces.hpp"

namespace edda {

/// What dashpots know of a step.
struct DashpotStep {
  double h;                            ///< mean of the steps behind and ahead, s
  double drag;                         ///< a h/2, a the mass-proportional damping
  const std::vector<Vec2>& reference;  ///< [points] r_n, m/s
  const std::vector<Vec2>& push;       ///< [points] forces besides, N; empty: none
};

/// Adds the forces f = -C ((v_{n-1/2} + v_{n+1/2})/2 - r_n) + push of the dashpots on the blocks
/// [begin, end) to their nodal forces, with the v_{n+1/2} that these then lead to: per block six
/// equations
/// ((1 + a h/2) M + h C/2 + h D) v+ = ((1 - a h/2) M - h C/2) v- + h (f + C r), D of the block's
/// viscosity, whose force is left to advance(). So they take energy out at every step, whatever its
/// length, and the critical step is what it is without them. vx, vy: v_{n-1/2}. on_point: [points]
/// N, filled.
void add_dashpots(NodalForces& forces, std::vector<Vec2>& on_point, const Dashpots& dashpots,
                  const BlockSet& blocks, const State& state, const Nodes& vx, const Nodes& vy,
                  const DashpotStep& step, std::size_t begin, std::size_t end);

/// Takes them out again.
void remove_dashpots(NodalForces& forces, const std::vector<Vec2>& on_point,
                     const Dashpots& dashpots);

}  // namespace edda
