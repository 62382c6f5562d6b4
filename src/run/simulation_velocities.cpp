// Velocities as seen and changed from outside, between two steps.
#include <algorithm>
#include <array>
#include <vector>

#include "base/parallel.hpp"
#include "run/simulation.hpp"

namespace edda {

/// Of the bolts' forces at n on what they go through, at the velocities of n - 1/2, W.
double Simulation::bolt_power() const {
  if (bolts.place.empty()) return 0.0;
  return ordered_sum(blocks.size(), [&](std::size_t i) {
    const bool carried = blocks.fixed[i] && ground.moves;
    if (!carried && !is_free(blocks, state, i)) return 0.0;
    std::array<Vec2, 3> f{};
    add_bolts(f, bolts, i);
    double power = 0.0;
    for (std::size_t k = 0; k < 3; ++k) {
      power += dot(f[k], carried ? ground.velocity : Vec2{state.vx[k][i], state.vy[k][i]});
    }
    return power;
  });
}

void Simulation::exchange_velocity_arrays() {
  for (std::size_t k = 0; k < 3; ++k) {
    std::swap_ranges(state.vx[k].begin(), state.vx[k].end(), old_vx_[k].begin());
    std::swap_ranges(state.vy[k].begin(), state.vy[k].end(), old_vy_[k].begin());
  }
  std::swap(old_vx_, state.vx);
  std::swap(old_vy_, state.vy);
}

void Simulation::change_velocities(const Nodes& vx, const Nodes& vy) {
  const double energy = ledger_now().balance();
  const bool leaps = explicit_method();
  // The step behind is taken to have been made at the new ones: gaps and slips before it. Chains of
  // bolts are not gone back; their forces will do F_n . (u'_n - u_n)/2 more than they give off.
  if (leaps) {
    place_a_step_back(blocks, state, state.vx, state.vy, step_before_, pose);
  }
  const std::vector<double> old_x1 = pose.x1, old_y1 = pose.y1;
  const double bolts_before = leaps ? bolt_power() : 0.0;
  for (std::size_t k = 0; k < 3; ++k) {
    for (std::size_t i = 0; i < blocks.size(); ++i) {
      if (!is_free(blocks, state, i)) continue;
      state.vx[k][i] = vx[k][i];
      state.vy[k][i] = vy[k][i];
    }
  }
  if (leaps) {
    place_a_step_back(blocks, state, state.vx, state.vy, step_before_, pose);
    change_step_behind(contacts, blocks, pose, old_x1, old_y1);
    place_faces(contacts, blocks, pose, laws, step_before_);
    bolts.owed += 0.5 * step_before_ * (bolt_power() - bolts_before);
  }
  external_work += ledger_now().balance() - energy;
}

}  // namespace edda
