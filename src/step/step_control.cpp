#include "step/step_control.hpp"

#include <algorithm>
#include <cmath>

#include "forces/viscosity.hpp"
#include "step/simulation.hpp"

namespace edda {

void fit_step_to(Simulation& sim, double time) {
  State& state = sim.motion.state;
  StepControl& control = sim.control;
  control.target = time;
  const double left = time - state.time;
  constexpr double most = 1e18;  // the count must fit its type
  const double asked = std::ceil(left / control.limit * (1.0 - 1e-12));
  const double n = asked >= 1.0 ? std::min(asked, most) : 1.0;
  control.steps_left = static_cast<std::uint64_t>(n);
  const double h = left / n;
  // Equal intervals must give bitwise equal steps; otherwise every row of output would change the
  // step.
  if (std::abs(h - state.step) <= 1e-9 * h && state.step <= control.limit) return;
  state.step = h;
}

void set_limit(Simulation& sim) {
  sim.stepper->set_limit(sim);
}

double usual_step(const Simulation& sim) {
  return sim.control.nominal > 0.0 ? sim.control.nominal : sim.control.limit;
}

StiffnessInputs stiffness_inputs(const Simulation& sim) {
  return stiffness_inputs(sim, sim.scene->blocks);
}

StiffnessInputs stiffness_inputs(const Simulation& sim, const BlockSet& blocks) {
  return {.blocks = blocks,
          .masses = sim.motion.masses,
          .state = sim.motion.state,
          .contacts = sim.motion.contacts,
          .springs = sim.attached.springs,
          .laws = sim.motion.laws,
          .damping = sim.motion.damping,
          .bolts = &sim.attached.bolts,
          .zones = &sim.scene->zones};
}

void set_viscosity(Simulation& sim) {
  fill_viscosity(sim.motion.masses, sim.scene->blocks, sim.motion.damping, sim.scene->zones);
  sim.leapfrog.damping.strain.step = 0.0;
}

}  // namespace edda
