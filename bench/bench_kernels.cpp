// The loops of a step, one by one, on one thread, on a wall after its first two hundred steps.
// Rates are in blocks per second. Arguments: columns and rows of the wall.
#include <benchmark/benchmark.h>
#include <omp.h>

#include <cstdint>
#include <map>
#include <utility>

#include "contacts/place_faces.hpp"
#include "contacts/search.hpp"
#include "forces/stiffness.hpp"
#include "wall.hpp"

namespace edda {
namespace {

/// The wall of the benchmark's arguments; each is settled once and then copied.
Simulation settled(const benchmark::State& bench) {
  static std::map<std::pair<std::int64_t, std::int64_t>, Simulation> walls;
  omp_set_num_threads(1);
  auto& [size, sim] = *walls.try_emplace({bench.range(0), bench.range(1)}).first;
  if (sim.blocks.size() == 0) {
    sim = wall(static_cast<int>(size.first), static_cast<int>(size.second));
    take_steps(sim, 200);
  }
  return sim;
}

void count(benchmark::State& bench, const Simulation& sim) {
  bench.SetItemsProcessed(bench.iterations() * static_cast<std::int64_t>(sim.blocks.size()));
}

void sizes(benchmark::internal::Benchmark* bench) {
  bench->Args({20, 10})->Args({50, 40})->Args({200, 100})->Unit(benchmark::kMicrosecond);
}

void PlaceFaces(benchmark::State& bench) {
  Simulation sim = settled(bench);
  for (auto _ : bench) place_faces(sim.contacts, sim.blocks, sim.pose, sim.laws, sim.state.step);
  count(bench, sim);
}
BENCHMARK(PlaceFaces)->Apply(sizes);

void GatherForces(benchmark::State& bench) {
  Simulation sim = settled(bench);
  for (auto _ : bench) {
    gather_forces(sim.forces, sim.blocks, sim.state, sim.pose, sim.contacts, sim.springs,
                  sim.model.gravity);
  }
  count(bench, sim);
}
BENCHMARK(GatherForces)->Apply(sizes);

void Advance(benchmark::State& bench) {
  Simulation sim = settled(bench);
  const double h = 1e-15;  // s: the arithmetic of any step, but the wall stays where it is
  for (auto _ : bench) {
    advance(sim.state, sim.blocks, sim.forces.x, sim.forces.y, h, h, {});
  }
  count(bench, sim);
}
BENCHMARK(Advance)->Apply(sizes);

void CriticalStep(benchmark::State& bench) {
  Simulation sim = settled(bench);
  for (auto _ : bench) {
    const StepBound bound =
        step_bound(sim.blocks, sim.state, sim.contacts, sim.springs, sim.laws, {});
    benchmark::DoNotOptimize(bound);
  }
  count(bench, sim);
}
BENCHMARK(CriticalStep)->Apply(sizes);

void NearPairs(benchmark::State& bench) {
  Simulation sim = settled(bench);
  for (auto _ : bench) {
    benchmark::DoNotOptimize(
        near_pairs(sim.blocks, sim.state.alive, sim.pose.x, sim.pose.y, sim.base_reach));
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
