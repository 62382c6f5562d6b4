// Forces that begin or end between two steps. Loads count half in the step in which they do
// (attachments/loads.hpp). Contacts and springs begin or end at once; the velocities half a step
// ago are corrected for that.
#include "integrate/leapfrog.hpp"
#include "step/changes.hpp"
#include "step/simulation.hpp"

namespace edda {

/// Nodal forces of step n; none before the first step.
NodalForces forces_now(const Simulation& sim) {
  if (sim.stepper->velocity_lag == 0.0 || sim.control.step_before == 0.0) return {};
  NodalForces found = sim.motion.forces;
  gather_forces(found, sim.scene->blocks, sim.motion.state, sim.motion.pose, sim.motion.on_contacts,
                sim.attached.springs, sim.scene->model.gravity, acting(sim), sim.motion.locked);
  return found;
}

/// `before`: forces_now() before the change.
void note_jump(Simulation& sim, const NodalForces& before) {
  const BlockSet& blocks = sim.scene->blocks;
  NodalForces& jump = sim.motion.jump;
  if (before.x[0].empty()) return;
  const NodalForces now = forces_now(sim);
  if (jump.x[0].empty()) jump = no_forces(blocks);
  for (std::size_t m = 0; m < jump.modes.size(); ++m)
    jump.modes.add(m, now.modes[m] - before.modes[m]);
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    add(vectors_of(now.x, now.y, i) - vectors_of(before.x, before.y, i), jump.x, jump.y, i);
  }
}

/// v_{n-1/2} was made by the forces before the jump. v_n = v_{n-1/2} + a h/2 is not to change, so
/// with the new accelerations a + da the velocity becomes v_{n-1/2} - da h/2.
void split_jump(Simulation& sim) {
  const BlockSet& blocks = sim.scene->blocks;
  const State& state = sim.motion.state;
  NodalForces& jump = sim.motion.jump;
  if (jump.x[0].empty()) return;
  Nodes vx = state.vx, vy = state.vy;
  ModeVectors rate = state.bend_rate;
  bool any = false;
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    const NodeVectors force = vectors_of(jump.x, jump.y, i);
    if (!is_free(blocks, state, i)) continue;
    const BlockModes modes = blocks.modes(i);
    for (std::size_t a = 0; a < modes.count; ++a) {
      const std::size_t m = modes[a];
      const double per = sim.motion.masses.mode_inverse[i];
      rate.add(m, (-0.5 * sim.control.step_before * per) * jump.modes[m]);
      any = any || jump.modes[m] != Vec2{};
    }
    if (force == NodeVectors{}) continue;
    any = true;
    const NodeVectors a = accelerations(sim.motion.masses, i, force);
    add(-0.5 * sim.control.step_before * a, vx, vy, i);
  }
  jump = {};
  if (any) change_velocities(sim, vx, vy, &rate);
}

}  // namespace edda
