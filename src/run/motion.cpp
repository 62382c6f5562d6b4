#include "run/motion.hpp"

#include <algorithm>

namespace edda {
namespace {

/// Speed of the fastest corner of block i, m/s.
double corner_speed(const BlockSet& b, const State& s, std::size_t i) {
  double speed = 0.0;
  for (Id v = b.vertex_begin[i]; v < b.vertex_begin[i + 1]; ++v) {
    speed = std::max(speed, norm(vertex_at(b, s.vx, s.vy, v)));
  }
  return speed;
}

}  // namespace

void look_at_motion(const Simulation& sim, const Instant& at, Outcome& o) {
  o.fastest = no_id;
  o.speed = 0.0;
  o.at_rest = o.unbalanced <= rest_limit;
  for (std::size_t i = 0; i < sim.blocks.size(); ++i) {
    if (!is_free(sim.blocks, sim.state, i)) continue;
    const double speed = corner_speed(sim.blocks, at.state, i);
    const double slow = rest_limit * sim.blocks.inradius[i];
    if (speed * sim.state.time > slow) o.at_rest = false;
    if (o.fastest != no_id && speed <= o.speed) continue;
    o.fastest = static_cast<Id>(i);
    o.speed = speed;
  }
}

}  // namespace edda
