#include "run/check_model.hpp"
#include "step/changes.hpp"
#include "step/step.hpp"

#include <omp.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include "base/threads.hpp"
#include "observe/damping_report.hpp"
#include "observe/initial_stress_report.hpp"
#include "observe/load_report.hpp"
#include "observe/observe.hpp"
#include "run/stages.hpp"
#include "run/wall_clock.hpp"
#include "step/contact_pairs.hpp"

namespace edda {
namespace {

constexpr int most_tried = 2000;  // steps

/// Steps per second of wall time, from a few steps that are made for this alone, none of them
/// beyond `end`.
double step_rate(Simulation& sim, double end, double seconds) {
  using Clock = std::chrono::steady_clock;
  const auto start = Clock::now();
  double wall = 0.0;
  int steps = 0;
  const SameThreads afterwards;
  ThreadChoice threads(threads_are_given() ? 1 : omp_get_max_threads());
  while (steps < 2 || (wall < seconds && steps < most_tried)) {
    if (sim.motion.state.time >= end) break;
    if (sim.control.steps_left == 0) fit_step_to(sim, end);
    if (!threads_are_given()) omp_set_num_threads(threads.now());
    if (step(sim)) break;
    ++steps;
    const double before = wall;
    wall = since(start);
    threads.stepped(wall - before);
  }
  return wall > 0.0 ? static_cast<double>(steps) / wall : 0.0;
}

std::size_t fixed_blocks(const Simulation& sim) {
  return static_cast<std::size_t>(std::count_if(sim.scene->blocks.fixed.begin(),
                                                sim.scene->blocks.fixed.end(),
                                                [](auto fixed) { return fixed != 0; }));
}

}  // namespace

ModelCheck check_model(Simulation& sim) {
  ModelCheck found;
  found.fixed = fixed_blocks(sim);
  found.closed = blocks_in_contact(sim, Nearness::touching).size();
  found.within_reach = sim.motion.contacts.size() + sim.point_contacts.size();
  found.critical_step = sim.control.bound.critical_step;
  found.loads = load_report(sim);
  found.initial_stress = initial_stress_report(sim);
  found.strain_damping = strain_damping_report(sim);
  const std::vector<Stage> stages = stages_of(sim.scene->model);
  const auto is_scaled = [](const Stage& s) { return s.masses == StageMasses::scaled; };
  if (!std::all_of(stages.begin(), stages.end(), is_scaled))
    found.step_as_given = first_step(sim, StageMasses::as_given);
  if (std::any_of(stages.begin(), stages.end(), is_scaled))
    found.scaled_step = first_step(sim, StageMasses::scaled);
  scale_masses(sim, stages.front().masses);
  change_damping(sim, stages.front().damping,
                 sim.scene->model.solver.dynamic && !stages.front().to_equilibrium());
  const double duration = sim.scene->model.solver.duration;
  const double tried = most_tried * usual_step(sim);
  const double end = duration > 0.0 ? duration : std::isfinite(tried) ? tried : 1.0;
  start(sim, duration > 0.0 ? std::min(sim.scene->model.output.history_every, duration) : end);
  found.step = sim.motion.state.step;
  for (const Stage& stage : stages) {
    const double step = &stage == &stages.front() ? found.step
                        : is_scaled(stage)        ? found.scaled_step
                                                  : found.step_as_given;
    if (stage.ramp) found.increments += stage.ramp->steps;
    if (duration > 0.0) found.steps += std::max(1.0, std::ceil(stage.longest() / step - 1e-9));
    found.at_most = found.at_most || stage.to_equilibrium();
  }
  found.rate = step_rate(sim, end, 0.5);
  return found;
}

}  // namespace edda
