#include "study/fos.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <iterator>
#include <map>
#include <memory>

#include "base/gravity.hpp"
#include "observe/balance.hpp"
#include "results/machine.hpp"
#include "run/wall_clock.hpp"
#include "step/labels.hpp"
#include "study/fos_bracket.hpp"
#include "study/fos_rigid.hpp"
#include "study/fos_start.hpp"
#include "study/likely_factors.hpp"
#include "study/side_by_side.hpp"

namespace edda {
namespace {

bool is_moved(const FosBracket& begin, const Fos& fos) {
  return begin.low != fos.bracket.x || begin.high != fos.bracket.y;
}

/// A completed trial, with its final state as long as that may be one of the two nearest to the
/// factor of safety.
struct Made {
  Trial trial;
  std::optional<Simulation> end;
};

/// A trial that is being made.
struct Trying {
  double factor;
  bool given_up = false;  ///< it has been asked to stop
  Made made{};            ///< belongs to the task until that has ended
};

/// The search between the ends of the bracket. Beside the trial that it needs it makes others that
/// it may need next, but it counts and reports those alone that it has needed, in their order.
class Search {
 public:
  Search(const Model& model, const Fos& fos, const FosBracket& begin, FosStart& start,
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
    if (is_moved(begin, fos)) bracket_ = begin;  // to where these trials are far away
  }

  /// Searches until the bracket is narrow enough, or until it is stopped. Returns the bracket.
  FosBracket go() {
    for (auto needed = bracket_.next(); needed && !stopped(); needed = bracket_.next()) {
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
    const bool holds = trial.end == TrialEnd::holds;
    options_.say(fmt::format(
        "factor {:.6g} {}: {} after {:.3g} s, {:.3g} m at {}", trial.factor,
        holds ? "holds" : "fails", trial.reason, trial.time, trial.displacement,
        trial.block == no_id ? "no block" : block_label(start_.sim.scene->blocks, trial.block)));
  }

  bool stopped() const {
    return options_.stop != nullptr && options_.stop->load(std::memory_order_relaxed);
  }

  /// Makes the trial of this factor and, in the other places, those that may be needed next.
  /// Returns once it has ended or the search has been stopped.
  void make(double needed) {
    while (!made_.contains(needed) && !stopped()) {
      const std::vector<double> wanted =
          likely_factors(bracket_, trials_.places(), [&](double f) { return outcome_of(f); });
      make_room(wanted);
      for (const double factor : wanted) {
        if (trials_.has_room() && !is_tried(factor)) begin(factor);
      }
      const auto ended = trying_.extract(trials_.wait_for_one());
      Trying& one = *ended.mapped();
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
    const auto give_up = [&](std::size_t number, Trying& one) {
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
    const auto one = std::make_shared<Trying>(Trying{factor});
    const std::size_t number =
        trials_.begin([this, one](const std::stop_token& stop) { run(*one, stop); });
    trying_.emplace(number, one);
  }

  void run(Trying& one, const std::stop_token& stop) const {
    one.made.end = start_.sim;
    const Loading to = loading_of(fos_, model_, start_.given, one.factor);
    one.made.trial = run_trial(*one.made.end, plan_at(one.factor, start_), to,
                               [&] { return stopped() || stop.stop_requested(); });
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
  FosBracket bracket_;
  std::optional<Simulation> stable_;
  std::map<double, Made> made_;                            ///< by factor
  std::map<std::size_t, std::shared_ptr<Trying>> trying_;  ///< by number of the task
  SideBySide trials_;  ///< the last member: its tasks end before what they read is gone
};

const char* what_was_varied(Varied varied) {
  constexpr const char* words[] = {
      "strength", "the load", "the ground motion", "the water pressure", "the tilt",
      "kh",       "kv",       "gravity",           "the boundary"};
  static_assert(std::size(words) == static_cast<std::size_t>(Varied::boundary) + 1);
  return words[static_cast<int>(varied)];
}

/// How to go on where all factors tried end alike, the last of them `last`.
std::string look_beyond(double last, bool above, const RigidLimit& rigid) {
  Vec2 next = above ? Vec2{last, 2.0 * last} : Vec2{0.5 * last, last};
  if (rigid && rigid->largest.status == LimitEnd::found) {
    const double limit = rigid->largest.lower;
    if (above ? limit > last : limit > 0.0 && limit < last) next = around(limit);
  }
  return fmt::format("; give fos.bracket, such as [{:.3g}, {:.3g}], to look beyond", next.x,
                     next.y);
}

bool any_of(const std::vector<Trial>& trials, TrialEnd end) {
  return std::any_of(trials.begin(), trials.end(), [&](const Trial& t) { return t.end == end; });
}

void conclude(const FosBracket& bracket, const Fos& fos, bool stopped, const RigidLimit& rigid,
              FosResult& r) {
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
    r.message =
        fmt::format("the model fails at every factor tried{}, down to {:.6g}",
                    any_of(r.trials, TrialEnd::holds) ? " below some that hold" : "", *r.fails);
    if (!rigid || rigid->largest.status != LimitEnd::no_equilibrium) {
      r.message += look_beyond(*r.fails, false, rigid);
    } else {
      r.message += strength ? ": the failure does not depend on the strength of these joints"
                            : ": it has another cause";
    }
  } else if (!bracket.fails) {
    r.status = FosStatus::above;
    r.message =
        fmt::format("the model holds at every factor tried{}, up to {:.6g}",
                    any_of(r.trials, TrialEnd::fails) ? " above some that fail" : "", *r.holds);
    if (!rigid || rigid->largest.status != LimitEnd::no_limit) {
      r.message += look_beyond(*r.holds, true, rigid);
    } else if (strength) {
      r.message += ": it does not need the strength of these joints";
    } else {
      r.message +=
          fmt::format(": {} cannot move it in this direction", what_was_varied(fos.varied));
    }
  } else {
    r.factor = 0.5 * (*r.holds + *r.fails);
    r.message = fmt::format("factor of safety {:.4g} (holds at {:.6g}, fails at {:.6g})", *r.factor,
                            *r.holds, *r.fails);
  }
}

void add_scales(const Simulation& sim, FosResult& r) {
  const LoadsNow acting = loads_at(sim.scene->model, sim.attached.loads, sim.motion.state.time);
  double count = 0.0;
  for (std::size_t i = 0; i < sim.scene->blocks.size(); ++i) {
    if (!is_free(sim.scene->blocks, sim.motion.state, i)) continue;
    r.size += std::sqrt(sim.scene->blocks.area[i]);
    r.acceleration = std::max(r.acceleration, acceleration_on(sim, acting, i));
    count += 1.0;
  }
  r.size /= std::max(count, 1.0);
  if (r.acceleration == 0.0) r.acceleration = usual_acceleration;
  r.duration = longest_rest_time(sim);
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

/// Where a factor beyond the limit of rigid blocks holds, the factor is that limit: a sharp tip or
/// a small ledge stands in the way of what moves and bears whatever comes upon it, or what moves
/// has come loose before and does not count in the trials (lost).
void take_rigid_limit(const Fos& fos, LimitResult& limit, bool lost, FosResult& r) {
  const double held = *r.holds;
  const auto last = std::find_if(r.trials.begin(), r.trials.end(),
                                 [&](const Trial& trial) { return trial.factor == held; });
  r.rigid->text +=
      fmt::format("; blocks that deform hold up to {:.4g}, after they have moved by {:.3g} m: {}",
                  held, last == r.trials.end() ? 0.0 : last->displacement,
                  lost ? "those that have come loose before do not count"
                       : "a sharp tip or a ledge stands in their way (docs/limit.md)");
  r.warnings.push_back(r.rigid->text);
  r.rigid->below_most = true;
  r.status = FosStatus::found;
  r.holds = limit.largest.lower;
  r.fails = limit.largest.upper;
  r.factor = 0.5 * (*r.holds + *r.fails);
  r.message =
      fmt::format("{} {:.4g}, beyond which rigid blocks have no equilibrium",
                  fos.varied == Varied::strength ? "factor of safety" : "factor", *r.factor);
  r.rigid->trials_hold = held;
  if (!limit.mechanism) return;
  r.mechanism = std::move(limit.mechanism);
  r.failed = std::move(limit.moved);
}

/// Compares the factor, or the highest one that holds where none fails, with the limits of rigid
/// blocks. Returns whether it is beyond them.
bool compare_with_rigid(const Model& model, const Fos& fos, const RigidLimit& found, FosResult& r) {
  const std::optional<double> factor = r.status == FosStatus::above ? r.holds : r.factor;
  if (!factor || !found || found->largest.status != LimitEnd::found) return false;
  const LimitResult& limit = *found;
  RigidBracket rigid;
  rigid.most = limit.largest.upper;
  rigid.least = least_limit(limit);
  rigid.slack = 0.01;  // joints and blocks deform before they fail
  rigid.below_most = limit.of_pebbles || r.holds.value_or(0.0) <= (1.0 + rigid.slack) * rigid.most;
  if (!r.factor && rigid.below_most) return false;  // the highest factor tried is no limit
  const double near = fos.tolerance + 0.02;
  const bool lower = *factor < (1.0 - near) * rigid.least;
  const bool within = *factor < (1.0 - near) * rigid.most;
  const bool bolted = !model.bolts.empty() || !model.bolt_patterns.empty();
  rigid.text = fmt::format(
      "rigid limit analysis: {}; {}", limit.message,
      limit.of_pebbles    ? "its mechanism moves pebbles alone, which do not count here"
      : !rigid.below_most ? "no equilibrium of rigid blocks has a higher factor"
      : lower && bolted   ? "the factor is lower, since bolts count there with all their capacity, "
                            "stretched or not (docs/limit.md)"
      : lower             ? "the factor is lower than theirs (docs/limit.md)"
      : within            ? "the factor lies between theirs"
                          : "the factor agrees with theirs");
  r.rigid = std::move(rigid);
  return !r.rigid->below_most;
}

}  // namespace

Result<FosResult> find_factor(const Model& model, const FosOptions& options) {
  const auto began = std::chrono::steady_clock::now();
  const Fos fos = model.fos.value_or(Fos{});
  Result<FosStart> made = start_trials(model, fos, options);
  if (!made.ok()) return made.faults();
  FosStart& start = made.value();
  const RigidLimit& rigid = start.rigid;
  FosResult r;
  r.criterion = start.plan.criterion;
  r.shaking = start.plan.shaking;
  add_scales(start.sim, r);
  r.blocks = start.sim.scene->blocks.size();
  r.warnings = start.warnings;
  if (start.status != FosStatus::found) {
    r.status = start.status;
    r.message =
        start.status == FosStatus::interrupted ? "stopped before the first trial" : start.message;
  } else {
    Search search(model, fos, first_bracket(fos, rigid, start.seen), start, options, r);
    FosBracket bracket = search.go();
    if (const auto below = factor_below(bracket, rigid)) bracket = search.look_below(*below);
    search.finish();
    bracket.below.reset();  // where the search was stopped before it, the factor is known
    const bool stopped = options.stop != nullptr && *options.stop && bracket.next();
    conclude(bracket, fos, stopped, rigid, r);
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
  if (compare_with_rigid(model, fos, rigid, r)) {
    if (start.as_drawn) {
      take_rigid_limit(fos, *start.rigid, !loose_blocks(start.sim).empty(), r);
    } else {
      r.warnings.push_back(r.rigid->text +
                           "; these refer to the blocks as drawn, and stages have moved them");
    }
  }
  if (rigid && rigid->largest.status == LimitEnd::no_equilibrium && r.holds) {
    r.warnings.push_back(fmt::format(
        "rigid limit analysis: {}; blocks that deform hold at {:.4g}: a sharp tip or a ledge "
        "stands in their way, a gap between them as drawn has closed, or what moves has come loose "
        "before (docs/limit.md)",
        rigid->message, *r.holds));
  }
  r.seconds = since(began);
  return r;
}

}  // namespace edda
