// Mass scaling of a simulation, so that single blocks do not govern the step.
#include <algorithm>
#include <cmath>
#include <limits>

#include "forces/mass_scaling.hpp"
#include "step/energy_balance.hpp"
#include "step/simulation.hpp"

namespace edda {

/// Plans the mass scaling of slivers that the cut could not merge: they are to allow the step that
/// all other blocks allow, but none becomes heavier than the block of median mass.
void plan_slivers(Simulation& sim) {
  const BlockSet& blocks = sim.scene->blocks;
  StepControl& control = sim.control;
  const auto& cut = sim.scene->polygons.blocks;
  const auto slow = [](const BlockPolygon& block) { return block.slow; };
  if (!sim.stepper->conditionally_stable || std::none_of(cut.begin(), cut.end(), slow)) return;
  const double whole = std::numeric_limits<double>::infinity();
  const std::vector<double> own = steps_of_blocks(stiffness_inputs(sim), whole);
  double others = whole;
  std::vector<double> masses;
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    if (cut[i].slow || !std::isfinite(own[i])) continue;
    others = std::min(others, own[i]);
    masses.push_back(blocks.mass[i]);
  }
  if (masses.empty()) return;
  const auto middle = masses.begin() + static_cast<std::ptrdiff_t>(masses.size() / 2);
  std::nth_element(masses.begin(), middle, masses.end());
  control.sliver_step = others;
  control.sliver_most.assign(blocks.size(), 1.0);
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    if (cut[i].slow) control.sliver_most[i] = std::max(1.0, *middle / blocks.mass[i]);
  }
}

/// Raises the masses of blocks that would hold the step below the requested one. A block in motion
/// keeps its momentum, and the energy that it loses by that is accounted as `step_change`; where a
/// stage scales all masses it keeps its velocity, since a jump would open joints on the way to
/// equilibrium, and the energy is work of the stage.
void raise_masses(Simulation& sim) {
  const BlockSet& blocks = sim.scene->blocks;
  Masses& masses = sim.motion.masses;
  State& state = sim.motion.state;
  StepControl& control = sim.control;
  const Solver& solver = sim.scene->model.solver;
  const bool slivers = control.scaled_step == 0.0 && solver.mass_scaling == 0.0;
  const double step = control.scaled_step > 0.0 ? control.scaled_step
                      : slivers                 ? control.sliver_step
                      : solver.time_step        ? solver.mass_scaling
                                                : solver.mass_scaling / solver.safety;
  const bool moving = state.steps > 0;
  const double energy = moving ? total_energy(sim) : 0.0;
  std::vector<double> most;
  if (slivers) {
    most = control.sliver_most;
    for (std::size_t i = 0; i < masses.raised.size(); ++i) most[i] /= masses.raised[i];
  }
  const std::vector<double> factor = scale_block_masses(
      masses, stiffness_inputs(sim), step, slivers ? &most : nullptr, &control.step_cache);
  if (factor.empty()) return;
  set_viscosity(sim);
  if (masses.raised.empty()) masses.raised.assign(blocks.size(), 1.0);
  for (std::size_t i = 0; i < blocks.size(); ++i) masses.raised[i] *= factor[i];
  if (!moving) return;
  if (control.scaled_step > 0.0) {
    sim.accounts.external_work += total_energy(sim) - energy;
    return;
  }
  for (std::size_t i = 0; i < blocks.size(); ++i)
    store(vector_of(blocks, state.velocity, i) / factor[i], blocks, state.velocity, i);
  sim.accounts.step_change_energy += total_energy(sim) - energy;
}

double uniform_step(const Simulation& sim) {
  double longest = 0.0;
  for (const double own :
       steps_of_blocks(stiffness_inputs(sim), std::numeric_limits<double>::infinity())) {
    if (std::isfinite(own)) longest = std::max(longest, own);
  }
  return longest;
}

void scale_masses(Simulation& sim, StageMasses masses) {
  StepControl& control = sim.control;
  const bool uniform = masses == StageMasses::scaled;
  if (!uniform && control.scaled_step == 0.0) return;
  const double energy = total_energy(sim);
  sim.motion.masses = given_masses(sim.scene->blocks);
  set_viscosity(sim);
  control.scaled_step = uniform ? uniform_step(sim) : 0.0;
  sim.accounts.step_change_energy += total_energy(sim) - energy;
}

}  // namespace edda
