#include "run/fos.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <deque>
#include <exception>
#include <map>

#include "run/fos_bracket.hpp"
#include "run/fos_start.hpp"
#include "run/labels.hpp"

namespace edda {
namespace {

/// The factors that the search may ask for next, the most certain first: the one it needs, then
/// those it would need after either outcome, and so on.
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
    for (const bool held : {true, false}) {
      FosBracket after = state;
      after.take(*factor, held);
      states.push_back(after);
    }
  }
  return factors;
}

/// A trial that has been made, with its end while that may be one of the two nearest to the factor.
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
        told_{first_} {
    for (const Trial& trial : start.seen) {
      say(trial);
      first_.take(trial.factor, trial.end == TrialEnd::holds);
      told_ = first_;
      result_.trials.push_back(trial);
    }
  }

  /// Goes on until the bracket is narrow enough. What is known then.
  FosBracket go() {
    FosBracket bracket = first_;
    while (const auto needed = bracket.next()) {
      if (!made_.contains(*needed)) make(bracket);
      const auto found = made_.find(*needed);
      if (found == made_.end()) break;  // stopped
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
    if (bracket.holds && highest != made_.end()) held_ = std::move(highest->second.end);
    return bracket;
  }

  /// The state nearest to failure that holds; else that from which the trials begin.
  const Simulation& held() const { return held_ ? *held_ : start_.sim; }

 private:
  void say(const Trial& trial) const {
    if (!options_.say) return;
    const bool holds = trial.end == TrialEnd::holds;
    options_.say(fmt::format(
        "factor {:.6g} {}: {} after {:.3g} s, {:.3g} m at {}", trial.factor,
        holds ? "holds" : "fails", trial.reason, trial.time, trial.displacement,
        trial.block == no_id ? "no block" : block_label(start_.sim.blocks, trial.block)));
  }

  bool stopped() const {
    return options_.stop != nullptr && options_.stop->load(std::memory_order_relaxed);
  }

  /// Makes the trial that is needed, and as many of those that may be needed next as there are
  /// threads. One that turns out not to be needed is given up.
  void make(const FosBracket& bracket) {
    std::vector<double> factors;
    for (const double f : likely_next(bracket, static_cast<std::size_t>(options_.threads))) {
      if (!made_.contains(f)) factors.push_back(f);
    }
    const int at_once = static_cast<int>(factors.size());
    if (at_once == 1) return try_one(factors.front(), bracket);  // its loops may use all threads
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
      tell_known();
    }
  }

  /// Says of the trials what one thread would say: not of those that turn out not to be needed.
  void tell_known() {
    for (auto needed = told_.next(); needed; needed = told_.next()) {
      const auto found = made_.find(*needed);
      if (found == made_.end()) return;
      const Trial& trial = found->second.trial;
      say(trial);
      told_.take(trial.factor, trial.end == TrialEnd::holds);
    }
  }

  /// Whether the search may still come to this factor, by what is known so far.
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

  /// States of trials that cannot be the lowest that fails or the highest that holds any more.
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
  FosBracket first_{}, told_{};
  std::optional<Simulation> held_;
  std::map<double, Made> made_;
  std::atomic<bool> given_up_{false};
};

const char* what_was_varied(Varied varied) {
  constexpr const char* words[] = {"strength", "the load", "the shaking", "the water"};
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
    r.message = fmt::format("it fails at every factor tried, down to {:.6g}: {}", *r.fails,
                            strength ? "what moves does not hang on the strength of these joints"
                                     : "something else moves it");
  } else if (!bracket.fails) {
    r.status = FosStatus::above;
    r.message =
        fmt::format("it holds at every factor tried, up to {:.6g}: {}", *r.holds,
                    strength ? "it does not need the strength of these joints"
                             : std::string(what_was_varied(fos.varied)) + " cannot move it");
  } else {
    r.factor = 0.5 * (*r.holds + *r.fails);
    r.message = fmt::format("factor of safety {:.4g} (holds at {:.6g}, fails at {:.6g})", *r.factor,
                            *r.holds, *r.fails);
  }
}

/// A model at rest as it stood where displacements of `later` count from.
Simulation at_start(const Simulation& rest, const Simulation& later) {
  Simulation start = rest;
  start.state.x = later.state.from_x;
  start.state.y = later.state.from_y;
  for (std::size_t i = 0; i < start.blocks.size(); ++i) {
    place_vertices(start.blocks, start.state.x, start.state.y, i, start.pose.x, start.pose.y);
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
  r.blocks = start.sim.blocks.size();
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
    const bool sound = r.failed && std::isfinite(r.failed->last_displacement) &&
                       r.failed->last_displacement < 1e100;
    if (sound) {
      r.mechanism = mechanism_of(at_start(start.sim, *r.failed), *r.failed);
      find_lost_cohesion(*r.mechanism, search.held());
    }
  }
  for (const Trial& trial : r.trials) {
    if (!trial.reason.starts_with("diverged")) continue;
    r.warnings.push_back(fmt::format("the trial of {:.6g} {}", trial.factor, trial.reason));
  }
  r.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
  return r;
}

}  // namespace edda
