// How a simulation reaches equilibrium by adaptive dynamic relaxation (Underwood 1983;
// theory, sections 11.1 and 11.2): an estimate of the frequency of its motion, from which adaptive
// damping follows, and the gradual application of what a stage changes.
#pragma once

#include <cstdint>
#include <vector>

#include "attachments/loads.hpp"

namespace edda {

struct Simulation;

/// Estimate of the present frequency of the motion of a model by the Rayleigh quotient (Underwood
/// 1983): -dx . df / dx . M dx, with the changes dx of positions and df of forces over a quarter of
/// a radian of the motion. Over that many steps fast vibrations hardly count; from step to step
/// they would dominate the slow motion that has furthest to go. Frequencies are angular, rad/s.
struct FrequencyEstimate {
  double frequency = 0.0;        ///< rad/s, of the whole model; 0: not yet known
  std::vector<double> of_block;  ///< [nb] rad/s, of each block; empty: not yet known
  double least = 0.0;            ///< rad/s: lower bound of clock(), set when a change begins
  std::uint64_t since = 0;       ///< step at which the following were recorded
  BodyVectors position;          ///< then, m; empty: none yet
  BodyVectors force;             ///< then, without loads, N

  /// Frequency by which gradual changes proceed, rad/s: blocks that slide away lower the frequency,
  /// but do not stop these.
  double clock() const { return frequency > least ? frequency : least; }
  /// That of a block, which is damped no more than the model is: the fast motion of a block beside
  /// others must not keep it from following them.
  double frequency_of(std::size_t i) const {
    return of_block.empty() || of_block[i] > frequency ? frequency : of_block[i];
  }
};

struct Relaxation {
  bool seeks_equilibrium = false;  ///< is to reach equilibrium; changes may be gradual
  bool balanced = false;  ///< while it seeks equilibrium: all but single blocks are in balance
  double equilibrium_ratio = 0.0;   ///< ratio of unbalanced forces in equilibrium (Stage::ratio)
  FrequencyEstimate estimate;       ///< while it seeks equilibrium
  std::vector<std::uint8_t> loose;  ///< [nb] 1: does not count in it, since the block falls or
                                    ///< slides away; empty: none
  std::vector<double> strength_from, strength_to;  ///< [laws] strength factors while strength
                                                   ///< changes gradually
  /// Elastic initialisation: while the first loads are applied joints have a thousand times their
  /// strength, so that small blocks follow large ones as these settle; in later stages only bonds
  /// have it. Then the model settles, joints may open, and strength is reduced to that of the laws.
  enum class Hold : std::uint8_t { over, loading, settling } hold = Hold::over;
  bool holds_together = false;  ///< joints do not open meanwhile
};

/// Coefficient of mass-proportional damping at present, 1/s, with adaptive damping at the frequency
/// of the whole model.
double mass_damping(const Simulation& sim);
/// The same of each block, [nb], with adaptive damping at its own frequency.
void mass_damping_of_blocks(const Simulation& sim, std::vector<double>& damping);

/// Applies gradually, over about a period of the motion, what begins or ends to act now, and this
/// change of strength; at the very start also the weight, where the ground has no initial stress.
/// At the start this is an elastic initialisation (Relaxation::Hold): once the model has settled
/// under the loads the strength is reduced gradually, too, to what it changes to. Used with
/// adaptive damping. `more`: something else is to change with Loads::gradual, too.
void begin_gradually(Simulation& sim, const std::vector<double>& strength_factors,
                     bool more = false);

/// Ends the elastic initialisation: joints have the strength of their laws at once.
void end_hold(Simulation& sim);

/// Ends gradual changes where they are, as where a model fails on the way, and a hold.
void stop_gradual_change(Simulation& sim);

/// Whether gradual changes are complete.
bool gradual_change_complete(const Simulation& sim);

/// After each step: updates the frequency estimate where that is due, and continues gradual
/// changes.
void update_relaxation(Simulation& sim, const LoadsNow& at_work);

}  // namespace edda
