// The factor of safety of a model, by bisection between a factor at which it holds and one at which
// it fails (docs/fos.md).
#pragma once

#include <atomic>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "results/records.hpp"
#include "study/fos_trial.hpp"
#include "study/mechanism.hpp"

namespace edda {

struct FosOptions {
  int threads = 1;  ///< trials that are made side by side, as far as memory has room for them; the
                    ///< result does not depend on it
  std::function<void(const std::string&)> say{};  ///< messages, line by line; may be empty
  /// How far the present trial is, every two seconds, from any thread; may be empty.
  std::function<void(const std::string&)> progress{};
  const std::atomic<bool>* stop = nullptr;  ///< set from any thread: the search ends as interrupted
};

enum class FosStatus {
  found,
  below,        ///< fails at every factor tried
  above,        ///< holds at every factor tried
  unstable,     ///< finds no equilibrium before anything is varied
  interrupted,  ///< with the bracket so far
};

constexpr std::string_view fos_status_name(FosStatus s) {
  constexpr std::string_view names[] = {"found", "below", "above", "unstable", "interrupted"};
  return names[static_cast<int>(s)];
}

/// What rigid limit analysis says of the same factor (docs/limit.md).
struct RigidBracket {
  double least = 0.0;  ///< of joints that slide without dilating, and of those that have broken
  double most = 0.0;   ///< of joints that dilate as they slide
  bool below_most = false;  ///< the factor is at most `most`, which no equilibrium exceeds, with
                            ///< the part `slack` beyond it
  double slack = 0.0;
  std::optional<double> trials_hold;  ///< the highest factor that the trials hold, where it is
                                      ///< beyond `most`, which is then the result
  std::string text;                   ///< one sentence
};

/// What fails at a factor, where what failed at lower ones no longer counts.
struct FailedSet {
  double holds = 0.0, fails = 0.0;  ///< ends of its bracket
  std::vector<Id> blocks;           ///< that move first, ascending
  double area = 0.0;                ///< m2, of these
  std::string text;                 ///< as Mechanism::text
};

struct FosResult {
  FosStatus status = FosStatus::found;
  std::string message;
  std::optional<double> factor;        ///< mid-point of the bracket
  std::optional<double> holds, fails;  ///< ends of the bracket
  std::string proof;                   ///< of both ends, one sentence
  Criterion criterion;
  double size = 0.0;          ///< m, mean of the square roots of the areas of the free blocks
  double acceleration = 0.0;  ///< m/s2, of gravity, or of the loads without it
  double duration = 0.0;      ///< s: the longest time T of a block (rest_time())
  double shaking = 0.0;       ///< s, duration of the ground motion that is varied; 0 without
  std::vector<Trial> trials;  ///< in the order in which one thread makes them
  std::optional<Mechanism> mechanism;  ///< at the lowest factor that failed
  std::vector<FailedSet> sets;  ///< in the order in which they fail: that of the factor, and what
                                ///< follows if it is larger than all before together
  std::optional<double> holds_wide, fails_wide;  ///< bracket where blocks may move by a tenth of
                                                 ///< their size; none where that is the same
  std::optional<Simulation> failed;   ///< final state at that factor; displacements count from the
                                      ///< start of the trial
  std::optional<RigidBracket> rigid;  ///< none where it has no limit or was not asked
  std::size_t blocks = 0;
  double seconds = 0.0;  ///< s, wall time
  std::vector<std::string> warnings;
};

/// Cuts, brings the model to equilibrium, and runs the trials. Faults: those of prepare_run(), and
/// of settings that a search does not support (method "dda", mass = "consistent").
Result<FosResult> find_factor(const Model& model, const FosOptions& options);

/// fos.csv and summary.json.
std::string fos_csv(const std::vector<Trial>& trials);
std::string fos_summary(const Model& model, const FosResult& result, int threads);

}  // namespace edda
