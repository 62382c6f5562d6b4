// Displacements and velocities of the blocks while a model is brought to equilibrium or failure.
#pragma once

#include <cstdint>
#include <vector>

#include "run/trend.hpp"

namespace edda {

/// Largest value of all blocks, and its block.
struct Furthest {
  double value = 0.0;
  Id block = no_id;
};

/// Motion of the vertices of all free blocks, relative to the ground.
class Watch {
 public:
  /// Starts from the present state of the simulation. Left out are blocks without contact in it,
  /// which fall in any case, loose blocks, and pebbles, which are not the failure of a slope.
  explicit Watch(const Simulation& sim);

  /// Largest displacement of a vertex since the start, m.
  Furthest displacement(const Simulation& sim) const;
  /// Largest mean velocity of a vertex since the last call, m/s; call at the ends of time windows.
  Furthest velocity(const Simulation& sim);
  /// The fastest block at that call.
  Id fastest() const;
  /// Largest distance that a block would move within t if it kept its velocity of the last window
  /// and the resultant R of the forces on it, less rounding: v t + R/m t^2/2, m, with its true
  /// mass. A block that has lost its contacts falls and counts, too; infinite where there is none.
  double prospect(const Simulation& sim, double t) const;

  /// Begins to follow the trend of the motion.
  void begin(const Simulation& sim) { trend_.begin(sim); }
  /// Call every few steps. Returns whether a new trend has just been found.
  bool look_at_trend(const Simulation& sim) { return trend_.look(sim); }
  /// Number of periods of the motion since begin().
  double periods() const { return trend_.periods(); }
  /// What a block must have done for its trend to count.
  struct Least {
    double far = 0.0;       ///< m, of a vertex since the start
    double velocity = 0.0;  ///< m/s
  };
  /// A block that will move beyond `most` (m) by its trend; if it has done so already, `more` (m)
  /// further. What it must have done differs for one that falls. no_id: there is
  /// none.
  Id goes_beyond(const Simulation& sim, const Least& supported, const Least& falling, double most,
                 double more) const;
  /// Makes displacements count from the beginning of the time spans in which the trend was found.
  void count_from_trend(State& state) const;
  template <class Archive>
  void list(Archive& a);

 private:
  Vec2 place(const Simulation& sim, std::size_t v) const;
  double gone(const Simulation& sim, std::size_t i) const;
  std::vector<std::uint8_t> counted_;  ///< [nb] 1: observed
  std::vector<Vec2> start_, last_;     ///< [nv]
  std::vector<double> speed_;          ///< [nb] over the last window, m/s
  double last_time_;                   ///< s
  Trend trend_;
};

template <class Archive>
void Watch::list(Archive& a) {
  a("watch.counted", counted_);
  list_points(a, "watch.start", start_);
  list_points(a, "watch.last", last_);
  a("watch.speed", speed_);
  a("watch.last_time", last_time_);
  trend_.list(a);
}

}  // namespace edda
