#include "run/trend.hpp"

#include <cmath>
#include <limits>
#include <numbers>

namespace edda {

void Trend::begin(const Simulation& sim) {
  *this = {};
  looked_ = sim.motion.state.time;
  ground_ = sim.attached.ground.shift;
  remember(sim);
}

void Trend::remember(const Simulation& sim) {
  moments_.push_back({effort_, {sim.motion.state.x, sim.motion.state.y}});
  const Vec2 carried = sim.attached.ground.shift - ground_;
  Nodes &nodes_x = moments_.back().nodes[0], &nodes_y = moments_.back().nodes[1];
  for (std::size_t i = 0; i < sim.scene->blocks.size(); ++i) {
    store(vectors_of(nodes_x, nodes_y, i) - at_every_node(carried), nodes_x, nodes_y, i);
  }
  if (moments_.size() > 3) moments_.erase(moments_.begin());
}

bool Trend::look(const Simulation& sim) {
  const double w = sim.relaxation.estimate.frequency, dt = sim.motion.state.time - looked_;
  looked_ = sim.motion.state.time;
  if (w == 0.0) return false;
  phase_ += sim.relaxation.estimate.clock() * dt;
  effort_ += dt / w;
  if (phase_ < half_periods_ * std::numbers::pi) return false;
  remember(sim);
  periods_ = 0.5 * half_periods_;
  // the sequence 2, 3, 4, 6, 8, 12 ...
  half_periods_ += half_periods_ % 3 == 0 ? half_periods_ / 3 : half_periods_ / 2;
  return known();
}

double Trend::to_come(std::size_t i) const {
  constexpr double endless = std::numeric_limits<double>::infinity();
  if (!known()) return endless;
  const auto place = [&](std::size_t m) {
    return centroid(moments_[m].nodes[0], moments_[m].nodes[1], i);
  };
  const double t1 = moments_[1].effort - moments_[0].effort,
               t2 = moments_[2].effort - moments_[1].effort;
  const Vec2 v1 = (place(1) - place(0)) / t1, v2 = (place(2) - place(1)) / t2;
  const double along = dot(v1, v2), before = dot(v1, v1);
  if (along <= 0.0) return 0.0;
  if (along >= before) return endless;
  const double rate = std::log(before / along) / (0.5 * (t1 + t2));
  return norm(v2) * std::exp(-0.5 * rate * t2) / rate;
}

}  // namespace edda
