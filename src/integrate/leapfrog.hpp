// Leapfrog (Eq. 13) with variable step, and its damping (theory, sections 7.1 and 9).
#pragma once

#include <vector>

#include "blocks/kinematics.hpp"
#include "blocks/masses.hpp"
#include "integrate/kick.hpp"
#include "integrate/mode_step.hpp"
#include "integrate/strain_damping.hpp"

namespace edda {

/// Damping of the step.
struct StepDamping {
  double mass = 0.0;   ///< a, 1/s; of all blocks where `kicks` is null
  double local = 0.0;  ///< beta
  /// Blocks without local damping, ascending: those on dashpots, which damp them already, and which
  /// would gain energy from beta times their own force. Null: none.
  const std::vector<Id>* spared = nullptr;
  /// Strain damping of the blocks, prepared for this step; null: none.
  StrainDamping* strain = nullptr;
  /// The same of the modes of the blocks; null: none is damped.
  ModeDamping* modes = nullptr;
  /// Each block's own a, set for this step (set_kicks()); null: all have the same.
  const BlockKicks* kicks = nullptr;

  /// Whether there is any in proportion to mass, or local damping.
  bool any_of_nodes() const { return mass != 0.0 || local != 0.0 || kicks != nullptr; }
  double mass_of(std::size_t i) const { return kicks == nullptr ? mass : kicks->mass[i]; }
};

/// The damping of a step, and what it is made of.
struct DampingOfStep {
  StepDamping in_force;
  StrainDamping strain;
  ModeDamping modes;
  BlockKicks kicks;  ///< of adaptive damping, block by block
};

/// Work dissipated by damping of nodes and strain, per block.
struct DampingWork {
  std::vector<double> joules;  ///< [nb]
};

/// A step from n to n + 1.
struct Leap {
  const BlockSet& blocks;
  const Masses& masses;
  const BodyVectors& force;         ///< at n, N
  const BodyVectors& old_velocity;  ///< v_{n-1/2}, m/s
  double h_old, h_new;              ///< last and next step, before and after n, s
  const StepDamping& damping;
};

/// Change of the velocity of block i per change of its acceleration in the step, s: h/(1 + a h/2).
double velocity_per_acceleration(const Leap& leap, std::size_t i);
/// The kick of block i, with the damping that acts on it.
Kick kick_of_block(const Leap& leap, std::size_t i);
/// The modes of the blocks in that step.
ModeLeap of_modes(const Leap& leap);
/// Moves the modes of the blocks [begin, end), before their nodes, and adds the couples of their
/// damping to the forces on these.
void advance_modes(State& state, const Leap& leap, BodyVectors& forces, std::size_t begin,
                   std::size_t end);

/// v_{n+1/2} = v_{n-1/2} + a_n (h_old + h_new)/2, x_{n+1} = x_n + h_new v_{n+1/2} for the free
/// blocks of [begin, end). Mass-proportional damping is centred: v+ = ((1 - a h/2) v- + h f/m)/(1 +
/// a h/2). Local damping acts with beta |f| against v-, node by node. The velocities of `state` may
/// be old_velocity where the dissipation does not count.
void advance(State& state, const Leap& leap, std::size_t begin, std::size_t end);
/// The same for all blocks.
void advance(State& state, const Leap& leap);
/// The same for [begin, end), not more than blocks_at_once, after `forces` have been added to those
/// of the leap.
void add_and_advance(State& state, const Leap& leap, const ForcesToAdd& forces, std::size_t begin,
                     std::size_t end);

/// Accounts for the dissipation of the step just made, once its velocities are final: damping force
/// times (x_{n+1} - x_{n-1})/2.
void account_damping(const State& state, const Leap& leap, DampingWork& work);

/// Undoes the last advance().
void undo_step(State& state, double h_new, const BodyVectors& old_velocity);

/// Start: v_{-1/2} = v_0 - (f/m - a v_0) h/2, with the mass-proportional damping a, 1/s.
void start_velocities(State& state, const BlockSet& blocks, const Masses& masses,
                      const BodyVectors& force, double h, const Damping& damping = {});

}  // namespace edda
