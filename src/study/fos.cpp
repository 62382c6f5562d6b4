#include "study/fos.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <deque>
#include <exception>
#include <map>

#include "run/wall_clock.hpp"
#include "step/labels.hpp"
#include "study/fos_bracket.hpp"
#include "study/fos_start.hpp"

namespace edda {
namespace {

/// The factors that the search may need next, the most certain first: the one it needs, then those
/// it would need after either outcome, and so on.
std::vector<double> likely_next(const FosBracket& bracket, std::size_t most) {
  std::vector<double> factors;
  std::deque<FosBracket> states{bracket};
  while (!states.empty() && factors.size() < most) {
    const FosBracket state = states.front();
    states.pop_front();
    const std::optional<double> factor = state.next();
    if (!factor) continue;
    if (std::find(factors.begin(), factors.end(), *factor) == factors.end()) {
      factors.push_back(*factor);
    }
    for (const bool stable : {true, false}) {
      FosBracket after = state;
      after.take(*factor, stable);
      states.push_back(after);
    }
  }
  return factors;
}

/// A completed trial, with its final state as long as that may be one of the two nearest to the
/// factor of safety.
struct Made {
  Trial trial;
  std::optional<Simulation> end;
};

class Search {
 public:
  Search(const Model& model, const Fos& fos, FosStart& start, const FosOptions& options,
         FosResult& result)
      : model_(model),
        fos_(fos),
        start_(start),
        options_(options),
        result_(result),
        first_{fos.bracket.x, fos.bracket.y, fos.tolerance},
        reported_bracket_{first_} {
    for (const Trial& trial : start.seen) {
      say(trial);
      first_.take(trial.factor, trial.end == TrialEnd::holds);
      reported_bracket_ = first_;
      result_.trials.push_back(trial);
    }
  }

  /// Searches until the bracket is narrow enough. Returns the bracket.
  FosBracket go() {
    FosBracket bracket = first_;
    while (const auto needed = bracket.next()) {
      if (!made_.contains(*needed)) make(bracket);
      const auto found = made_.find(*needed);
      if (found == made_.end()) break;  // the search was stopped
      const Trial& trial = found->second.trial;
      result_.trials.push_back(trial);
      bracket.take(trial.factor, trial.end == TrialEnd::holds);
      drop_ends(bracket);
    }
    const auto lowest = made_.find(bracket.high), highest = made_.find(bracket.low);
    if (bracket.fails && lowest != made_.end()) {
      result_.failed = std::move(lowest->second.end);
    } else if (bracket.fails && start_.failed) {
      result_.failed = std::move(start_.failed);
    }
    if (bracket.holds && highest != made_.end()) stable_ = std::move(highest->second.end);
    return bracket;
  }

  /// The state at the highest factor that holds; if there is none, the state from which the trials
  /// start.
  const Simulation& stable() const { return stable_ ? *stable_ : start_.sim; }

 private:
  void say(const Trial& trial) const {
    if (!options_.say) return;
    const bool holds = trial.end == TrialEnd::holds;
    options_.say(fmt::format(
        "factor {:.6g} {}: {} after {:.3g} s, {:.3g} m at {}", trial.factor,
        holds ? "holds" : "fails", trial.reason, trial.time, trial.displacement,
        trial.block == no_id ? "no block" : block_label(start_.sim.scene->blocks, trial.block)));
  }

  bool stopped() const {
    return options_.stop != nullptr && options_.stop->load(std::memory_order_relaxed);
  }

  /// Runs the trial that is needed, and as many of those that may be needed next as there are
  /// threads. A trial that turns out not to be needed is aborted.
  void make(const FosBracket& bracket) {
    std::vector<double> factors;
    for (const double f : likely_next(bracket, static_cast<std::size_t>(options_.threads))) {
      if (!made_.contains(f)) factors.push_back(f);
    }
    const int at_once = static_cast<int>(factors.size());
    if (at_once == 1) return try_one(factors.front(), bracket);  // it may use all threads inside
    std::exception_ptr trouble;
#pragma omp parallel for schedule(dynamic, 1) num_threads(at_once)
    for (int q = 0; q < at_once; ++q) {
      try {
        try_one(factors[static_cast<std::size_t>(q)], bracket);
      } catch (...) {
#pragma omp critical(fos_search)
        trouble = std::current_exception();
        given_up_ = true;
      }
    }
    if (trouble) std::rethrow_exception(trouble);
  }

  void try_one(double factor, const FosBracket& bracket) {
    Made made;
    made.end = start_.sim;
    const Loading to = loading_of(fos_, model_, start_.given, factor);
    made.trial = run_trial(*made.end, start_.plan, start_.loading, to,
                           [&] { return stopped() || given_up_ || !is_wanted(factor, bracket); });
    made.trial.factor = factor;
    if (made.trial.end == TrialEnd::stopped) return;
#pragma omp critical(fos_search)
    {
      made_.emplace(factor, std::move(made));
      report_known();
    }
  }

  /// Reports trials in the order in which one thread would make them, without those that turn out
  /// not to be needed.
  void report_known() {
    for (auto needed = reported_bracket_.next(); needed; needed = reported_bracket_.next()) {
      const auto found = made_.find(*needed);
      if (found == made_.end()) return;
      const Trial& trial = found->second.trial;
      say(trial);
      reported_bracket_.take(trial.factor, trial.end == TrialEnd::holds);
    }
  }

  /// Whether the search may still need this factor, given the trials so far.
  bool is_wanted(double factor, FosBracket bracket) {
    bool wanted = true;
#pragma omp critical(fos_search)
    {
      std::optional<double> needed = bracket.next();
      while (needed && made_.contains(*needed)) {
        bracket.take(*needed, made_.at(*needed).trial.end == TrialEnd::holds);
        needed = bracket.next();
      }
      wanted = needed && bracket.may_ask(factor);
    }
    return wanted;
  }

  /// Drops the states of trials that can no longer be the lowest that fails or the highest that
  /// holds.
  void drop_ends(const FosBracket& bracket) {
    for (auto& [factor, made] : made_) {
      if (bracket.fails && factor > bracket.high) made.end.reset();
      if (bracket.holds && factor < bracket.low) made.end.reset();
    }
  }

  const Model& model_;
  const Fos& fos_;
  FosStart& start_;
  const FosOptions& options_;
  FosResult& result_;
  FosBracket first_{}, reported_bracket_{};
  std::optional<Simulation> stable_;
  std::map<double, Made> made_;
  std::atomic<bool> given_up_{false};
};

const char* what_was_varied(Varied varied) {
  constexpr const char* words[] = {"strength", "the load", "the ground motion",
                                   "the water pressure"};
  return words[static_cast<int>(varied)];
}

void conclude(const FosBracket& bracket, const Fos& fos, bool stopped, FosResult& r) {
  if (bracket.holds) r.holds = bracket.low;
  if (bracket.fails) r.fails = bracket.high;
  const bool strength = fos.varied == Varied::strength;
  if (stopped) {
    r.status = FosStatus::interrupted;
    r.message = "stopped";
    if (r.holds) r.message += fmt::format("; it holds at {:.6g}", *r.holds);
    if (r.fails) r.message += fmt::format("; it fails at {:.6g}", *r.fails);
  } else if (!bracket.holds) {
    r.status = FosStatus::below;
    r.message = fmt::format("the model fails at every factor tried, down to {:.6g}: {}", *r.fails,
                            strength ? "the failure does not depend on the strength of these joints"
                                     : "it has another cause");
  } else if (!bracket.fails) {
    r.status = FosStatus::above;
    r.message =
        fmt::format("the model holds at every factor tried, up to {:.6g}: {}", *r.holds,
                    strength ? "it does not need the strength of these joints"
                             : std::string(what_was_varied(fos.varied)) + " cannot move it");
  } else {
    r.factor = 0.5 * (*r.holds + *r.fails);
    r.message = fmt::format("factor of safety {:.4g} (holds at {:.6g}, fails at {:.6g})", *r.factor,
                            *r.holds, *r.fails);
  }
}

/// The equilibrium state `rest`, with the positions from which displacements of `later` count.
Simulation at_start(const Simulation& rest, const Simulation& later) {
  Simulation start = rest;
  start.motion.state.x = later.motion.state.from_x;
  start.motion.state.y = later.motion.state.from_y;
  for (std::size_t i = 0; i < start.scene->blocks.size(); ++i) {
    place_vertices(start.scene->blocks, start.motion.state.x, start.motion.state.y, i,
                   start.motion.pose.x, start.motion.pose.y);
  }
  return start;
}

}  // namespace

Result<FosResult> find_factor(const Model& model, const FosOptions& options) {
  const auto began = std::chrono::steady_clock::now();
  const Fos fos = model.fos.value_or(Fos{});
  Result<FosStart> made = start_trials(model, fos, options);
  if (!made.ok()) return made.faults();
  FosStart& start = made.value();
  FosResult r;
  r.criterion = start.plan.criterion;
  r.blocks = start.sim.scene->blocks.size();
  r.warnings = start.warnings;
  if (start.status != FosStatus::found) {
    r.status = start.status;
    r.message =
        start.status == FosStatus::interrupted ? "stopped before the first trial" : start.message;
  } else {
    Search search(model, fos, start, options, r);
    const FosBracket bracket = search.go();
    const bool stopped = options.stop != nullptr && *options.stop && bracket.next();
    conclude(bracket, fos, stopped, r);
    const bool sound = r.failed && std::isfinite(r.failed->control.last_displacement) &&
                       r.failed->control.last_displacement < 1e100;
    if (sound) {
      r.mechanism = mechanism_of(at_start(start.sim, *r.failed), *r.failed);
      find_lost_cohesion(*r.mechanism, search.stable());
    }
  }
  for (const Trial& trial : r.trials) {
    if (!trial.reason.starts_with("diverged")) continue;
    r.warnings.push_back(fmt::format("the trial of {:.6g} {}", trial.factor, trial.reason));
  }
  r.seconds = since(began);
  return r;
}

}  // namespace edda
