// One trial of a factor: from a state at rest, with what is varied brought to its value, until all
// is at rest again or has failed.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "run/simulation.hpp"

namespace edda {

/// When a trial holds and when it fails. All from the mean size of the blocks that move, L, and
/// gravity g unless given (docs/fos.md).
struct FosCriterion {
  double size = 0.0;          ///< L, m: mean of the square roots of their areas
  double acceleration = 0.0;  ///< g, m/s2: where there is no gravity the mean load over mass, and
                              ///< without loads usual_acceleration
  double displacement = 0.0;  ///< m: a corner that has gone further has failed
  bool slows = false;     ///< unless it slows down to rest, and has not gone a hundred times as far
  double velocity = 0.0;  ///< m/s: a corner still faster has failed where a trial finds no end
  double duration = 0.0;  ///< s, T: at rest is what would not go on within it
  double shaking = 0.0;   ///< s of shaking before that; 0 without
};

/// What is varied, at one time.
struct Loading {
  std::vector<double> strength;  ///< [laws] what their strength is divided by
  double multiplier = 1.0;       ///< of the load, the water's weight or the shaking
};

/// What the trials of one search share.
struct TrialPlan {
  Model given;  ///< with the loads that multipliers count from
  Varied varied = Varied::strength;
  std::size_t target = 0;  ///< row of loads, shakings or waters
  FosCriterion criterion;
  Damping quiet;   ///< in which a model comes to rest
  Damping shaken;  ///< while the ground shakes
};

/// Steps that a model may take to come to rest, and a trial to find its end.
constexpr double most_steps = 300000.0;

enum class TrialEnd { holds, fails, stopped };

/// What came of one factor: a row of fos.csv.
struct Trial {
  double factor = 0.0;
  TrialEnd end = TrialEnd::stopped;
  std::string reason;         ///< a few words
  double displacement = 0.0;  ///< m, largest of a corner since its start
  Id block = no_id;           ///< whose corner that is
  double time = 0.0;          ///< s since its start
  double velocity = 0.0;      ///< m/s, largest of a corner over the last twentieth of a trial
  double unbalanced = 0.0;    ///< mean resultant over mean contact force, as of stages
  std::uint64_t steps = 0;
};

/// Puts the loading in force.
void apply(Simulation& sim, const TrialPlan& plan, const Loading& loading);
/// The same of what is varied besides strength.
void apply_multiplier(Simulation& sim, const TrialPlan& plan, double multiplier);

/// Runs `sim`, at rest under `from`, to the end of a trial under `to`. Displacements count from its
/// start. A trial that fails without having gone far goes on a little, so that its mechanism shows;
/// what it returns is of before. `stops` is asked now and then; true ends it.
Trial run_trial(Simulation& sim, const TrialPlan& plan, const Loading& from, const Loading& to,
                const std::function<bool()>& stops);

}  // namespace edda
