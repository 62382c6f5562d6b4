// Forces of the dashpots of viscous boundaries, centred in the step (theory, section 13.5).
#pragma once

#include <vector>

#include "attachments/dashpots.hpp"
#include "blocks/masses.hpp"
#include "forces/nodal_forces.hpp"

namespace edda {

/// Blocks, and the velocities on which the dashpots act.
struct DashpotScene {
  const BlockSet& blocks;
  const Masses& masses;
  const State& state;
  const Nodes &vx, &vy;  ///< v_{n-1/2}, m/s
};

/// Data of a step for the dashpots.
struct DashpotStep {
  double h;                            ///< mean of the last and the next step, s
  double half_damping;                 ///< a h/2, a the coefficient of mass-proportional damping
  const std::vector<double>* damping;  ///< [nb] a of each block, 1/s, instead; null: all alike
  const std::vector<Vec2>& reference;  ///< [points] r_n, velocity of the ground, m/s
  const std::vector<Vec2>& push;       ///< [points] additional forces, N; empty: none
  double half_damping_of(std::size_t i) const {
    return damping == nullptr ? half_damping : 0.5 * h * (*damping)[i];
  }
};

/// Adds the forces f = -C ((v_{n-1/2} + v_{n+1/2})/2 - r_n) + push of the dashpots on the blocks
/// [begin, end) to their nodal forces. v_{n+1/2} results from these forces, so for each block this
/// is solved:
/// ((1 + a h/2) M + h C/2 + h D) v+ = ((1 - a h/2) M - h C/2) v- + h (f + C r), with D of the
/// strain damping, whose force is left to advance(). The dashpots thus dissipate in every step,
/// whatever its length, and the critical step is what it is without them. on_point: [points] N,
/// filled.
void add_dashpots(NodalForces& forces, std::vector<Vec2>& on_point, const Dashpots& dashpots,
                  const DashpotScene& scene, const DashpotStep& step, std::size_t begin,
                  std::size_t end);

/// Subtracts the forces on_point from the nodal forces.
void remove_dashpots(NodalForces& forces, const std::vector<Vec2>& on_point,
                     const Dashpots& dashpots);

}  // namespace edda
