// Forces that begin or end between two steps. Loads count half in the step in which they do
// (attachments/loads.hpp). Contacts and springs begin or end at once; the velocities half a step
// ago are corrected for that.
#include "integrate/leapfrog.hpp"
#include "step/changes.hpp"
#include "step/simulation.hpp"

namespace edda {

BodyVectors forces_now(const Simulation& sim) {
  if (sim.stepper->velocity_lag == 0.0 || sim.control.step_before == 0.0) return {};
  BodyVectors found = sim.motion.forces;
  gather_forces(found, sim.scene->blocks, sim.motion.state, sim.motion.pose, sim.motion.on_contacts,
                sim.attached.springs, sim.scene->model.gravity, acting(sim), rock_of(sim));
  return found;
}

void note_jump(Simulation& sim, const BodyVectors& before) {
  const BlockSet& blocks = sim.scene->blocks;
  BodyVectors& jump = sim.motion.jump;
  if (is_empty(before)) return;
  const BodyVectors now = forces_now(sim);
  if (is_empty(jump)) jump = zero_vectors(blocks);
  for (std::size_t i = 0; i < blocks.size(); ++i)
    add(vector_of(blocks, now, i) - vector_of(blocks, before, i), blocks, jump, i);
}

void split_jump(Simulation& sim) {
  const BlockSet& blocks = sim.scene->blocks;
  const State& state = sim.motion.state;
  BodyVectors& jump = sim.motion.jump;
  if (is_empty(jump)) return;
  BodyVectors velocity = state.velocity;
  bool any = false;
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    const BodyVector force = vector_of(blocks, jump, i);
    if (!is_free(blocks, state, i) || dot(force, force) == 0.0) continue;
    any = true;
    const BodyVector a = accelerations(sim.motion.masses, sim.scene->blocks, i, force);
    add(-0.5 * sim.control.step_before * a, blocks, velocity, i);
  }
  jump = {};
  if (any) change_velocities(sim, velocity);
}

}  // namespace edda
