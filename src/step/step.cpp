#include "step/step.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "step/changes.hpp"
#include "step/instant.hpp"
#include "step/invariants.hpp"
#include "step/simulation.hpp"

namespace edda {

StepInUse step_in_use(const Simulation& sim) {
  const State& state = sim.motion.state;
  const double stable =
      sim.stepper->conditionally_stable ? sim.control.bound.critical_step : state.step;
  return {state.step, stable};
}

void start(Simulation& sim, double first_event) {
  fit_step_to(sim, first_event);
  sim.stepper->start(sim);
}

std::optional<Failure> step(Simulation& sim) {
  std::optional<Failure> failure = sim.stepper->step(sim);
  while (failure && set_aside(sim, *failure)) failure = inspect(sim);
  if constexpr (invariants_are_checked) {
    const std::string broken = failure ? std::string() : broken_invariant(sim);
    if (!broken.empty()) throw std::logic_error("invariant: " + broken);
  }
  return failure;
}

void observe(const Simulation& sim, Instant& at) {
  const Motion& motion = sim.motion;
  at.state = motion.state;
  at.forces = motion.forces;
  gather_forces(at.forces, sim.scene->blocks, motion.state, motion.pose, motion.on_contacts,
                sim.attached.springs, sim.scene->model.gravity, acting(sim), rock_of(sim));
  sim.stepper->complete_instant(sim, at);
}

void finish_step(Simulation& sim) {
  State& state = sim.motion.state;
  StepControl& control = sim.control;
  Accounts& accounts = sim.accounts;
  const double h = state.step;
  ++state.steps;
  --control.steps_left;
  state.time = control.steps_left == 0 ? control.target : state.time + h;
  control.step_before = h;
  accounts.steps.smallest =
      accounts.steps.smallest == 0.0 ? h : std::min(accounts.steps.smallest, h);
  accounts.steps.largest = std::max(accounts.steps.largest, h);
  accounts.steps.sum += h;
  evaluate_zones(sim.scene->zones, sim.scene->blocks, state, water_in_pores(sim), h,
                 sim.motion.zones, sim.motion.masses.viscosity);
}

std::optional<Failure> inspect(const Simulation& sim) {
  if (!std::isfinite(sim.control.last_displacement)) return lost(sim);
  if (sim.accounts.penetration <= sim.scene->smallest_half_width) return std::nullopt;
  return sim.stepper->deep_overlap(sim);
}

Failure lost(const Simulation& sim) {
  return lost_block(sim.scene->blocks, sim.motion.state, sim.motion.pose, sim.motion.forces,
                    step_in_use(sim));
}

}  // namespace edda
