// Velocities as seen and changed from outside, between two steps.
#include <algorithm>

#include "base/parallel.hpp"
#include "contacts/gaps.hpp"
#include "run/simulation.hpp"

namespace edda {

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
  for (std::size_t k = 0; k < 3; ++k) {
    for (std::size_t i = 0; i < blocks.size(); ++i) {
      if (!is_free(blocks, state, i)) continue;
      state.vx[k][i] = vx[k][i];
      state.vy[k][i] = vy[k][i];
    }
  }
  if (explicit_method()) {
    // The step behind is taken to have been made at them.
    parallel_for(blocks.size(), [&](std::size_t i) {
      if (!is_free(blocks, state, i)) return;
      place_vertices(blocks, state.vx, state.vy, i, pose.x1, pose.y1);
      for (Id v = blocks.vertex_begin[i]; v < blocks.vertex_begin[i + 1]; ++v) {
        pose.x1[v] = pose.x[v] - step_before_ * pose.x1[v];
        pose.y1[v] = pose.y[v] - step_before_ * pose.y1[v];
      }
    });
    look_at_previous_gaps(contacts, pose);
  }
  external_work += ledger_now().balance() - energy;
}

}  // namespace edda
