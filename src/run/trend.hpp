// Where blocks go by the trend of their motion: whether they come to rest, and how far from here.
#pragma once

#include <array>
#include <vector>

#include "run/simulation.hpp"

namespace edda {

/// Places of blocks at a few moments, each further from the last one as time goes on, so that a
/// motion is judged over a good part of the time that it has had: after 1, 1.5, 2, 3, 4, 6, 8,
/// 12 ... periods of the motion (Pace). What slows down to rest goes slower and slower by the same
/// ratio; under adaptive damping with the frequency w what drives a block is 2 zeta w v, so that
/// time counts by dt/w.
class Trend {
 public:
  /// Nothing is known yet.
  void begin(const Simulation& sim);
  /// To be called every few steps. Whether it has just become known anew.
  bool look(const Simulation& sim);
  /// How far the centroid of block i will still go in its direction, m: by the mean velocities v1
  /// and v2 in the last two spans of time (in units of dt/w), whose middles are T apart, it slows
  /// down as exp(-ln(v1/v2) t/T). 0 where it turns round; infinite where it does not slow down, or
  /// nothing is known.
  double to_come(std::size_t i) const;
  /// Positions of the nodes two spans ago, x and y.
  const std::array<Nodes, 2>& then() const { return moments_.front().nodes; }
  bool known() const { return moments_.size() == 3; }
  /// Periods of the motion that it has followed.
  double periods() const { return periods_; }

 private:
  struct Moment {
    double effort = 0.0;  ///< of dt/w, s2
    std::array<Nodes, 2> nodes;
  };
  void remember(const Simulation& sim);
  std::vector<Moment> moments_;  ///< the last ones, up to 3
  Vec2 ground_;                  ///< its shift at the beginning, m
  double looked_ = 0.0;          ///< s
  double phase_ = 0.0;           ///< of w dt, so far
  double periods_ = 0.0;         ///< up to the last moment
  int half_periods_ = 2;         ///< up to the next moment
  double effort_ = 0.0;          ///< s2, so far
};

}  // namespace edda
