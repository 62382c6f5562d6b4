#include "step/push_block.hpp"

namespace edda {

void push_block(const StepTaken& taken, Id i, const NodeVectors& force) {
  const BlockSet& b = taken.blocks;
  State& s = taken.state;
  if (b.fixed[i]) return;
  NodeVectors dv = taken.kick * accelerations(taken.masses, i, force);
  if (taken.strain != nullptr) {
    dv = damped_change(*taken.strain, b, taken.masses, s, taken.h_new, i, dv);
  }
  add(dv, s.vx, s.vy, i);
  add(taken.h_new * dv, s.x, s.y, i);
  place_vertices(b, s.x, s.y, i, taken.pose.x, taken.pose.y);
}

}  // namespace edda
