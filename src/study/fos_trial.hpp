// One trial of a factor: from a state in equilibrium, the varied quantity is brought to its value,
// until the model reaches equilibrium again or has failed.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "step/simulation.hpp"

namespace edda {

/// When a trial holds and when it fails. Values that are not given follow from the mean size L of
/// the free blocks and from gravity g (docs/fos.md).
struct FosCriterion {
  double size = 0.0;          ///< L, m: mean of the square roots of the areas
  double acceleration = 0.0;  ///< g, m/s2: without gravity the mean load over mass, and without
                              ///< loads usual_acceleration
  double displacement = 0.0;  ///< m: failure displacement of a vertex
  bool slows = false;  ///< true: a vertex beyond it has not failed if it slows down to equilibrium
                       ///< and has not moved a hundred times as far
  double velocity = 0.0;  ///< m/s: a vertex that is faster at the end of a trial without other
                          ///< result has failed
  double duration = 0.0;  ///< s, T: time within which nothing may move further in equilibrium
  double shaking = 0.0;   ///< s, duration of ground motion before that; 0 without
};

/// The varied quantities at one time.
struct Loading {
  std::vector<double> strength;  ///< [laws] strength factors
  double multiplier = 1.0;       ///< of the load, the unit weight of water, or the ground motion
};

/// Data that all trials of a search share.
struct TrialPlan {
  Model given;  ///< has the loads to which multipliers refer
  Varied varied = Varied::strength;
  std::size_t target = 0;  ///< row of loads, ground motions or waters
  FosCriterion criterion;
  Damping quiet;   ///< damping in the search for equilibrium
  Damping shaken;  ///< damping during ground motion
};

/// Largest number of steps in which a model may reach equilibrium, and of a trial.
constexpr double most_steps = 300000.0;

enum class TrialEnd { holds, fails, stopped };

/// Result of one factor: a row of fos.csv.
struct Trial {
  double factor = 0.0;
  TrialEnd end = TrialEnd::stopped;
  std::string reason;         ///< a few words
  double displacement = 0.0;  ///< m, largest of a vertex since the start of the trial
  Id block = no_id;           ///< block of that vertex
  double time = 0.0;          ///< s since the start of the trial
  double velocity = 0.0;    ///< m/s, largest mean velocity of a vertex between the last two checks
  double unbalanced = 0.0;  ///< mean resultant over mean contact force, as for stages
  std::uint64_t steps = 0;
};

/// Applies the loading.
void apply(Simulation& sim, const TrialPlan& plan, const Loading& loading);
/// The same for what is varied besides strength.
void apply_multiplier(Simulation& sim, const TrialPlan& plan, double multiplier);

/// Runs `sim`, in equilibrium under `from`, to the end of a trial under `to`. Displacements count
/// from the start of the trial; in a trial that fails by its trend those of the state count from
/// where the trend was found, so that they show the mechanism. `stops` is called before each step;
/// true ends the trial.
Trial run_trial(Simulation& sim, const TrialPlan& plan, const Loading& from, const Loading& to,
                const std::function<bool()>& stops);

}  // namespace edda
