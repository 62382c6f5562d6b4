// One trial of a factor: from a state in equilibrium, the varied quantity is brought to its value,
// until the model reaches equilibrium again or has failed.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "judge/holding.hpp"
#include "study/mechanism.hpp"

namespace edda {

/// The varied quantities at one time.
struct Loading {
  std::vector<double> strength;  ///< [laws] strength factors
  double value = 1.0;  ///< of what is varied besides: a multiplier, a seismic coefficient,
                       ///< or degrees of tilt
};

/// Data that all trials of a search share.
struct TrialPlan {
  Varied varied = Varied::strength;
  Index target = 0;          ///< row of loads, ground motions, waters or boundaries
  double given_scale = 1.0;  ///< of that ground motion, to which factors refer
  Criterion criterion;
  double shaking = 0.0;     ///< s, duration of that ground motion; 0 without
  bool rigid_proof = true;  ///< Fos::rigid_proof
  Damping quiet;            ///< damping in the search for equilibrium
  Damping shaken;           ///< damping during ground motion
};

enum class TrialEnd {
  holds,
  fails,
  undecided,  ///< neither at rest nor gone where the steps were exhausted; counts as failed
  stopped,
};

constexpr std::string_view trial_end_name(TrialEnd end) {
  constexpr std::string_view names[] = {"holds", "fails", "undecided", "stopped"};
  return names[static_cast<int>(end)];
}

/// Result of one factor: a row of fos.csv.
struct Trial {
  double factor = 0.0;
  TrialEnd end = TrialEnd::stopped;
  std::string reason;         ///< a few words
  bool diverged = false;      ///< a step of it failed
  double part = 0.0;          ///< largest part of its size by which a set of blocks has moved
  double displacement = 0.0;  ///< m, largest of a vertex since the start of the trial
  Id block = no_id;           ///< block of that vertex
  std::vector<Id> failed;     ///< blocks that failed, ascending; empty where none is named
  double time = 0.0;          ///< s since the start of the trial
  double velocity = 0.0;      ///< m/s, of the fastest block at the end
  double unbalanced = 0.0;    ///< mean resultant over mean contact force, as for stages
  std::uint64_t steps = 0;
  /// The mechanism of rigid blocks that have no equilibrium, where that has ended the trial.
  std::optional<Mechanism> proof;
};

/// Runs `sim`, in equilibrium, to the end of a trial under `to`. Displacements count from the start
/// of the trial; a trial that fails is left as it was when a set had moved by moved_little, or,
/// where rigid blocks have no equilibrium, moved by so much by their mechanism. `stops`
/// is called before each step; true ends the trial.
Trial run_trial(Simulation& sim, const TrialPlan& plan, const Loading& to,
                const std::function<bool()>& stops);

}  // namespace edda
