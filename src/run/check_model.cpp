#include "run/check_model.hpp"

#include <omp.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include "base/threads.hpp"
#include "contacts/face_reading.hpp"
#include "run/damping_report.hpp"
#include "run/initial_stress_report.hpp"
#include "run/load_report.hpp"
#include "run/observe.hpp"
#include "run/stages.hpp"

namespace edda {
namespace {

constexpr int most_tried = 2000;  // steps

/// Steps per second of wall time, from a few steps made and thrown away, none of them after `end`.
double step_rate(Simulation& sim, double end, double seconds) {
  using Clock = std::chrono::steady_clock;
  const auto start = Clock::now();
  double wall = 0.0;
  int steps = 0;
  const SameThreads afterwards;
  ThreadChoice threads(threads_are_said() ? 1 : omp_get_max_threads());
  while (steps < 2 || (wall < seconds && steps < most_tried)) {
    if (sim.state.time >= end) break;
    if (!threads_are_said()) omp_set_num_threads(threads.now());
    if (sim.step()) break;
    ++steps;
    const double before = wall;
    wall = std::chrono::duration<double>(Clock::now() - start).count();
    threads.stepped(wall - before);
  }
  return wall > 0.0 ? static_cast<double>(steps) / wall : 0.0;
}

std::size_t held_blocks(const Simulation& sim) {
  return static_cast<std::size_t>(std::count_if(sim.blocks.fixed.begin(), sim.blocks.fixed.end(),
                                                [](auto fixed) { return fixed != 0; }));
}

}  // namespace

ModelCheck check_model(Simulation& sim) {
  ModelCheck found;
  found.held = held_blocks(sim);
  for (std::size_t k = 0; k < sim.contacts.size(); ++k) {
    found.closed += meets(sim.contacts, k);
  }
  for (std::size_t k = 0; k < sim.point_contacts.size(); ++k) {
    found.closed += meets(sim.point_contacts, sim.blocks, sim.pose, k, sim.contacts.noise);
  }
  found.within_reach = sim.contacts.size() + sim.point_contacts.size();
  found.critical_step = sim.bound.critical_step;
  found.loads = load_report(sim);
  found.initial_stress = initial_stress_report(sim);
  found.strain_damping = strain_damping_report(sim);
  const std::vector<Stage> stages = stages_of(sim.model);
  const auto is_static = [](const Stage& s) { return s.masses == StageMasses::uniform_step; };
  if (!std::all_of(stages.begin(), stages.end(), is_static))
    found.step_as_given = first_step(sim, StageMasses::as_given);
  if (std::any_of(stages.begin(), stages.end(), is_static))
    found.static_step = first_step(sim, StageMasses::uniform_step);
  sim.scale_masses(stages.front().masses);
  sim.change_damping(stages.front().damping,
                     sim.model.solver.dynamic && stages.front().until != StageEnd::equilibrium);
  const double duration = sim.model.solver.duration;
  const double tried = most_tried * sim.usual_step();
  const double end = duration > 0.0 ? duration : std::isfinite(tried) ? tried : 1.0;
  sim.start(duration > 0.0 ? std::min(sim.model.output.history_every, duration) : end);
  found.step = sim.state.step;
  for (const Stage& stage : stages) {
    const double step = &stage == &stages.front() ? found.step
                        : is_static(stage)        ? found.static_step
                                                  : found.step_as_given;
    if (duration > 0.0) found.steps += std::max(1.0, std::ceil(stage.duration / step - 1e-9));
    found.at_most = found.at_most || stage.until == StageEnd::equilibrium;
  }
  found.rate = step_rate(sim, end, 0.5);
  return found;
}

}  // namespace edda
