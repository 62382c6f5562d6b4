#include "step/instant.hpp"
#include "step/simulation.hpp"

namespace edda {
namespace {

/// v_{n-1/2} of all blocks, m/s; null before the first step of Newmark's method.
const BodyVectors* half_a_step_back(const Simulation& sim) {
  if (is_explicit(sim)) return &sim.motion.state.velocity;
  return is_empty(sim.implicit.mean_velocity) ? nullptr : &sim.implicit.mean_velocity;
}

/// In the frame in which the blocks move.
Vec2 acceleration_of_motion(const Simulation& sim, const Instant& at, const BlockPoint& point) {
  const BlockSet& b = sim.scene->blocks;
  const Motion& motion = sim.motion;
  if (!is_free(b, motion.state, point.block) || !motion.dynamic) return {};
  const Vec2 v = at_point(b, at.state.velocity, point);
  if (const BodyVectors* const before = half_a_step_back(sim)) {
    const double h = is_explicit(sim) ? motion.state.step : sim.control.step_before;
    return 2.0 / h * (v - at_point(b, *before, point));
  }
  const BodyVector force = vector_of(b, at.forces, point.block);
  return at_point(accelerations(motion.masses, b, point.block, force), point) -
         motion.damping.mass_damping() * v;
}

}  // namespace

Vec2 acceleration_at(const Simulation& sim, const Instant& at, const BlockPoint& point) {
  const Model& model = sim.scene->model;
  const auto of_ground = [&](ShakingKind kind) {
    return ground_acceleration(model, sim.attached.loads.intervals, kind, at.state.time);
  };
  const Vec2 moved = sim.scene->blocks.fixed[point.block] ? of_ground(ShakingKind::base)
                                                          : acceleration_of_motion(sim, at, point);
  return moved + of_ground(ShakingKind::inertia);
}

}  // namespace edda
