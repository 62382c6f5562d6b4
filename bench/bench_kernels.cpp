// The loops of a step, one by one, on one thread, on a wall after its first two hundred steps.
// Rates are in blocks per second. Arguments: columns and rows of the wall.
#include <benchmark/benchmark.h>
#include <omp.h>

#include <cstdint>
#include <map>
#include <utility>

#include "contacts/search.hpp"
#include "forces/step_bound.hpp"
#include "step/contact_search.hpp"
#include "step/tile_step.hpp"
#include "wall.hpp"

namespace edda {
namespace {

/// The wall of the benchmark's arguments; each is settled once and then copied.
Simulation settled(const benchmark::State& bench) {
  static std::map<std::pair<std::int64_t, std::int64_t>, Simulation> walls;
  omp_set_num_threads(1);
  auto& [size, sim] = *walls.try_emplace({bench.range(0), bench.range(1)}).first;
  if (sim.scene->blocks.size() == 0) {
    sim = wall(static_cast<int>(size.first), static_cast<int>(size.second));
    take_steps(sim, 200);
  }
  return sim;
}

void count(benchmark::State& bench, const Simulation& sim) {
  bench.SetItemsProcessed(bench.iterations() * static_cast<std::int64_t>(sim.scene->blocks.size()));
}

void sizes(benchmark::internal::Benchmark* bench) {
  bench->Args({20, 10})->Args({50, 40})->Args({200, 100})->Unit(benchmark::kMicrosecond);
}

void PlaceFaces(benchmark::State& bench) {
  Simulation sim = settled(bench);
  for (auto _ : bench) reevaluate_at_n(sim, sim.motion.state.step);
  count(bench, sim);
}
BENCHMARK(PlaceFaces)->Apply(sizes);

void GatherForces(benchmark::State& bench) {
  Simulation sim = settled(bench);
  for (auto _ : bench) {
    gather_forces(sim.motion.forces, sim.scene->blocks, sim.motion.state, sim.motion.pose,
                  sim.motion.on_contacts, sim.attached.springs, sim.scene->model.gravity);
  }
  count(bench, sim);
}
BENCHMARK(GatherForces)->Apply(sizes);

void Advance(benchmark::State& bench) {
  Simulation sim = settled(bench);
  Motion& motion = sim.motion;
  const StepDamping damping;
  const double h = 1e-15;  // s: the arithmetic of any step, but the wall stays where it is
  for (auto _ : bench) {
    advance(motion.state, {sim.scene->blocks, motion.masses, motion.forces, motion.state.velocity,
                           h, h, damping});
  }
  count(bench, sim);
}
BENCHMARK(Advance)->Apply(sizes);

void CriticalStep(benchmark::State& bench) {
  Simulation sim = settled(bench);
  for (auto _ : bench) {
    const StepBound bound = step_bound(stiffness_inputs(sim));
    benchmark::DoNotOptimize(bound);
  }
  count(bench, sim);
}
BENCHMARK(CriticalStep)->Apply(sizes);

void NearPairs(benchmark::State& bench) {
  Simulation sim = settled(bench);
  for (auto _ : bench) {
    benchmark::DoNotOptimize(near_pairs(sim.scene->blocks, sim.motion.state.alive,
                                        sim.motion.pose.x, sim.motion.pose.y,
                                        sim.scene->base_reach));
  }
  count(bench, sim);
}
BENCHMARK(NearPairs)->Apply(sizes);

void WholeStep(benchmark::State& bench) {
  Simulation sim = settled(bench);
  for (auto _ : bench) take_steps(sim, 1);
  count(bench, sim);
}
BENCHMARK(WholeStep)->Apply(sizes);

}  // namespace
}  // namespace edda
