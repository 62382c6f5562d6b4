#include "run/failure_watch.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "observe/balance.hpp"
#include "run/equilibrium_search.hpp"
#include "run/stages.hpp"

namespace edda {

Watch::Watch(const Simulation& sim)
    : counted_(sim.scene->blocks.size(), 0),
      speed_(sim.scene->blocks.size(), 0.0),
      last_time_(sim.motion.state.time) {
  const std::vector<std::uint8_t> falls = falling_blocks(sim), small = negligible_blocks(sim);
  for (std::size_t i = 0; i < counted_.size(); ++i) {
    const bool loose = !sim.relaxation.loose.empty() && sim.relaxation.loose[i] != 0;
    counted_[i] =
        is_free(sim.scene->blocks, sim.motion.state, i) && !falls[i] && !loose && !small[i] ? 1 : 0;
  }
  for (std::size_t v = 0; v < sim.scene->blocks.vertex_count(); ++v)
    start_.push_back(place(sim, v));
  last_ = start_;
}

Vec2 Watch::place(const Simulation& sim, std::size_t v) const {
  return Vec2{sim.motion.pose.x[v], sim.motion.pose.y[v]} - sim.attached.ground.shift;
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
  for (Id v = sim.scene->blocks.vertex_begin[i]; v < sim.scene->blocks.vertex_begin[i + 1]; ++v) {
    most = std::max(most, norm(place(sim, v) - start_[v]));
  }
  return most;
}

Furthest Watch::velocity(const Simulation& sim) {
  Furthest most;
  const double time = sim.motion.state.time - last_time_;
  last_time_ = sim.motion.state.time;
  for (std::size_t i = 0; i < counted_.size(); ++i) {
    speed_[i] = 0.0;
    if (!counted_[i]) continue;
    for (Id v = sim.scene->blocks.vertex_begin[i]; v < sim.scene->blocks.vertex_begin[i + 1]; ++v) {
      const Vec2 now = place(sim, v);
      if (time > 0.0) speed_[i] = std::max(speed_[i], norm(now - last_[v]) / time);
      last_[v] = now;
    }
    if (speed_[i] > most.value) most = {speed_[i], static_cast<Id>(i)};
  }
  return most;
}

Id Watch::fastest() const {
  const auto most = std::max_element(speed_.begin(), speed_.end());
  return most == speed_.end() || *most == 0.0 ? no_id : static_cast<Id>(most - speed_.begin());
}

Id Watch::goes_beyond(const Simulation& sim, const Least& supported, const Least& falling,
                      double most, double more) const {
  if (!trend_.known()) return no_id;
  const std::vector<std::uint8_t> falls = falling_blocks(sim);
  for (std::size_t i = 0; i < counted_.size(); ++i) {
    const Least& least = falls[i] != 0 ? falling : supported;
    if (!counted_[i] || speed_[i] < least.velocity) continue;
    const double so_far = gone(sim, i);
    if (so_far > least.far && trend_.to_come(i) > (so_far > most ? more : most - so_far))
      return static_cast<Id>(i);
  }
  return no_id;
}

void Watch::count_from_trend(State& state) const {
  if (!trend_.known()) return;
  state.from_x = trend_.then()[0];
  state.from_y = trend_.then()[1];
}

double Watch::prospect(const Simulation& sim, double t) const {
  const std::vector<double> rounding = rounding_of_forces(sim);
  double furthest = -1.0;
  for (std::size_t i = 0; i < counted_.size(); ++i) {
    if (!counted_[i]) continue;
    furthest = std::max(furthest, travel_if_free(sim, i, speed_[i], t, rounding[i]));
  }
  return furthest < 0.0 ? std::numeric_limits<double>::infinity() : furthest;
}

}  // namespace edda
