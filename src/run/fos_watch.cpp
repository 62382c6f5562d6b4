#include "run/fos_watch.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "run/stages.hpp"

namespace edda {
namespace {

/// [nb] N: what the springs at a block make of the rounding of coordinates. Nothing small that is
/// wedged tight between large blocks is in balance to less.
std::vector<double> rounding_of_forces(const Simulation& sim) {
  std::vector<double> force(sim.blocks.size(), 0.0);
  const ContactSet& c = sim.contacts;
  const double stretch = 0.5 * c.noise;
  for (std::size_t k = 0; k < c.size(); ++k) {
    if (!c.is(k, contact_state::closed)) continue;
    for (const Id i : {c.block_i[k], c.block_j[k]}) force[i] += stretch * c.kn[k];
  }
  return force;
}

}  // namespace

Watch::Watch(const Simulation& sim, bool all)
    : counted_(sim.blocks.size(), 0),
      speed_(sim.blocks.size(), 0.0),
      last_time_(sim.state.time),
      ground_(sim.ground.shift) {
  constexpr double pebble = 1e-3;  // of the mean mass
  const std::vector<std::uint8_t> touches = touching(sim);
  double mass = 0.0, count = 0.0;
  for (std::size_t i = 0; i < counted_.size(); ++i) {
    if (!is_free(sim.blocks, sim.state, i)) continue;
    mass += sim.blocks.mass[i];
    count += 1.0;
  }
  for (std::size_t i = 0; i < counted_.size(); ++i) {
    counted_[i] = is_free(sim.blocks, sim.state, i) && (all || touches[i]) &&
                          sim.blocks.mass[i] * count > pebble * mass
                      ? 1
                      : 0;
  }
  for (std::size_t v = 0; v < sim.blocks.vertex_count(); ++v) start_.push_back(place(sim, v));
  last_ = start_;
}

Vec2 Watch::place(const Simulation& sim, std::size_t v) const {
  return Vec2{sim.pose.x[v], sim.pose.y[v]} - sim.ground.shift;
}

Furthest Watch::displacement(const Simulation& sim) const {
  return furthest_from(sim, start_);
}

Furthest Watch::furthest_from(const Simulation& sim, const std::vector<Vec2>& places) const {
  Furthest most;
  for (std::size_t i = 0; i < counted_.size(); ++i) {
    if (!counted_[i]) continue;
    for (Id v = sim.blocks.vertex_begin[i]; v < sim.blocks.vertex_begin[i + 1]; ++v) {
      const double u = norm(place(sim, v) - places[v]);
      if (u > most.value) most = {u, static_cast<Id>(i)};
    }
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

int Watch::windows_gone_on(const Simulation& sim) {
  phase_ += sim.pace.frequency * (sim.state.time - looked_);
  looked_ = sim.state.time;
  if (phase_ < std::numbers::pi) return gone_on_;
  constexpr double undiminished = 0.5;
  const double pace = furthest_from(sim, window_).value / (looked_ - window_time_);
  const bool goes_on = pace_ >= 0.0 && pace >= undiminished * pace_;
  gone_on_ = goes_on ? gone_on_ + 1 : 0;
  pace_ = pace;
  begin_window(sim, !goes_on);
  return gone_on_;
}

void Watch::begin_window(const Simulation& sim, bool first) {
  phase_ = 0.0;
  window_time_ = looked_ = sim.state.time;
  window_.clear();
  for (std::size_t v = 0; v < start_.size(); ++v) window_.push_back(place(sim, v));
  if (!first) return;
  since_x_ = sim.state.x;
  since_y_ = sim.state.y;
  for (std::size_t k = 0; k < 3; ++k) {
    for (double& x : since_x_[k]) x -= sim.ground.shift.x - ground_.x;
    for (double& y : since_y_[k]) y -= sim.ground.shift.y - ground_.y;
  }
}

void Watch::count_from_since(State& state) const {
  state.from_x = since_x_;
  state.from_y = since_y_;
}

double Watch::prospect(const Simulation& sim, double t) const {
  const std::vector<std::uint8_t> touches = touching(sim);
  const std::vector<double> rounding = rounding_of_forces(sim);
  double furthest = -1.0;
  for (std::size_t i = 0; i < counted_.size(); ++i) {
    if (!counted_[i] || !touches[i]) continue;
    const double resultant = 3.0 * norm(centroid(sim.forces.x, sim.forces.y, i));
    const double acceleration = std::max(resultant - rounding[i], 0.0) / sim.blocks.mass[i];
    furthest = std::max(furthest, speed_[i] * t + 0.5 * acceleration * t * t);
  }
  return furthest < 0.0 ? std::numeric_limits<double>::infinity() : furthest;
}

}  // namespace edda
