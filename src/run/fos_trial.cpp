#include "run/fos_trial.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "run/fos_watch.hpp"
#include "run/settling.hpp"
#include "run/stages.hpp"

namespace edda {
namespace {

constexpr double increments = 100.0;  // of what is varied
constexpr std::uint64_t look = 32;    // steps
// Of the displacement that fails: what a corner must have gone for its trend to count, on the way
// and at the very end.
constexpr double visible = 0.3, barely = 0.01;
constexpr double periods_enough = 6.0;  // of the motion, for that
constexpr double far_enough = 100.0;    // displacements that fail: no block deforms by its own size

TimeHistory scaled(const TimeHistory& given, double by) {
  TimeHistory history = given;
  if (history.time.empty()) history = {{0.0}, {1.0}};
  for (double& value : history.value) value *= by;
  return history;
}

/// A trial under way.
class Run {
 public:
  Run(Simulation& sim, const TrialPlan& plan, const Loading& from, const Loading& to,
      const std::function<bool()>& stops)
      : sim_(sim),
        plan_(plan),
        from_(from.multiplier),
        to_(to),
        stops_(stops),
        watch_(sim),
        start_(sim.state.time),
        steps_(sim.state.steps) {}

  Trial go() {
    if (plan_.criterion.shaking > 0.0 && to_.multiplier != 0.0) {
      shake();
    } else {
      switch_on();
    }
    if (!over_) follow();
    return trial_;
  }

 private:
  void end(TrialEnd how, std::string reason) {
    if (over_) return;
    over_ = true;
    const Furthest moved = watch_.displacement(sim_);
    trial_.displacement = moved.value;
    trial_.block = moved.block;
    trial_.time = sim_.state.time - start_;
    trial_.unbalanced = balance_of(sim_).mean;
    trial_.steps = sim_.state.steps - steps_;
    trial_.end = how;
    trial_.reason = std::move(reason);
  }

  /// Steps to the time, or the end.
  void step_to(double time) {
    if (sim_.state.steps == 0) {
      sim_.start(time);
    } else {
      sim_.aim_at(time);
    }
    while (!over_ && sim_.state.time < time) {
      bring_on();
      if (const auto failure = sim_.step()) {
        return end(TrialEnd::fails, "diverged: " + failure->message);
      }
      if (sim_.state.steps % look != 0) continue;
      if (stops_()) return end(TrialEnd::stopped, "stopped");
      see();
    }
  }

  void see() {
    trial_.velocity = watch_.velocity(sim_).value;
    const double most = plan_.criterion.displacement;
    const double gone = watch_.displacement(sim_).value;
    if (gone > (plan_.criterion.slows ? far_enough : 1.0) * most)
      return end(TrialEnd::fails, "moved too far");
    if (!sim_.settles) return;
    if (!sim_.all_on()) return watch_.begin(sim_);
    const bool anew = watch_.look_at_trend(sim_);
    if (gone > most && goes_beyond(1.0)) return end(TrialEnd::fails, "moved too far");
    if (anew && watch_.periods() >= periods_enough) fail_by_trend(visible);
    const double to_come = watch_.prospect(sim_, plan_.criterion.duration);
    calm_ = to_come <= left_over * plan_.criterion.size ? calm_ + 1 : 0;
    if (calm_ == looks_at_rest) end(TrialEnd::holds, "at rest");
  }

  /// Whether a corner goes further than it may by its trend, and has gone this part of it already.
  bool goes_beyond(double part) const {
    const double most = plan_.criterion.displacement;
    return watch_.goes_beyond(sim_, part * most, most, visible * most);
  }

  void fail_by_trend(double part) {
    if (!goes_beyond(part)) return;
    watch_.count_from_trend(sim_.state);
    end(TrialEnd::fails, "keeps moving");
  }

  /// What is varied besides strength, as far as that has come.
  void bring_on() {
    if (plan_.varied != Varied::load && plan_.varied != Varied::water) return;
    const double part = std::floor(increments * sim_.loads.gentle.part) / increments;
    if (part == part_) return;
    part_ = part;
    apply_multiplier(sim_, plan_, from_ + part * (to_.multiplier - from_));
  }

  /// What no stage has switched on acts from now on, from nothing on; all that is varied begins to
  /// come.
  void switch_on() {
    Spells& spells = sim_.loads.spells;
    Spell* spell = plan_.varied == Varied::load    ? &spells.loads[plan_.target]
                   : plan_.varied == Varied::water ? &spells.waters[plan_.target]
                                                   : nullptr;
    if (spell != nullptr && !spell->acts()) {
      *spell = {start_};
      from_ = 0.0;
    }
    settle();
  }

  void settle() {
    sim_.scale_masses(StageMasses::uniform_step);
    sim_.change_damping(plan_.quiet, sim_.dynamic);
    sim_.settles = true;
    sim_.begin_gently(to_.strength, true);
    watch_.begin(sim_);
  }

  void shake() {
    sim_.settles = false;
    sim_.scale_masses(StageMasses::as_given);
    apply(sim_, plan_, to_);
    sim_.loads.spells.shakings[plan_.target] = {start_};
    sim_.change_damping(plan_.shaken, sim_.dynamic);
    step_to(start_ + plan_.criterion.shaking);
    if (over_) return;
    apply_multiplier(sim_, plan_, 0.0);
    settle();
  }

  void follow() {
    step_to(sim_.state.time + most_steps * sim_.step_limit);
    if (!over_) fail_by_trend(barely);
    if (over_) return;
    const bool fails = trial_.velocity > plan_.criterion.velocity;
    end(fails ? TrialEnd::fails : TrialEnd::holds,
        fails ? "still moving" : "slower than what fails");
  }

  Simulation& sim_;
  const TrialPlan& plan_;
  double from_;  ///< multiplier
  const Loading& to_;
  const std::function<bool()>& stops_;
  Watch watch_;
  Trial trial_;
  const double start_;  ///< s
  const std::uint64_t steps_;
  double part_ = -1.0;  ///< of what is varied that has come
  int calm_ = 0;
  bool over_ = false;
};

}  // namespace

void apply_multiplier(Simulation& sim, const TrialPlan& plan, double by) {
  const std::size_t q = plan.target;
  switch (plan.varied) {
    case Varied::strength:
      return;
    case Varied::load:
      sim.model.loads[q].factor = scaled(plan.given.loads[q].factor, by);
      return;
    case Varied::water:
      sim.model.waters[q].unit_weight = by * plan.given.waters[q].unit_weight;
      return;
    case Varied::shaking:
      sim.model.shakings[q].scale = by * plan.given.shakings[q].scale;
      return;
  }
}

void apply(Simulation& sim, const TrialPlan& plan, const Loading& loading) {
  sim.set_strength_factors(loading.strength);
  apply_multiplier(sim, plan, loading.multiplier);
}

Trial run_trial(Simulation& sim, const TrialPlan& plan, const Loading& from, const Loading& to,
                const std::function<bool()>& stops) {
  sim.reset_displacements();
  sim.glue_joints(false);
  return Run(sim, plan, from, to, stops).go();
}

}  // namespace edda
