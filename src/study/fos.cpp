#include "study/fos.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <iterator>

#include "base/gravity.hpp"
#include "base/text.hpp"
#include "observe/balance.hpp"
#include "run/wall_clock.hpp"
#include "study/fos_rigid.hpp"
#include "study/fos_sets.hpp"
#include "study/fos_start.hpp"
#include "study/fos_stiffness.hpp"

namespace edda {
namespace {

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
      r.message += fmt::format(": no larger {} moves it", quantity_varied(fos));
    }
  } else {
    r.factor = 0.5 * (*r.holds + *r.fails);
    r.message = fmt::format("{} {:.4g} (holds at {:.6g}, fails at {:.6g})", quantity_varied(fos),
                            *r.factor, *r.holds, *r.fails);
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

/// Where a factor beyond the limit of rigid blocks holds, the factor is capped by that upper bound:
/// a sharp tip or a small ledge locks the mechanism kinematically, or its blocks have come loose
/// before and do not count in the trials (lost).
void take_rigid_limit(const Fos& fos, LimitResult& limit, bool lost, FosResult& r) {
  const double held = *r.holds;
  const Trial* const last = trial_at(r.trials, held);
  r.rigid->text +=
      fmt::format("; blocks that deform hold up to {:.4g}, after they have moved by {:.3g} m: {}",
                  held, last == nullptr ? 0.0 : last->displacement,
                  lost ? "those that have come loose before do not count"
                       : "a sharp tip or a ledge stands in their way (docs/limit.md)");
  r.warnings.push_back(r.rigid->text);
  r.rigid->below_most = true;
  r.status = FosStatus::found;
  r.holds = limit.largest.lower;
  r.fails = limit.largest.upper;
  r.factor = 0.5 * (*r.holds + *r.fails);
  r.message = fmt::format("{} {:.4g}, beyond which rigid blocks have no equilibrium",
                          quantity_varied(fos), *r.factor);
  r.rigid->trials_hold = held;
  r.proof = "beyond it rigid blocks have no equilibrium";
  if (!limit.mechanism) return;
  r.mechanism = std::move(limit.mechanism);
  r.failed = std::move(limit.moved);
}

/// Compares the factor, or the highest one that holds where none fails, with the limits of rigid
/// blocks. Returns whether it is beyond them.
bool compare_with_rigid(const Model& model, const Fos& fos, const FosOptions& options,
                        const FosStart& start, FosResult& r) {
  const RigidLimit& found = start.rigid;
  const std::optional<double> factor = r.status == FosStatus::above ? r.holds : r.factor;
  if (!factor || !found || found->largest.status != LimitEnd::found) return false;
  const LimitResult& limit = *found;
  RigidBracket rigid;
  rigid.most = limit.largest.upper;
  rigid.least = least_limit(limit);
  rigid.slack = 0.005;  // joints and blocks deform before they fail
  rigid.below_most = r.holds.value_or(0.0) <= (1.0 + rigid.slack) * rigid.most;
  if (!r.factor && rigid.below_most) return false;  // the highest factor tried is no limit
  const BesideLimits beside = beside_limits(*factor, rigid.least, rigid.most);
  const bool lower = beside == BesideLimits::below;
  const bool bolted = !model.bolts.empty() || !model.bolt_patterns.empty();
  rigid.text = fmt::format(
      "rigid limit analysis: {}; {}", limit.message,
      !rigid.below_most ? "no equilibrium of rigid blocks has a higher factor"
      : lower && bolted ? "the factor is lower, since bolts count there with all their capacity, "
                          "stretched or not (docs/limit.md)"
      : lower           ? why_below_rigid(model, fos, options, start, r, rigid.least)
      : beside == BesideLimits::between ? "the factor lies between theirs"
                                        : "the factor agrees with theirs");
  if (model.initial_stress) rigid.text += "; they leave out the initial stress";
  r.rigid = std::move(rigid);
  return !r.rigid->below_most;
}

/// What follows the set that fails first, and what the factor is where blocks may move further.
void add_sets(const Model& model, const Fos& fos, FosStart& start, const FosOptions& options,
              FosResult& r) {
  if (!r.factor) return;
  if (const auto set = first_set(r, start.sim.scene->blocks)) r.sets.push_back(*set);
  find_wide(model, fos, start, options, r);
  find_later_sets(model, fos, start, options, r);
  if (r.holds_wide) {
    r.message += fmt::format(
        "; {:.4g} where a hundredth of its size is too far for a block to move, {:.4g} where a "
        "tenth is",
        *r.factor, 0.5 * (*r.holds_wide + *r.fails_wide));
  }
  if (const std::string sets = sets_text(r); !sets.empty()) r.message += "; " + sets;
}

void warn_of_trials(FosResult& r) {
  for (const Trial& trial : r.trials) {
    if (trial.end == TrialEnd::undecided) {
      r.warnings.push_back(
          fmt::format("the trial of {:.6g} is undecided: {} after {} steps, and counts as failed",
                      trial.factor, trial.reason, trial.steps));
    }
    if (trial.diverged)
      r.warnings.push_back(fmt::format("the trial of {:.6g} {}", trial.factor, trial.reason));
  }
}

/// What shows that the model holds at one end of the bracket and fails at the other.
std::string proof_of(const FosResult& r) {
  std::string text;
  const Trial* const holds = r.holds ? trial_at(r.trials, *r.holds) : nullptr;
  if (holds != nullptr) {
    text =
        fmt::format("at {:.6g} {}", holds->factor,
                    r.criterion.velocity ? holds->reason
                                         : "all blocks are at rest, and the forces found "
                                           "balance the loads within the strength of the joints");
  }
  const Trial* const fails = r.fails ? trial_at(r.trials, *r.fails) : nullptr;
  if (fails == nullptr) return text;
  return text + fmt::format("{}at {:.6g} {}", text.empty() ? "" : "; ", fails->factor,
                            fails->proof
                                ? "rigid blocks have no equilibrium, even if every joint closes "
                                  "that could within the displacement allowed"
                            : fails->end == TrialEnd::fails && fails->part > 0.0
                                ? fmt::format("{} moved by {:.2g} of {} size",
                                              counted(fails->failed.size(), "block"), fails->part,
                                              fails->failed.size() == 1 ? "its" : "their")
                                : fails->reason);
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
    FosSearch search(model, fos, first_bracket(fos, rigid, start.seen), start, options, r);
    FosBracket bracket = search.go();
    if (const auto below = factor_below(bracket, rigid)) bracket = search.look_below(*below);
    search.finish();
    bracket.below.reset();  // where the search was stopped before it, the factor is known
    const bool stopped = options.stop != nullptr && *options.stop && bracket.next();
    conclude(bracket, fos, stopped, rigid, r);
    r.proof = proof_of(r);
    r.mechanism = first_mechanism(start, r);
    if (r.mechanism) find_lost_cohesion(*r.mechanism, search.stable());
  }
  add_sets(model, fos, start, options, r);
  warn_of_trials(r);
  if (compare_with_rigid(model, fos, options, start, r)) {
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
