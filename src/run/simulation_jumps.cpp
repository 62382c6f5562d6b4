// Forces that begin or end between two steps. Loads count half in the step amid which they do
// (attachments/loads.hpp); contacts and springs do so at once, and the velocities half a step ago
// make up for it.
#include "contacts/joint_laws.hpp"
#include "integrate/leapfrog.hpp"
#include "run/simulation.hpp"

namespace edda {

/// Those of step n on the nodes; none before the first step.
NodalForces Simulation::forces_now() const {
  if (!explicit_method() || step_before_ == 0.0) return {};
  NodalForces found = forces;
  gather_forces(found, blocks, state, pose, contacts, springs, model.gravity, acting());
  return found;
}

/// `before`: forces_now() before something changed.
void Simulation::note_jump(const NodalForces& before) {
  if (before.x[0].empty()) return;
  const NodalForces now = forces_now();
  if (jump.x[0].empty()) {
    for (std::size_t k = 0; k < 3; ++k) {
      jump.x[k].assign(blocks.size(), 0.0);
      jump.y[k].assign(blocks.size(), 0.0);
    }
  }
  for (std::size_t k = 0; k < 3; ++k) {
    for (std::size_t i = 0; i < blocks.size(); ++i) {
      jump.x[k][i] += now.x[k][i] - before.x[k][i];
      jump.y[k][i] += now.y[k][i] - before.y[k][i];
    }
  }
}

/// v_{n-1/2} was made by the forces before the jump: v_n = v_{n-1/2} + a h/2 is to stay, and with
/// the new forces a + da that takes v_{n-1/2} - da h/2.
void Simulation::split_jump() {
  if (jump.x[0].empty()) return;
  Nodes vx = state.vx, vy = state.vy;
  bool any = false;
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    std::array<Vec2, 3> force{};
    bool jumps = false;
    for (std::size_t k = 0; k < 3; ++k) {
      force[k] = {jump.x[k][i], jump.y[k][i]};
      jumps = jumps || force[k] != Vec2{};
    }
    if (!jumps || !is_free(blocks, state, i)) continue;
    any = true;
    const std::array<Vec2, 3> a = accelerations(blocks, i, force);
    for (std::size_t k = 0; k < 3; ++k) {
      vx[k][i] -= 0.5 * step_before_ * a[k].x;
      vy[k][i] -= 0.5 * step_before_ * a[k].y;
    }
  }
  jump = {};
  if (any) change_velocities(vx, vy);
}

}  // namespace edda
