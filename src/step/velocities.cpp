// Velocities as read and changed from outside, between two steps.
#include <algorithm>
#include <vector>

#include "step/changes.hpp"
#include "step/contact_search.hpp"
#include "step/energy_balance.hpp"
#include "step/simulation.hpp"
#include "step/tile_step.hpp"

namespace edda {

void exchange_velocity_arrays(Simulation& sim) {
  State& state = sim.motion.state;
  LeapfrogStep& own = sim.leapfrog;
  for (std::size_t k = 0; k < nodes_per_block; ++k) {
    std::swap_ranges(state.velocity.x[k].begin(), state.velocity.x[k].end(),
                     own.old_velocity.x[k].begin());
    std::swap_ranges(state.velocity.y[k].begin(), state.velocity.y[k].end(),
                     own.old_velocity.y[k].begin());
  }
  std::swap(own.old_velocity.x, state.velocity.x);
  std::swap(own.old_velocity.y, state.velocity.y);
}

void change_velocities(Simulation& sim, const BodyVectors& velocity) {
  const BlockSet& blocks = sim.scene->blocks;
  State& state = sim.motion.state;
  Pose& pose = sim.motion.pose;
  const StepControl& control = sim.control;
  const AsExternalWork work(sim);
  const bool leaps = sim.stepper->velocity_lag > 0.0;
  // The last step is taken to have been made with the new velocities, which changes closures and
  // slips before it. Chains of bolts are not changed back; their forces will do F_n . (u'_n -
  // u_n)/2 more work than the bolts lose.
  if (leaps) {
    place_a_step_back(blocks, state, control.step_before, pose);
  }
  const std::vector<double> old_x1 = pose.x1, old_y1 = pose.y1;
  const double bolts_before = leaps ? bolt_power(sim) : 0.0;
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    if (is_free(blocks, state, i)) store(vector_of(blocks, velocity, i), blocks, state.velocity, i);
  }
  if (leaps) {
    place_a_step_back(blocks, state, control.step_before, pose);
    change_faces(sim, [&](const FaceSet& faces, FaceStates& states) {
      correct_last_step(faces, states, blocks, pose, old_x1, old_y1);
    });
    reevaluate_at_n(sim, control.step_before);
    sum_contact_forces(sim);
    sim.attached.bolts.work_pending += 0.5 * control.step_before * (bolt_power(sim) - bolts_before);
  }
}

void lose_velocity(Simulation& sim, Vec2 v) {
  Ground& ground = sim.attached.ground;
  if (v == Vec2{}) return;
  const FaceStates faces = take_faces(sim);
  State& state = sim.motion.state;
  Pose& pose = sim.motion.pose;
  const AsExternalWork work(sim);
  const bool leaps = sim.stepper->velocity_lag > 0.0;
  const Vec2 last = leaps ? sim.control.step_before * v : Vec2{};
  for (std::size_t i = 0; i < sim.scene->blocks.size(); ++i) {
    if (is_free(sim.scene->blocks, state, i)) add(at_every_node(-1.0 * v), state.velocity, i);
  }
  for (std::size_t p = 0; p < pose.x1.size(); ++p) {
    pose.x1[p] += last.x;
    pose.y1[p] += last.y;
  }
  for (Vec2& shift : sim.attached.springs.shift_1) shift += last;
  for (FreeFieldColumn& column : sim.attached.free_field.columns) {
    for (Vec2& of_column : column.velocity) of_column -= v;
  }
  ground.shift_1 += last;
  ground.velocity -= v;
  put_faces(sim, faces);
}

}  // namespace edda
