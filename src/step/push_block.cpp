#include "step/push_block.hpp"

#include <algorithm>
#include <cmath>

namespace edda {

double push_block(const StepTaken& taken, Id i, const NodeVectors& force) {
  const BlockSet& b = taken.blocks;
  State& s = taken.state;
  if (b.fixed[i]) return 0.0;
  NodeVectors dv = taken.kick_of(i) * accelerations(taken.masses, i, force);
  if (taken.strain != nullptr) {
    const StepsAround step{taken.old_vx, taken.old_vy, taken.h_old, taken.h_new};
    dv = damped_change(*taken.strain, b, taken.masses, s, step, i, dv);
  }
  add(dv, s.vx, s.vy, i);
  add(taken.h_new * dv, s.x, s.y, i);
  double largest2 = 0.0;
  place_vertices(b, s.x, s.y, i, taken.pose.x, taken.pose.y);
  for (Id v = b.vertex_begin[i]; v < b.vertex_begin[i + 1]; ++v) {
    Vec2 moved;
    for (std::size_t k = 0; k < nodes_per_block; ++k) moved += taken.h_new * b.weight[k][v] * dv[k];
    largest2 = std::max(largest2, dot(moved, moved));
  }
  return std::sqrt(largest2);
}

}  // namespace edda
