#include "study/fos_trial.hpp"
#include "step/changes.hpp"
#include "step/step.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "run/equilibrium_search.hpp"
#include "run/stages.hpp"
#include "study/fos_watch.hpp"
#include "study/varied_gravity.hpp"

namespace edda {
namespace {

constexpr double increments = 100.0;  // in which a load or water is varied
constexpr std::uint64_t look = 32;    // steps
// Parts of the failure displacement that a vertex must have moved for its trend to count: during a
// trial, and at its end.
constexpr double visible = 0.3, barely = 0.01;
constexpr double periods_enough = 6.0;  // of the motion, before a trend counts
constexpr double far_enough = 100.0;  // times the failure displacement: no block deforms by its own
                                      // size

TimeHistory scaled(const TimeHistory& given, double by) {
  TimeHistory history = given;
  if (history.time.empty()) history = {{0.0}, {1.0}};
  for (double& value : history.value) value *= by;
  return history;
}

/// A trial in progress.
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
        start_(sim.motion.state.time),
        steps_(sim.motion.state.steps) {}

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
    update_face_rows(sim_);
    const Furthest moved = watch_.displacement(sim_);
    trial_.displacement = moved.value;
    trial_.block = moved.block;
    trial_.time = sim_.motion.state.time - start_;
    trial_.unbalanced = balance_of(sim_).mean;
    trial_.steps = sim_.motion.state.steps - steps_;
    trial_.end = how;
    trial_.reason = std::move(reason);
  }

  /// Makes steps until this time, or until the trial ends.
  void step_to(double time) {
    if (sim_.motion.state.steps == 0) {
      start(sim_, time);
    } else {
      fit_step_to(sim_, time);
    }
    while (!over_ && sim_.motion.state.time < time) {
      if (stops_()) return end(TrialEnd::stopped, "stopped");
      advance_gradual_change();
      if (const auto failure = step_ahead(sim_)) {
        return end(TrialEnd::fails, "diverged: " + failure->message);
      }
      if (sim_.motion.state.steps % look == 0) see();
    }
  }

  void see() {
    update_face_rows(sim_);
    trial_.velocity = watch_.velocity(sim_).value;
    const double most = plan_.criterion.displacement;
    const double gone = watch_.displacement(sim_).value;
    if (gone > (plan_.criterion.slows ? far_enough : 1.0) * most)
      return end(TrialEnd::fails, "moved too far");
    if (!sim_.relaxation.seeks_equilibrium) return;
    if (!gradual_change_complete(sim_)) return watch_.begin(sim_);
    const bool anew = watch_.look_at_trend(sim_);
    if (gone > most && goes_beyond(1.0)) return end(TrialEnd::fails, "moved too far");
    if (anew && watch_.periods() >= periods_enough) fail_by_trend(visible);
    const double to_come = watch_.prospect(sim_, plan_.criterion.duration);
    found_in_sequence_ =
        to_come <= equilibrium_travel_ratio * plan_.criterion.size ? found_in_sequence_ + 1 : 0;
    if (found_in_sequence_ == checks_in_sequence) end(TrialEnd::holds, "in equilibrium");
  }

  /// Whether a vertex moves beyond the failure displacement by its trend, and has moved this part
  /// of it already.
  bool goes_beyond(double part) const {
    const double most = plan_.criterion.displacement;
    return watch_.goes_beyond(sim_, part * most, most, visible * most);
  }

  void fail_by_trend(double part) {
    if (!goes_beyond(part)) return;
    watch_.count_from_trend(sim_.motion.state);
    end(TrialEnd::fails, "keeps moving");
  }

  /// Applies what is varied besides strength, in proportion to the gradual change so far.
  void advance_gradual_change() {
    if (plan_.varied != Varied::load && plan_.varied != Varied::water &&
        !changes_gravity(plan_.varied))
      return;
    const double part = std::floor(increments * sim_.attached.loads.gradual.part) / increments;
    if (part == part_) return;
    part_ = part;
    apply_multiplier(sim_, plan_, from_ + part * (to_.multiplier - from_));
  }

  /// Activates the varied load or water, starting from zero, if no stage has done so, and begins
  /// the gradual change.
  void switch_on() {
    ActiveIntervals& intervals = sim_.attached.loads.intervals;
    ActiveInterval* interval = plan_.varied == Varied::load    ? &intervals.loads[plan_.target]
                               : plan_.varied == Varied::water ? &intervals.waters[plan_.target]
                                                               : nullptr;
    if (interval != nullptr && !interval->acts()) {
      *interval = {start_};
      from_ = 0.0;
    }
    settle();
  }

  void settle() {
    scale_masses(sim_, StageMasses::scaled);
    change_damping(sim_, plan_.quiet, sim_.motion.dynamic);
    sim_.relaxation.seeks_equilibrium = true;
    begin_gradually(sim_, to_.strength, true);
    watch_.begin(sim_);
  }

  void shake() {
    sim_.relaxation.seeks_equilibrium = false;
    scale_masses(sim_, StageMasses::as_given);
    apply(sim_, plan_, to_);
    sim_.attached.loads.intervals.shakings[plan_.target] = {start_};
    change_damping(sim_, plan_.shaken, sim_.motion.dynamic);
    step_to(start_ + plan_.criterion.shaking);
    if (over_) return;
    apply_multiplier(sim_, plan_, 0.0);
    settle();
  }

  void follow() {
    step_to(sim_.motion.state.time + most_steps * sim_.control.limit);
    if (!over_) fail_by_trend(barely);
    if (over_) return;
    const bool fails = trial_.velocity > plan_.criterion.velocity;
    end(fails ? TrialEnd::fails : TrialEnd::holds,
        fails ? "still moving" : "slower than the velocity of a failure");
  }

  Simulation& sim_;
  const TrialPlan& plan_;
  double from_;  ///< multiplier at the start
  const Loading& to_;
  const std::function<bool()>& stops_;
  Watch watch_;
  Trial trial_;
  const double start_;  ///< s
  const std::uint64_t steps_;
  double part_ = -1.0;  ///< fraction of the change applied so far
  int found_in_sequence_ = 0;
  bool over_ = false;
};

}  // namespace

void apply_multiplier(Simulation& sim, const TrialPlan& plan, double by) {
  const std::size_t q = plan.target;
  switch (plan.varied) {
    case Varied::strength:
      return;
    case Varied::tilt:
    case Varied::kh:
    case Varied::kv:
    case Varied::gravity:
      sim.scene.edit().model.gravity = varied_gravity(plan.given.gravity, plan.varied, by);
      return;
    case Varied::load:
      sim.scene.edit().model.loads[q].factor = scaled(plan.given.loads[q].factor, by);
      return;
    case Varied::water:
      sim.scene.edit().model.waters[q].unit_weight = by * plan.given.waters[q].unit_weight;
      return;
    case Varied::shaking:
      sim.scene.edit().model.shakings[q].scale = by * plan.given.shakings[q].scale;
      return;
  }
}

void apply(Simulation& sim, const TrialPlan& plan, const Loading& loading) {
  set_strength_factors(sim, loading.strength);
  apply_multiplier(sim, plan, loading.multiplier);
}

Trial run_trial(Simulation& sim, const TrialPlan& plan, const Loading& from, const Loading& to,
                const std::function<bool()>& stops) {
  reset_displacements(sim);
  glue_joints(sim, false);
  return Run(sim, plan, from, to, stops).go();
}

}  // namespace edda
