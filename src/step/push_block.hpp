// Correction of a block's step for a change of the forces.
#pragma once

#include "blocks/masses.hpp"
#include "blocks/pose.hpp"
#include "blocks/state.hpp"
#include "integrate/kick.hpp"
#include "integrate/mode_step.hpp"
#include "integrate/strain_damping.hpp"

namespace edda {

/// Change of velocity per change of acceleration in advance(), with h_mean the mean of the two
/// steps, s.
inline double kick_over(double h_mean, double mass_damping) {
  return h_mean / (1.0 + 0.5 * mass_damping * h_mean);
}

/// Forces on both ends of an edge, N.
struct EdgeForce {
  Id edge, end;
  Vec2 at_edge, at_end;
};

/// A step that has been made, with the steps before and after the force, and the damping, as
/// advance() used them.
struct StepTaken {
  const BlockSet& blocks;
  const Masses& masses;
  State& state;
  Pose& pose;
  const Nodes &old_vx, &old_vy;  ///< velocities before the step, m/s
  double h_old = 0.0, h_new = 0.0, mass_damping = 0.0;
  StrainDamping* strain = nullptr;
  const BlockKicks* kicks = nullptr;      ///< as StepDamping::kicks
  const ModeVectors* old_rate = nullptr;  ///< of the modes before the step; null: no block bends
  ModeDamping* mode_damping = nullptr;
  double kick = kick_over(0.5 * (h_old + h_new), mass_damping);  ///< s
  double kick_of(std::size_t i) const { return kicks == nullptr ? kick : kicks->h[i]; }
};

/// Moves block i as the step would have with this additional force: changes its velocities, nodes,
/// modes, and vertices in Pose::x, y. Returns how far the vertex has moved that has moved farthest,
/// m.
double push_block(const StepTaken& taken, Id i, const EdgeForce& force);

/// Change of the velocity of block i along the force in the step, times the force, W.
double mobility(const StepTaken& taken, Id i, const EdgeForce& force);

}  // namespace edda
