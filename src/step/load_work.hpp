// Work of the loads over the motion of a step.
#pragma once

#include "base/parallel.hpp"
#include "step/simulation.hpp"

namespace edda {

/// Sum of f . u over the nodes and modes of all free blocks that carry loads, J: f of the loads
/// with the vertices at x, y; moved(i) the displacements u of the nodes of block i in the method's
/// definition of work, m, and bent(m) those of a mode.
template <class Moved, class Bent>
double load_work(const Simulation& sim, const LoadsNow& now, const std::vector<double>& x,
                 const std::vector<double>& y, Moved moved, Bent bent) {
  if (now.loads == nullptr) return 0.0;
  const std::vector<Id>& loaded = now.loads->blocks;
  return ordered_sum(loaded.size(), [&](std::size_t q) {
    const Id i = loaded[q];
    if (!is_free(sim.scene->blocks, sim.motion.state, i)) return 0.0;
    const BlockModes modes = sim.scene->blocks.modes(i);
    ModeVectors on_modes;
    on_modes.assign(group_size * modes.count, 0.0);
    BlockForces f{sim.scene->blocks, i, {}, modes.count > 0 ? &on_modes : nullptr, modes.first};
    add_loads(f, now, x, y);
    double work = dot(f.nodes, moved(i));
    for (std::size_t a = 0; a < modes.count; ++a)
      work += dot(on_modes[modes[a] - modes.first], bent(modes[a]));
    return work;
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
