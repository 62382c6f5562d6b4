#include "step/push_block.hpp"

#include <algorithm>
#include <cmath>

namespace edda {
namespace {

NodeVectors on_nodes(const BlockSet& b, const EdgeForce& force) {
  NodeVectors on{};
  spread(on, b, force.edge, force.at_edge);
  spread(on, b, force.end, force.at_end);
  return on;
}

ModesOfBlock on_modes(const BlockSet& b, const BlockModes& modes, Id i, const EdgeForce& force) {
  ModesOfBlock on;
  for (std::size_t a = 0; a < modes.count; ++a)
    on.set(a, modes.of(a, force.edge - b.vertex_begin[i]) * force.at_edge +
                  modes.of(a, force.end - b.vertex_begin[i]) * force.at_end);
  return on;
}

/// Pushes the modes of block i; returns the forces of the couple of their damping on its nodes.
NodeVectors push_modes(const StepTaken& taken, Id i, const EdgeForce& force) {
  const BlockSet& b = taken.blocks;
  State& s = taken.state;
  const BlockModes modes = b.modes(i);
  if (modes.count == 0) return {};
  const NodeVectors at_n = vectors_of(s.x, s.y, i) - taken.h_new * vectors_of(s.vx, s.vy, i);
  const Rotation r = rotation(gradient_of(b, at_n, i));
  const ModeLeap leap{
      b, taken.masses, s.bend, *taken.old_rate, taken.old_vx, taken.old_vy, taken.mode_damping};
  const double couple = push_modes(s, leap, {1.0, taken.kick_of(i), taken.h_new, 0.0}, r,
                                   on_modes(b, modes, i, force), i);
  return couple_on_nodes(b, r, couple, i);
}

}  // namespace

double mobility(const StepTaken& taken, Id i, const EdgeForce& force) {
  const BlockSet& b = taken.blocks;
  if (b.fixed[i]) return 0.0;
  const NodeVectors on = on_nodes(b, force);
  double along = dot(accelerations(taken.masses, i, on), on);
  if (const BlockModes modes = b.modes(i); modes.count > 0) {
    const ModesOfBlock bent = on_modes(b, modes, i, force);
    for (std::size_t a = 0; a < modes.count; ++a)
      along += taken.masses.mode_inverse[i] * dot(bent[a], bent[a]);
  }
  return taken.kick_of(i) * along;
}

double push_block(const StepTaken& taken, Id i, const EdgeForce& force) {
  const BlockSet& b = taken.blocks;
  State& s = taken.state;
  if (b.fixed[i]) return 0.0;
  NodeVectors on = on_nodes(b, force);
  const BlockModes modes = b.modes(i);
  ModesOfBlock bent;
  for (std::size_t a = 0; a < modes.count; ++a) bent.set(a, s.bend[modes[a]]);
  if (modes.count > 0) on = on + push_modes(taken, i, force);
  NodeVectors dv = taken.kick_of(i) * accelerations(taken.masses, i, on);
  if (taken.strain != nullptr) {
    const StepsAround step{taken.old_vx, taken.old_vy, taken.h_old, taken.h_new};
    dv = damped_change(*taken.strain, b, taken.masses, s, step, i, dv);
  }
  add(dv, s.vx, s.vy, i);
  add(taken.h_new * dv, s.x, s.y, i);
  double largest2 = 0.0;
  place_vertices(b, s.x, s.y, s.bend, i, taken.pose.x, taken.pose.y);
  for (Id v = b.vertex_begin[i]; v < b.vertex_begin[i + 1]; ++v) {
    Vec2 moved;
    for (std::size_t k = 0; k < nodes_per_block; ++k) moved += taken.h_new * b.weight[k][v] * dv[k];
    for (std::size_t a = 0; a < modes.count; ++a)
      moved += modes.of(a, v - b.vertex_begin[i]) * (s.bend[modes[a]] - bent[a]);
    largest2 = std::max(largest2, dot(moved, moved));
  }
  return std::sqrt(largest2);
}

}  // namespace edda
