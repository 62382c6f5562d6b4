#include "run/motion.hpp"

#include <algorithm>
#include <cmath>

#include "run/stages.hpp"

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

std::size_t held_back_in_fall(const Simulation& sim) {
  const double g = norm(sim.model.gravity);
  if (!(sim.damping.local > 0.0) || sim.settles || g == 0.0) return 0;
  constexpr double begun = 0.01;  // of the half width: what has fallen so far is on its way
  const std::vector<std::uint8_t> touches = touching(sim);
  std::size_t count = 0;
  for (std::size_t i = 0; i < sim.blocks.size(); ++i) {
    if (!is_free(sim.blocks, sim.state, i) || touches[i] != 0) continue;
    const double down = dot(centroid(sim.state.vx, sim.state.vy, i), sim.model.gravity) / g;
    const double fallen = down * down / (2.0 * (1.0 - sim.damping.local) * g);
    if (down > 0.0 && fallen > begun * sim.blocks.inradius[i]) ++count;
  }
  return count;
}

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
