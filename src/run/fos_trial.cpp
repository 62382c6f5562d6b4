#include "run/fos_trial.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "run/fos_watch.hpp"
#include "run/stages.hpp"

namespace edda {
namespace {

constexpr int windows = 20;           // of a trial
constexpr int increments = 100;       // of what is varied
constexpr int calm_windows = 3;       // in sequence that say that all is at rest
constexpr double left_over = 1e-4;    // of a block's size: what may still be to come
constexpr double decays = 0.5;        // over half a trial: it may yet come to rest
constexpr double for_pictures = 3.0;  // durations that a slow failure is followed for
constexpr std::uint64_t look = 32;    // steps

Loading between(const Loading& from, const Loading& to, double part) {
  Loading now = to;
  if (part >= 1.0) return now;
  for (std::size_t r = 0; r < now.strength.size(); ++r) {
    now.strength[r] = from.strength[r] * std::pow(to.strength[r] / from.strength[r], part);
  }
  now.multiplier = from.multiplier + part * (to.multiplier - from.multiplier);
  return now;
}

TimeHistory scaled(const TimeHistory& given, double by) {
  TimeHistory history = given;
  if (history.time.empty()) history = {{0.0}, {1.0}};
  for (double& value : history.value) value *= by;
  return history;
}

/// A trial under way.
class Run {
 public:
  Run(Simulation& sim, const TrialPlan& plan, Loading from, const Loading& to, bool settles,
      const std::function<bool()>& stops)
      : sim_(sim),
        plan_(plan),
        from_(std::move(from)),
        to_(to),
        stops_(stops),
        settles_(settles),
        watch_(sim, settles),
        start_(sim.state.time),
        steps_(sim.state.steps) {}

  Trial go() {
    const FosCriterion& c = plan_.criterion;
    if (c.shaking > 0.0 && to_.multiplier != 0.0) {
      shake();
    } else {
      ramp();
    }
    if (settles_) {
      follow(40.0 * c.duration);
    } else {
      follow(0.5 * c.duration);
      const double before = trial_.velocity;
      follow(0.5 * c.duration);
      if (trial_.velocity < decays * before) follow(c.duration);
      if (!over_) {
        sim_.change_damping(plan_.released, sim_.dynamic);
        follow(c.duration);
      }
    }
    if (!over_) judge();
    Trial told = trial_;
    if (told.end == TrialEnd::fails && !gone_far_ && !diverged_) {
      over_ = false;
      follow(for_pictures * c.duration);
    }
    return told;
  }

 private:
  double window() const { return plan_.criterion.duration / windows; }

  void end(TrialEnd how, std::string reason) {
    if (over_) return;
    over_ = true;
    note();
    trial_.end = how;
    trial_.reason = std::move(reason);
  }

  void note() {
    const Furthest moved = watch_.displacement(sim_);
    trial_.displacement = moved.value;
    trial_.block = moved.block;
    trial_.time = sim_.state.time - start_;
    trial_.unbalanced = balance_of(sim_).mean;
    trial_.steps = sim_.state.steps - steps_;
  }

  /// Steps to the time; the loading goes with it until `ramp_end`.
  void step_to(double time, double ramp_end) {
    if (over_) return;
    if (sim_.state.steps == 0) {
      sim_.start(time);
    } else {
      sim_.aim_at(time);
    }
    while (!over_ && sim_.state.time < time) {
      if (ramp_end > start_) bring_on((sim_.state.time - start_) / (ramp_end - start_));
      if (const auto failure = sim_.step()) {
        diverged_ = true;
        return end(TrialEnd::fails, "diverged: " + failure->message);
      }
      if (sim_.state.steps % look != 0) continue;
      if (stops_()) return end(TrialEnd::stopped, "stopped");
      see_far();
    }
  }

  void see_far() {
    const double most = settles_ ? 10.0 * plan_.criterion.size : plan_.criterion.displacement;
    if (watch_.displacement(sim_).value <= most) return;
    gone_far_ = true;
    if (trial_.end != TrialEnd::fails) trial_.velocity = watch_.velocity(sim_).value;
    end(TrialEnd::fails, "moved too far");
  }

  void bring_on(double part) {
    const int increment = static_cast<int>(std::min(part, 1.0) * increments);
    if (increment == increment_) return;
    increment_ = increment;
    apply(sim_, plan_, between(from_, to_, static_cast<double>(increment) / increments));
  }

  /// What no stage has switched on acts from now on, from nothing on.
  void switch_on() {
    Spells& spells = sim_.loads.spells;
    Spell* spell = plan_.varied == Varied::load    ? &spells.loads[plan_.target]
                   : plan_.varied == Varied::water ? &spells.waters[plan_.target]
                                                   : nullptr;
    if (spell == nullptr || spell->acts()) return;
    *spell = {start_};
    from_.multiplier = 0.0;
  }

  void ramp() {
    switch_on();
    bring_on(0.0);
    const double end_of_ramp = start_ + plan_.criterion.ramp;
    if (settles_) {  // nothing to bring on: it begins under its loading
      apply(sim_, plan_, to_);
      return;
    }
    for (double t = start_ + window(); t < end_of_ramp && !over_; t += window()) {
      step_to(t, end_of_ramp);
    }
    step_to(end_of_ramp, end_of_ramp);
    if (!over_) apply(sim_, plan_, to_);
    watch_.velocity(sim_);
  }

  void shake() {
    apply(sim_, plan_, to_);
    sim_.loads.spells.shakings[plan_.target] = {start_};
    sim_.change_damping(plan_.shaken, sim_.dynamic);
    step_to(start_ + plan_.criterion.shaking, start_);
    if (over_) return;
    Loading still = to_;
    still.multiplier = 0.0;
    apply(sim_, plan_, still);
    sim_.change_damping(plan_.quiet, sim_.dynamic);
    watch_.velocity(sim_);
  }

  /// From window to window for so long, until all is at rest.
  void follow(double duration) {
    const double begin = sim_.state.time;
    int calm = 0;
    for (int w = 1; w * window() <= duration * (1.0 + 1e-12) && !over_; ++w) {
      step_to(begin + w * window(), start_);
      if (over_) return;
      const double velocity = watch_.velocity(sim_).value;
      if (trial_.end != TrialEnd::fails) trial_.velocity = velocity;
      const double to_come = watch_.prospect(sim_, plan_.criterion.duration);
      calm = to_come <= left_over * plan_.criterion.size ? calm + 1 : 0;
      if (calm == calm_windows && trial_.end != TrialEnd::fails) end(TrialEnd::holds, "at rest");
    }
  }

  /// At the end of its time, neither at rest nor gone far.
  void judge() {
    if (trial_.velocity > plan_.criterion.velocity || settles_) {
      end(TrialEnd::fails, "still moving");
    } else {
      end(TrialEnd::holds, "slower than what fails");
    }
  }

  Simulation& sim_;
  const TrialPlan& plan_;
  Loading from_;
  const Loading& to_;
  const std::function<bool()>& stops_;
  const bool settles_;
  Watch watch_;
  Trial trial_;
  const double start_;  ///< s
  const std::uint64_t steps_;
  int increment_ = -1;
  bool over_ = false, gone_far_ = false, diverged_ = false;
};

}  // namespace

void apply(Simulation& sim, const TrialPlan& plan, const Loading& loading) {
  sim.set_strength_factors(loading.strength);
  const std::size_t q = plan.target;
  const double by = loading.multiplier;
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

Trial run_trial(Simulation& sim, const TrialPlan& plan, const Loading& from, const Loading& to,
                bool settles, const std::function<bool()>& stops) {
  sim.reset_displacements();
  sim.glue_joints(false);
  sim.scale_masses(StageMasses::as_given);
  sim.change_damping(plan.quiet, sim.dynamic);
  return Run(sim, plan, from, to, settles, stops).go();
}

}  // namespace edda
