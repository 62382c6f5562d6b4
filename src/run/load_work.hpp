// Work of the loads over the motion of a step.
#pragma once

#include <array>

#include "base/parallel.hpp"
#include "run/simulation.hpp"

namespace edda {

/// Sum of f . u over the nodes of all free blocks that carry loads, J: f of the loads with the
/// vertices at x, y; moved(i, k) the displacement u of node k of block i that the method counts, m.
template <class Moved>
double load_work(const Simulation& sim, const LoadsNow& now, const std::vector<double>& x,
                 const std::vector<double>& y, Moved moved) {
  if (now.loads == nullptr) return 0.0;
  const std::vector<Id>& loaded = now.loads->blocks;
  return ordered_sum(loaded.size(), [&](std::size_t q) {
    const Id i = loaded[q];
    if (!is_free(sim.blocks, sim.state, i)) return 0.0;
    std::array<Vec2, 3> f{};
    add_loads(f, sim.blocks, now, x, y, i);
    double work = 0.0;
    for (std::size_t k = 0; k < 3; ++k) work += dot(f[k], moved(i, k));
    return work;
  });
}

/// The same of the inertia that all blocks feel on a ground that shakes, -m a_n . u, and of the
/// weight that has not come yet.
template <class Moved>
double frame_work(const Simulation& sim, const LoadsNow& now, Moved moved) {
  const Vec2 felt = now.less_gravity();
  if (felt == Vec2{}) return 0.0;
  return ordered_sum(sim.blocks.size(), [&](std::size_t i) {
    if (!is_free(sim.blocks, sim.state, i)) return 0.0;
    Vec2 sum;
    for (std::size_t k = 0; k < 3; ++k) sum += moved(static_cast<Id>(i), k);
    return -sim.blocks.mass[i] / 3.0 * dot(felt, sum);
  });
}

}  // namespace edda
