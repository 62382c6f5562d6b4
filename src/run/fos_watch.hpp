// How far and how fast the blocks of a trial go.
#pragma once

#include <cstdint>
#include <vector>

#include "run/trend.hpp"

namespace edda {

/// Largest value over all blocks, and where.
struct Furthest {
  double value = 0.0;
  Id block = no_id;
};

/// Of the corners of all blocks that move, over the ground where that moves.
class Watch {
 public:
  /// From the simulation as it stands. Blocks that touch nothing then fall by themselves and are
  /// left out; so are those that had come loose before, and pebbles:
  /// no slope fails by one.
  explicit Watch(const Simulation& sim);

  /// Largest displacement of a corner since the start, m.
  Furthest displacement(const Simulation& sim) const;
  /// Largest mean velocity of a corner since the last call, m/s; to be called at the ends of
  /// windows of time.
  Furthest velocity(const Simulation& sim);
  /// As far as any block would go within t if it kept its velocity of the last window and the
  /// resultant R of the forces on it, without what rounding makes: v t + R/m t^2/2, m, with its
  /// true mass. Of blocks that touch something now; infinite where none does.
  double prospect(const Simulation& sim, double t) const;

  /// From here on the trend of the motion is followed.
  void begin(const Simulation& sim) { trend_.begin(sim); }
  /// To be called every few steps. Whether the trend has just become known anew.
  bool look_at_trend(const Simulation& sim) { return trend_.look(sim); }
  /// Periods of the motion that it has been followed for.
  double periods() const { return trend_.periods(); }
  /// Whether a block of which a corner has gone further than `far` (m) since the start goes beyond
  /// `most` (m) by its trend; one that has done so already, by `more` (m) at least.
  bool goes_beyond(const Simulation& sim, double far, double most, double more) const;
  /// Displacements count from where the spans of time began in which the trend was seen.
  void count_from_trend(State& state) const;

 private:
  Vec2 place(const Simulation& sim, std::size_t v) const;
  double gone(const Simulation& sim, std::size_t i) const;
  std::vector<std::uint8_t> counted_;  ///< [nb]
  std::vector<Vec2> start_, last_;     ///< [nv]
  std::vector<double> speed_;          ///< [nb] over the last window, m/s
  double last_time_;                   ///< s
  Trend trend_;
};

}  // namespace edda
