// Work of the loads over the motion of a step.
#pragma once

#include "base/parallel.hpp"
#include "step/simulation.hpp"

namespace edda {

/// Sum of f . u over all free blocks that carry loads, J: f of the loads with the vertices at x, y;
/// moved(i) the displacements u of block i in the method's definition of work, m.
template <class Moved>
double load_work(const Simulation& sim, const LoadsNow& now, const std::vector<double>& x,
                 const std::vector<double>& y, Moved moved) {
  if (now.loads == nullptr) return 0.0;
  const std::vector<Id>& loaded = now.loads->blocks;
  return ordered_sum(loaded.size(), [&](std::size_t q) {
    const Id i = loaded[q];
    if (!is_free(sim.scene->blocks, sim.motion.state, i)) return 0.0;
    BlockForces f{sim.scene->blocks, i};
    add_loads(f, now, x, y);
    return dot(f.sum, moved(i));
  });
}

/// The same for the inertia force -m a_n of all blocks in a shaken frame, and for the part of the
/// weight that is not yet applied, which act on their nodes alone: nodes_moved(i) is their motion,
/// m.
template <class NodesMoved>
double frame_work(const Simulation& sim, const LoadsNow& now, NodesMoved nodes_moved) {
  const Vec2 felt = now.gravity_reduction();
  if (felt == Vec2{}) return 0.0;
  return ordered_sum(sim.scene->blocks.size(), [&](std::size_t i) {
    if (!is_free(sim.scene->blocks, sim.motion.state, i)) return 0.0;
    return -sim.scene->blocks.mass[i] / nodes_per_block *
           dot(felt, resultant(nodes_moved(static_cast<Id>(i))));
  });
}

}  // namespace edda
