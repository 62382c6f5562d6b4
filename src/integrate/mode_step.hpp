// The step of the modes of blocks that bend, and their damping (theory, sections 3.4 and 9.2).
//
// Each mode moves as a node of the mass m does (leapfrog.hpp). Its strain damping is implicit, as
// that of the nodes: with p = R^T (v - w J q), the rate of its amplitude as seen from the block,
//  p+ = (1 + h C)^-1 p*,  C = 2 zeta w_b along the bendings e_b, and 2 zeta w of the rest beside
//  them,
// so that a block that rotates is not damped. The couple that goes with the force -m C p+ acts on
// the nodes in the same step: the damping has no moment.
#pragma once

#include <vector>

#include "blocks/bent_state.hpp"
#include "blocks/masses.hpp"
#include "integrate/kick.hpp"

namespace edda {

/// What the damping of the modes did in the last step.
struct ModeDamping {
  ModeVectors force;           ///< [modes] force on them, N
  std::vector<double> couple;  ///< [nb] that on the nodes (bent_state.hpp), N m
};

/// A step from n to n + 1 of the modes.
struct ModeLeap {
  const BlockSet& blocks;
  const Masses& masses;
  const BodyVectors& force;         ///< at n, N
  const BodyVectors& old_velocity;  ///< v_{n-1/2}, m/s
  ModeDamping* damping;             ///< null: none is damped
};

/// The kick of each block of a group, its damping a in proportion to mass (1/s), and whether it
/// moves (1 or 0); 0 beyond the last block.
struct GroupKick {
  alignas(64) double keeps[group_size] = {};
  alignas(64) double h[group_size] = {};
  alignas(64) double local[group_size] = {};
  alignas(64) double by_mass[group_size] = {};
  alignas(64) double moves[group_size] = {};
  double h_new = 0.0;
};

/// v_{n+1/2} of the modes of the blocks [begin, end), which are whole groups with these kicks,
/// their positions at n + 1, and the couples of the damping, which are added to the forces on the
/// nodes. The nodes must still be at n.
void advance_modes(State& state, const ModeLeap& leap, const GroupKick* kicks, BodyVectors& forces,
                   std::size_t begin, std::size_t end);

/// Takes the couple of the last step back from the forces on the nodes, which must be at n.
void take_back_couples(const ModeDamping& damping, const BlockSet& blocks, const State& state,
                       BodyVectors& forces, std::size_t begin, std::size_t end);

/// Changes v_{n+1/2} of the modes of block i by what additional forces on them in the step do.
/// before: how the block stood at n. Returns the additional couple on its nodes, N m.
double push_modes(State& state, const ModeLeap& leap, const Kick& kick, const Rotation& before,
                  const ModesOfBlock& force, std::size_t i);

/// Adds to joules, [nb], what all damping of the modes of the blocks [begin, end) has dissipated in
/// the step just made, over (x_{n+1} - x_{n-1})/2.
void account_modes(const State& state, const ModeLeap& leap, const GroupKick* kicks, double h_old,
                   double* joules, std::size_t begin, std::size_t end);

}  // namespace edda
