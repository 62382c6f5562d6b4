// Work of the loads over the motion of a step.
#pragma once

#include "base/parallel.hpp"
#include "step/simulation.hpp"

namespace edda {

/// Sum of f . u over the nodes of all free blocks that carry loads, J: f of the loads with the
/// vertices at x, y; moved(i) the displacements u of the nodes of block i in the method's
/// definition of work, m.
template <class Moved>
double load_work(const Simulation& sim, const LoadsNow& now, const std::vector<double>& x,
                 const std::vector<double>& y, Moved moved) {
  if (now.loads == nullptr) return 0.0;
  const std::vector<Id>& loaded = now.loads->blocks;
  return ordered_sum(loaded.size(), [&](std::size_t q) {
    const Id i = loaded[q];
    if (!is_free(sim.scene->blocks, sim.motion.state, i)) return 0.0;
    NodeVectors f{};
    add_loads(f, sim.scene->blocks, now, x, y, i);
    return dot(f, moved(i));
  });
}

/// The same for the inertia force -m a_n of all blocks in a shaken frame, and for the part of the
/// weight that is not yet applied.
template <class Moved>
double frame_work(const Simulation& sim, const LoadsNow& now, Moved moved) {
  const Vec2 felt = now.gravity_reduction();
  if (felt == Vec2{}) return 0.0;
  return ordered_sum(sim.scene->blocks.size(), [&](std::size_t i) {
    if (!is_free(sim.scene->blocks, sim.motion.state, i)) return 0.0;
    return -sim.scene->blocks.mass[i] / nodes_per_block *
           dot(felt, resultant(moved(static_cast<Id>(i))));
  });
}

}  // namespace edda
