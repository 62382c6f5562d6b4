// Million block-steps per second of the whole step, on a wall that has had a moment to settle.
//   bench_wall COLUMNS ROWS STEPS THREADS [STEP]      default: 50 40 1000 1
// With a time step (s) it is the implicit method that is measured.
#include <omp.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>

#include "wall.hpp"

int main(int argc, char** argv) {
  long given[] = {50, 40, 1000, 1};
  for (int i = 1; i < std::min(argc, 5); ++i) given[i - 1] = std::strtol(argv[i], nullptr, 10);
  const long columns = given[0], rows = given[1], steps = given[2], threads = given[3];
  const bool implicit = argc == 6;
  if (argc > 6 || std::min({columns, rows, steps, threads}) < 1) {
    std::fprintf(stderr, "usage: bench_wall COLUMNS ROWS STEPS THREADS [STEP]\n");
    return 2;
  }
  omp_set_num_threads(static_cast<int>(threads));

  const std::string solver =
      implicit ? std::string("method = \"dda\"\ntime_step = ") + argv[5] : "";
  edda::Simulation sim = edda::wall(static_cast<int>(columns), static_cast<int>(rows), solver);
  // Damping while a wave runs up and down the wall, none while the clock runs.
  const double height = 0.5 * static_cast<double>(rows), speed = std::sqrt(20e9 / 2600.0);
  edda::Damping& damping = sim.motion.damping;
  (implicit ? damping.mass : damping.local) = implicit ? speed / height : 0.8;
  const double waves = implicit ? 20.0 : 2.0;
  edda::take_steps(sim,
                   std::max(200L, std::lround(waves * height / speed / sim.motion.state.step)));
  damping = {};

  const auto searches = sim.motion.contacts.rebuilds;
  const edda::OpenCloseCounts before = sim.accounts.open_close;
  const auto start = std::chrono::steady_clock::now();
  edda::take_steps(sim, steps);
  const double seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();

  const double blocks = static_cast<double>(sim.scene->blocks.size());
  const double block_steps = blocks * static_cast<double>(steps);
  std::printf("%.3f million block-steps/s, %.1f ns per block and step\n",
              1e-6 * block_steps / seconds, 1e9 * seconds / block_steps);
  std::printf("%zu blocks, %zu candidates, %ld steps of %.3g s, %ld threads, %.3f s\n",
              sim.scene->blocks.size(), sim.motion.contacts.size(), steps, sim.motion.state.step,
              threads, seconds);
  const auto per_step = [&](std::uint64_t now, std::uint64_t then) {
    return static_cast<double>(now - then) / static_cast<double>(steps);
  };
  std::printf("per step: %.2f open-close passes, %.1f contacts that switch; %llu searches\n",
              per_step(sim.accounts.open_close.passes, before.passes),
              per_step(sim.accounts.open_close.switched, before.switched),
              static_cast<unsigned long long>(sim.motion.contacts.rebuilds - searches));
  return 0;
}
