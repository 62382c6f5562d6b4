#include "integrate/push_block.hpp"

#include <algorithm>
#include <cmath>

#include "integrate/mesh_step.hpp"

namespace edda {
namespace {

BodyVector forces_of(const BlockSet& b, Id i, const EdgeForce& force) {
  BlockForces on{b, i};
  on.at_corner(force.edge, force.at_edge);
  on.at_corner(force.end, force.at_end);
  return on.sum;
}

/// Pushes the modes of block i; returns the forces of the couple of their damping on its nodes.
NodeVectors push_modes(const StepTaken& taken, Id i, const BodyVector& force) {
  const Leap& leap = taken.leap;
  State& s = taken.state;
  const NodeVectors at_n = vectors_of(s.position, i) - leap.h_new * vectors_of(s.velocity, i);
  const Rotation r = rotation(gradient_of(leap.blocks, at_n, i));
  const Kick kick{1.0, velocity_per_acceleration(leap, i), leap.h_new, 0.0};
  if (leap.blocks.is_meshed(i)) {
    push_mesh(s, leap, kick, force, i);
    return {};
  }
  return couple_on_nodes(leap.blocks, r,
                         push_modes(s, of_modes(leap), kick, r, force.modes.of_bending(), i), i);
}

}  // namespace

double mobility(const Leap& leap, Id i, const EdgeForce& force) {
  if (leap.blocks.fixed[i]) return 0.0;
  const BodyVector on = forces_of(leap.blocks, i, force);
  return velocity_per_acceleration(leap, i) *
         dot(accelerations(leap.masses, leap.blocks, i, on), on);
}

double push_block(const StepTaken& taken, Id i, const EdgeForce& force) {
  const Leap& leap = taken.leap;
  const BlockSet& b = leap.blocks;
  State& s = taken.state;
  if (b.fixed[i]) return 0.0;
  BodyVector on = forces_of(b, i, force);
  const BodyVector before = vector_of(b, s.position, i);
  if (on.count > 0) on.nodes = on.nodes + push_modes(taken, i, on);
  NodeVectors dv = velocity_per_acceleration(leap, i) * accelerations(leap.masses, i, on.nodes);
  if (leap.damping.strain != nullptr) {
    const StepsAround step{leap.old_velocity, leap.h_old, leap.h_new};
    dv = damped_change(*leap.damping.strain, b, leap.masses, s, step, i, dv);
  }
  add(dv, s.velocity, i);
  add(leap.h_new * dv, s.position, i);
  BodyVector moved = vector_of(b, s.position, i) - before;
  moved.nodes = leap.h_new * dv;
  place_vertices(b, s.position, i, taken.pose.x, taken.pose.y);
  double largest2 = 0.0;
  for (Id v = b.vertex_begin[i]; v < b.vertex_begin[i + 1]; ++v) {
    const Vec2 of_corner = corner_at(b, moved, v);
    largest2 = std::max(largest2, dot(of_corner, of_corner));
  }
  return std::sqrt(largest2);
}

}  // namespace edda
