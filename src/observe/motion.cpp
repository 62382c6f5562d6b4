#include "observe/motion.hpp"

#include <algorithm>
#include <cmath>

#include "step/touching.hpp"

namespace edda {
namespace {

/// Speed of the fastest vertex of block i, m/s.
double corner_speed(const BlockSet& b, const State& s, std::size_t i) {
  double speed = 0.0;
  for (Id v = b.vertex_begin[i]; v < b.vertex_begin[i + 1]; ++v) {
    speed = std::max(speed, norm(corner_at(b, s.velocity, v)));
  }
  return speed;
}

}  // namespace

std::size_t slowed_down_in_fall(const Simulation& sim) {
  const double g = norm(sim.scene->model.gravity);
  if (!(sim.motion.damping.local > 0.0) || sim.relaxation.seeks_equilibrium || g == 0.0) return 0;
  constexpr double begun = 0.01;  // of the half-width: height of fall from which a block counts as
                                  // falling
  const std::vector<std::uint8_t> touches = touching(sim);
  std::size_t count = 0;
  for (std::size_t i = 0; i < sim.scene->blocks.size(); ++i) {
    if (!is_free(sim.scene->blocks, sim.motion.state, i) || touches[i] != 0) continue;
    const double down = dot(centroid(sim.motion.state.velocity, i), sim.scene->model.gravity) / g;
    const double fallen = down * down / (2.0 * (1.0 - sim.motion.damping.local) * g);
    if (down > 0.0 && fallen > begun * sim.scene->blocks.inradius[i]) ++count;
  }
  return count;
}

void look_at_motion(const Simulation& sim, const Instant& at, Outcome& o) {
  o.fastest = no_id;
  o.speed = 0.0;
  o.at_rest = o.unbalanced <= equilibrium_limit;
  for (std::size_t i = 0; i < sim.scene->blocks.size(); ++i) {
    if (!is_free(sim.scene->blocks, sim.motion.state, i)) continue;
    const double speed = corner_speed(sim.scene->blocks, at.state, i);
    const double slow = equilibrium_limit * sim.scene->blocks.inradius[i];
    if (speed * sim.motion.state.time > slow) o.at_rest = false;
    if (o.fastest != no_id && speed <= o.speed) continue;
    o.fastest = static_cast<Id>(i);
    o.speed = speed;
  }
}

}  // namespace edda
