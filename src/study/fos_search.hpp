// The search for a factor between the ends of a bracket, trials side by side.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <map>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "results/machine.hpp"
#include "step/labels.hpp"
#include "study/fos.hpp"
#include "study/fos_bracket.hpp"
#include "study/fos_start.hpp"
#include "study/likely_factors.hpp"
#include "study/side_by_side.hpp"

namespace edda {

/// A completed trial, with its final state as long as that may be one of the two nearest to the
/// factor of safety.
struct MadeTrial {
  Trial trial;
  std::optional<Simulation> end;
};

/// A trial that is being made.
struct TrialInProgress {
  double factor;
  bool given_up = false;  ///< it has been asked to stop
  MadeTrial made{};       ///< belongs to the task until that has ended
};

/// The search between the ends of the bracket. Beside the trial that it needs it makes others that
/// it may need next, but it counts and reports those alone that it has needed, in their order.
class FosSearch {
 public:
  FosSearch(const Model& model, const Fos& fos, const FosBracket& begin, FosStart& start,
            const FosOptions& options, FosResult& result)
      : model_(model),
        fos_(fos),
        start_(start),
        options_(options),
        result_(result),
        bracket_(begin),
        trials_(options.threads,
                tasks_within(memory_here(), options.threads, start.sim.scene->blocks.size())) {
    for (const Trial& trial : start.seen) count(trial);
    if (begin.low != fos.bracket.x || begin.high != fos.bracket.y) {
      FosBracket away = begin;  // to where these trials are far away
      if (bracket_.holds && bracket_.low < begin.low) away.held = bracket_.low;
      if (bracket_.fails && bracket_.high > begin.high) away.failed = bracket_.high;
      bracket_ = away;
    }
    begin_ = bracket_;
  }

  /// Searches until the bracket is narrow enough, or until it is stopped. Returns the bracket.
  FosBracket go() {
    for (auto needed = next(); needed && !stopped(); needed = next()) {
      needed_ = *needed;
      make(*needed);
      const auto found = made_.find(*needed);
      if (found == made_.end()) break;  // the search was stopped
      count(found->second.trial);
      drop_ends();
    }
    return bracket_;
  }

  /// Tries a factor below the highest that holds, and searches on where it fails.
  FosBracket look_below(double factor) {
    bracket_.below = factor;
    bracket_.widened = 0;
    begin_ = bracket_;
    return go();
  }

  /// Ends the search: the states at the ends of the bracket.
  void finish() {
    for (const auto& [number, one] : trying_) trials_.stop(number);
    const auto lowest = made_.find(bracket_.high), highest = made_.find(bracket_.low);
    if (bracket_.fails && lowest != made_.end()) {
      result_.failed = std::move(lowest->second.end);
    } else if (bracket_.fails && start_.failed) {
      result_.failed = std::move(start_.failed);
    }
    if (bracket_.holds && highest != made_.end()) stable_ = std::move(highest->second.end);
  }

  /// The state at the highest factor that holds; if there is none, the state from which the trials
  /// start.
  const Simulation& stable() const { return stable_ ? *stable_ : start_.sim; }

 private:
  void count(const Trial& trial) {
    say(trial);
    result_.trials.push_back(trial);
    bracket_.take(trial.factor, trial.end == TrialEnd::holds);
  }

  void say(const Trial& trial) const {
    if (!options_.say) return;
    options_.say(fmt::format(
        "factor {:.6g} {}: {} after {:.3g} s, {:.3g} m at {}", trial.factor,
        trial_end_name(trial.end), trial.reason, trial.time, trial.displacement,
        trial.block == no_id ? "no block" : block_label(start_.sim.scene->blocks, trial.block)));
  }

  /// The search by halving alone, after what trials have shown.
  FosBracket halved() const {
    return followed(begin_, [&](double factor) {
      return factor == bracket_.below ? std::nullopt : bracket_.shown(factor);
    });
  }

  /// The ends of the bracket to which halving comes where rigid blocks have their limit, the one
  /// that fails first, as long as they are not tried and no trial contradicts that limit.
  std::vector<double> ends_at_limit() const {
    const RigidLimit& rigid = start_.rigid;
    if (start_.wide || !start_.as_drawn || !rigid || !limits_agree(*rigid)) return {};
    const double limit = rigid->largest.lower;
    const bool bolts_stretch = rigid->bolts_as_now && *rigid->bolts_as_now < limit;
    if (bolts_stretch || bracket_.shown(limit)) return {};
    const FosBracket last =
        followed(halved(), [&](double factor) { return std::optional(factor < limit); });
    std::vector<double> ends;
    for (const double end : {last.high, last.low}) {
      if (!last.gave_up() && !bracket_.shown(end)) ends.push_back(end);
    }
    return ends;
  }

  std::optional<double> next() const {
    const std::vector<double> ends = ends_at_limit();
    return ends.empty() ? halved().next() : ends.front();
  }

  /// Factors of which trials are wanted now, the one that the search needs first.
  std::vector<double> wanted() const {
    std::vector<double> ends = ends_at_limit();
    if (ends.empty())
      return likely_factors(halved(), trials_.places(), [&](double f) { return outcome_of(f); });
    std::erase_if(ends, [&](double end) { return made_.contains(end); });
    return ends;
  }

  bool stopped() const {
    return options_.stop != nullptr && options_.stop->load(std::memory_order_relaxed);
  }

  /// Makes the trial of this factor and, in the other places, those that may be needed next.
  /// Returns once it has ended or the search has been stopped.
  void make(double needed) {
    while (!made_.contains(needed) && !stopped()) {
      const std::vector<double> first = wanted();
      make_room(first);
      for (const double factor : first) {
        if (trials_.has_room() && !is_tried(factor)) begin(factor);
      }
      const auto ended = trying_.extract(trials_.wait_for_one());
      TrialInProgress& one = *ended.mapped();
      const bool complete = one.made.trial.end != TrialEnd::stopped;
      if (complete && bracket_.may_ask(one.factor)) made_.emplace(one.factor, std::move(one.made));
    }
  }

  std::optional<bool> outcome_of(double factor) const {
    const auto found = made_.find(factor);
    if (found == made_.end()) return {};
    return found->second.trial.end == TrialEnd::holds;
  }

  bool is_tried(double factor) const {
    return std::any_of(trying_.begin(), trying_.end(), [&](const auto& t) {
      return t.second->factor == factor && !t.second->given_up;
    });
  }

  /// Gives up trials that can no longer be needed; if there is no room yet for the first one
  /// wanted, also one that is not wanted now, of these the latest, which has computed least.
  void make_room(const std::vector<double>& wanted) {
    bool room = trials_.has_room() || is_tried(wanted.front());
    const auto give_up = [&](std::size_t number, TrialInProgress& one) {
      trials_.stop(number);
      one.given_up = room = true;
    };
    for (auto& [number, one] : trying_) {
      if (one->given_up || !bracket_.may_ask(one->factor)) give_up(number, *one);
    }
    for (auto t = trying_.rbegin(); t != trying_.rend() && !room; ++t) {
      const bool is_wanted =
          std::find(wanted.begin(), wanted.end(), t->second->factor) != wanted.end();
      if (!is_wanted) give_up(t->first, *t->second);
    }
  }

  void begin(double factor) {
    const auto one = std::make_shared<TrialInProgress>(TrialInProgress{factor});
    const std::size_t number =
        trials_.begin([this, one](const std::stop_token& stop) { run(*one, stop); });
    trying_.emplace(number, one);
  }

  void run(TrialInProgress& one, const std::stop_token& stop) {
    one.made.end = start_.sim;
    const Loading to = loading_of(fos_, model_, start_.given, one.factor);
    one.made.trial = run_trial(*one.made.end, plan_at(one.factor, start_), to, [&] {
      if (one.factor == needed_) tell_progress(options_, pace_, one.factor, *one.made.end);
      return stopped() || stop.stop_requested();
    });
    one.made.trial.factor = one.factor;
  }

  /// Drops the states of trials that can no longer be the lowest that fails or the highest that
  /// holds.
  void drop_ends() {
    for (auto& [factor, made] : made_) {
      if (bracket_.fails && factor > bracket_.high) made.end.reset();
      if (bracket_.holds && factor < bracket_.low) made.end.reset();
    }
  }

  const Model& model_;
  const Fos& fos_;
  FosStart& start_;
  const FosOptions& options_;
  FosResult& result_;
  FosBracket bracket_;                ///< what trials have shown
  FosBracket begin_;                  ///< which the search halves
  std::atomic<double> needed_ = 0.0;  ///< factor of the trial that the search waits for
  Pace pace_;
  std::optional<Simulation> stable_;
  std::map<double, MadeTrial> made_;                                ///< by factor
  std::map<std::size_t, std::shared_ptr<TrialInProgress>> trying_;  ///< by number of the task
  SideBySide trials_;  ///< the last member: its tasks end before what they read is gone
};

}  // namespace edda
