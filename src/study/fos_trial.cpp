#include "study/fos_trial.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "observe/balance.hpp"
#include "run/ramp.hpp"
#include "step/changes.hpp"
#include "step/step.hpp"
#include "study/certificate.hpp"

namespace edda {
namespace {

/// A trial in progress.
class Run {
 public:
  Run(Simulation& sim, const TrialPlan& plan, const Loading& to, const std::function<bool()>& stops)
      : sim_(sim),
        plan_(plan),
        to_(to),
        stops_(stops),
        whole_(sim, sim.relaxation.loose),
        holding_(sim, plan.criterion),
        start_(sim.motion.state.time),
        steps_(sim.motion.state.steps) {}

  Trial go() {
    if (plan_.shaking > 0.0 && to_.value != 0.0) {
      shake();
      if (!over_) hold(to_.strength);
      return trial_;
    }
    double from = value_now();
    // What becomes less does so while joints are as strong as before: they must not break
    // meanwhile.
    const std::vector<double> strength = sim_.motion.laws.divided_by;
    if (to_.value < from && strength != to_.strength) {
      if (!reaches(to_.value, strength)) return trial_;
      from = to_.value;
      holding_ = Holding(sim_, plan_.criterion);
    }
    const int parts = parts_of_change(sim_, plan_.varied, plan_.target, from, to_.value);
    for (int part = 1; part <= parts; ++part) {
      if (part > 1) holding_ = Holding(sim_, plan_.criterion);
      if (!reaches(from + (to_.value - from) * part / parts, to_.strength)) break;
    }
    return trial_;
  }

 private:
  void end(TrialEnd how, std::string reason) {
    if (over_) return;
    over_ = true;
    const Furthest moved = whole_.furthest(sim_);
    trial_.displacement = moved.value;
    trial_.block = holding_.block() == no_id ? moved.block : holding_.block();
    if (trial_.failed.empty()) trial_.failed = holding_.failed();
    trial_.part = holding_.part();
    trial_.time = sim_.motion.state.time - start_;
    trial_.velocity = fastest_block(sim_).value;
    trial_.unbalanced = balance_of(sim_).mean;
    trial_.steps = sim_.motion.state.steps - steps_;
    trial_.end = how;
    if (how == TrialEnd::fails && early_) sim_ = std::move(*early_);
    trial_.reason = std::move(reason);
  }

  void end_by(Verdict verdict) {
    if (verdict == Verdict::not_yet) return;
    end(verdict == Verdict::holds   ? TrialEnd::holds
        : verdict == Verdict::fails ? TrialEnd::fails
                                    : TrialEnd::undecided,
        holding_.reason());
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
      if (const auto failure = step(sim_)) {
        trial_.diverged = true;
        return end(TrialEnd::fails, "diverged: " + failure->message);
      }
      end_by(holding_.look(sim_));
      if (sim_.motion.state.steps == next_proof_) {
        prove_failure();
        next_proof_ += next_proof_ - followed_;
      }
      if (!over_ && !early_ && holding_.part() > moved_little) {
        early_ = sim_;
      }
    }
  }

  /// Of what is varied besides strength; 0 where that does not act yet.
  double value_now() {
    Loads& loads = sim_.attached.loads;
    const SteppedValue* const value = slow_value(loads.slow, plan_.varied, plan_.target);
    if (value == nullptr) return to_.value;
    const ActiveInterval* interval = interval_of(loads.intervals, plan_.varied, plan_.target);
    return interval == nullptr || interval->acts() ? value->value : 0.0;
  }

  /// Changes what is varied besides strength. A load, water or boundary that no stage has
  /// activated begins to act.
  void vary(double to) {
    Loads& loads = sim_.attached.loads;
    SteppedValue* const value = slow_value(loads.slow, plan_.varied, plan_.target);
    if (value == nullptr) return;
    const ActiveInterval* interval = interval_of(loads.intervals, plan_.varied, plan_.target);
    if (interval == nullptr || interval->acts()) return value->change(to, sim_.motion.state.time);
    *value = {to, to};
    const std::vector<Index> row{plan_.target};
    switch_over(sim_, {},
                {plan_.varied == Varied::load ? row : std::vector<Index>{},
                 plan_.varied == Varied::water ? row : std::vector<Index>{},
                 plan_.varied == Varied::boundary ? row : std::vector<Index>{},
                 {}});
  }

  /// Whether the model holds at this value of what is varied, and at this strength.
  bool reaches(double value, const std::vector<double>& strength) {
    over_ = false;
    vary(value);
    hold(strength);
    return trial_.end == TrialEnd::holds;
  }

  /// Applies what has been changed gradually, and follows the model to a verdict.
  void hold(const std::vector<double>& strength) {
    settle(strength);
    follow();
  }

  /// Ends the trial where nothing can hold the blocks within the displacement that it allows.
  void prove_failure() {
    const Criterion& c = plan_.criterion;
    if (over_ || !plan_.rigid_proof || c.displacement || c.velocity) return;
    std::optional<LimitMotion> found =
        without_equilibrium(sim_, strength_, c.allowed, c.least_area, &watch_);
    if (!found) return;
    early_.reset();
    const auto& blocks = found->mechanism.blocks;
    trial_.failed = blocks_of(found->mechanism);
    end(TrialEnd::fails, "rigid blocks have no equilibrium");
    trial_.block = std::max_element(blocks.begin(), blocks.end(), [](const auto& m, const auto& n) {
                     return m.largest < n.largest;
                   })->id;
    State& state = sim_.motion.state;
    found->moved.motion.state.reference = state.position;
    state = std::move(found->moved.motion.state);
    sim_.motion.pose = std::move(found->moved.motion.pose);
    trial_.proof = std::move(found->mechanism);
  }

  void settle(const std::vector<double>& strength) {
    strength_ = strength;
    scale_masses(sim_, StageMasses::scaled);
    change_damping(sim_, plan_.quiet, sim_.motion.dynamic);
    sim_.relaxation.seeks_equilibrium = true;
    begin_gradually(sim_, strength, true);
    holding_.begin(sim_);
  }

  void scale_shaking(double by) {
    sim_.scene.edit().model.shakings[static_cast<std::size_t>(plan_.target)].scale =
        by * plan_.given_scale;
  }

  void shake() {
    sim_.relaxation.seeks_equilibrium = false;
    scale_masses(sim_, StageMasses::as_given);
    set_strength_factors(sim_, to_.strength);
    scale_shaking(to_.value);
    sim_.attached.loads.intervals.shakings[static_cast<std::size_t>(plan_.target)] = {start_};
    change_damping(sim_, plan_.shaken, sim_.motion.dynamic);
    step_to(start_ + plan_.shaking);
    if (!over_) scale_shaking(0.0);
    const double latest = sim_.motion.state.time + most_steps * sim_.control.limit;
    while (!over_ && !is_calm()) {
      if (sim_.motion.state.time > latest) end(TrialEnd::undecided, "still moving");
    }
    if (!over_) lose_velocity(sim_, sim_.attached.ground.velocity);
  }

  /// Follows the motion that the ground has left, as it is damped in the model, for the time T of
  /// the largest block. Whether none has moved meanwhile as seen from its neighbours: what slides
  /// or rocks would go on, and the search for equilibrium would stop it.
  bool is_calm() {
    constexpr double small = 0.05;  // of what is little
    constexpr int looks = 20;
    const RelativeMotion window(sim_);
    bool calm = true;
    for (int look = 0; look < looks && !over_; ++look) {
      step_to(sim_.motion.state.time + longest_rest_time(sim_) / looks);
      calm = calm && window.sets(sim_, small * moved_little, whole_.left()).empty();
    }
    return calm;
  }

  void follow() {
    prove_failure();
    followed_ = sim_.motion.state.steps;
    next_proof_ = followed_ + first_proof;
    step_to(sim_.motion.state.time + most_steps * sim_.control.limit);
    if (!over_) end_by(holding_.at_end(sim_));
  }

  static constexpr std::uint64_t first_proof = 4096;  ///< steps, twice as many each time

  Simulation& sim_;
  const TrialPlan& plan_;
  const Loading& to_;
  const std::function<bool()>& stops_;
  const Judge whole_;  ///< of the whole trial
  Holding holding_;    ///< of this part of it
  /// When blocks had moved by little: joints then lie as they did, so that it shows the mechanism.
  std::optional<Simulation> early_;
  Trial trial_;
  std::vector<double> strength_;                 ///< LawTable::divided_by at the end of the change
  std::uint64_t followed_ = 0, next_proof_ = 0;  ///< steps: since when, and when the next is due
  std::atomic<bool> stop_asked_ = false;
  const ProgramWatch watch_{&stop_asked_, [this] {
                              if (stops_()) stop_asked_ = true;
                            }};
  const double start_;  ///< s
  const std::uint64_t steps_;
  bool over_ = false;
};

}  // namespace

Trial run_trial(Simulation& sim, const TrialPlan& plan, const Loading& to,
                const std::function<bool()>& stops) {
  reset_displacements(sim);
  glue_joints(sim, false);
  return Run(sim, plan, to, stops).go();
}

}  // namespace edda
