#include "run/fos_watch.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "run/settling.hpp"
#include "run/stages.hpp"

namespace edda {

Watch::Watch(const Simulation& sim)
    : counted_(sim.blocks.size(), 0), speed_(sim.blocks.size(), 0.0), last_time_(sim.state.time) {
  const std::vector<std::uint8_t> touches = touching(sim), small = pebbles(sim);
  for (std::size_t i = 0; i < counted_.size(); ++i) {
    const bool loose = !sim.aloof.empty() && sim.aloof[i] != 0;
    counted_[i] = is_free(sim.blocks, sim.state, i) && touches[i] && !loose && !small[i] ? 1 : 0;
  }
  for (std::size_t v = 0; v < sim.blocks.vertex_count(); ++v) start_.push_back(place(sim, v));
  last_ = start_;
}

Vec2 Watch::place(const Simulation& sim, std::size_t v) const {
  return Vec2{sim.pose.x[v], sim.pose.y[v]} - sim.ground.shift;
}

Furthest Watch::displacement(const Simulation& sim) const {
  Furthest most;
  for (std::size_t i = 0; i < counted_.size(); ++i) {
    if (!counted_[i]) continue;
    const double u = gone(sim, i);
    if (u > most.value) most = {u, static_cast<Id>(i)};
  }
  return most;
}

double Watch::gone(const Simulation& sim, std::size_t i) const {
  double most = 0.0;
  for (Id v = sim.blocks.vertex_begin[i]; v < sim.blocks.vertex_begin[i + 1]; ++v) {
    most = std::max(most, norm(place(sim, v) - start_[v]));
  }
  return most;
}

Furthest Watch::velocity(const Simulation& sim) {
  Furthest most;
  const double time = sim.state.time - last_time_;
  last_time_ = sim.state.time;
  for (std::size_t i = 0; i < counted_.size(); ++i) {
    speed_[i] = 0.0;
    if (!counted_[i]) continue;
    for (Id v = sim.blocks.vertex_begin[i]; v < sim.blocks.vertex_begin[i + 1]; ++v) {
      const Vec2 now = place(sim, v);
      if (time > 0.0) speed_[i] = std::max(speed_[i], norm(now - last_[v]) / time);
      last_[v] = now;
    }
    if (speed_[i] > most.value) most = {speed_[i], static_cast<Id>(i)};
  }
  return most;
}

bool Watch::goes_beyond(const Simulation& sim, double far, double most, double more) const {
  if (!trend_.known()) return false;
  for (std::size_t i = 0; i < counted_.size(); ++i) {
    if (!counted_[i]) continue;
    const double so_far = gone(sim, i);
    if (so_far > far && trend_.to_come(i) > (so_far > most ? more : most - so_far)) return true;
  }
  return false;
}

void Watch::count_from_trend(State& state) const {
  if (!trend_.known()) return;
  state.from_x = trend_.then()[0];
  state.from_y = trend_.then()[1];
}

double Watch::prospect(const Simulation& sim, double t) const {
  const std::vector<std::uint8_t> touches = touching(sim);
  const std::vector<double> rounding = rounding_of_forces(sim);
  double furthest = -1.0;
  for (std::size_t i = 0; i < counted_.size(); ++i) {
    if (!counted_[i] || !touches[i]) continue;
    furthest = std::max(furthest, way_unheld(sim, i, speed_[i], t, rounding[i]));
  }
  return furthest < 0.0 ? std::numeric_limits<double>::infinity() : furthest;
}

}  // namespace edda
