// Extrapolation of the motion of blocks: whether they reach equilibrium, and how far they still
// move.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "step/simulation.hpp"

namespace edda {

/// Positions of the blocks at a few moments, at increasing distances in time, so that a trend
/// covers a good part of the motion: after 1, 1.5, 2, 3, 4, 6, 8, 12 ... periods of the motion
/// (FrequencyEstimate). A block that reaches equilibrium slows down by a constant ratio. Under
/// adaptive damping with the frequency w the force that drives a block is 2 zeta w v per mass, so
/// time is counted in dt/w.
class Trend {
 public:
  /// Begins again, without a trend.
  void begin(const Simulation& sim);
  /// Call every few steps. Returns whether a new trend has just been found.
  bool look(const Simulation& sim);
  /// Distance that the centroid of block i will still move in its direction, m: with the mean
  /// velocities v1 and v2 in the last two time spans (in units of dt/w), whose middles are T apart,
  /// it slows down as exp(-ln(v1/v2) t/T). 0 where it reverses; infinite where it does not slow
  /// down, or where there is no trend yet.
  double to_come(std::size_t i) const;
  /// Positions of the nodes two spans ago, x and y.
  const std::array<Nodes, 2>& then() const { return moments_.front().nodes; }
  bool known() const { return moments_.size() == 3; }
  /// Number of periods of the motion so far.
  double periods() const { return periods_; }
  template <class Archive>
  void list(Archive& a);

 private:
  struct Moment {
    double effort = 0.0;  ///< integral of dt/w, s2
    std::array<Nodes, 2> nodes;
  };
  void remember(const Simulation& sim);
  std::vector<Moment> moments_;  ///< the last ones, at most 3
  Vec2 ground_;                  ///< displacement of the ground at the beginning, m
  double looked_ = 0.0;          ///< s, time of the last call
  double phase_ = 0.0;           ///< integral of w dt so far
  double periods_ = 0.0;         ///< number of periods at the last moment
  int half_periods_ = 2;         ///< number of half-periods at the next moment
  double effort_ = 0.0;          ///< s2, integral of dt/w so far
};

template <class Archive>
void Trend::list(Archive& a) {
  std::size_t count = moments_.size();
  a("trend.moments", count);
  if constexpr (Archive::loads) {
    if (count > 3) return a.refuse("a trend has too many moments");
    moments_.resize(count);
  }
  for (std::size_t m = 0; m < count; ++m) {
    const std::string of = "trend." + std::to_string(m);
    a(of + ".effort", moments_[m].effort);
    a(of + ".x", moments_[m].nodes[0]);
    a(of + ".y", moments_[m].nodes[1]);
  }
  a("trend.ground_x", ground_.x);
  a("trend.ground_y", ground_.y);
  a("trend.looked", looked_);
  a("trend.phase", phase_);
  a("trend.periods", periods_);
  a("trend.half_periods", half_periods_);
  a("trend.effort", effort_);
}

}  // namespace edda
