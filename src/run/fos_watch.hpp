// How far and how fast the blocks of a trial go.
#pragma once

#include <cstdint>
#include <vector>

#include "run/simulation.hpp"

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
  /// left out, unless `all`; so are those lighter than a thousandth of the mean: no slope fails by
  /// a pebble, and heavier to move for the sake of the step, they take long to find their place.
  Watch(const Simulation& sim, bool all);

  /// Largest displacement of a corner since the start, m.
  Furthest displacement(const Simulation& sim) const;
  /// Largest mean velocity of a corner since the last call, m/s; to be called at the ends of
  /// windows of time.
  Furthest velocity(const Simulation& sim);
  /// As far as any block would go within t if it kept its velocity of the last window and the
  /// resultant R of the forces on it, without what rounding makes: v t + R/m t^2/2, m, with its
  /// true mass. Of blocks that touch something now; infinite where none does.
  double prospect(const Simulation& sim, double t) const;

  /// Windows in sequence in which the furthest corner has gone on with at least half the velocity
  /// of the window before. Each is half a period of the motion (Simulation::pace): damped near
  /// critical, what comes to rest has less than a tenth left. To be called every few steps.
  int windows_gone_on(const Simulation& sim);
  /// A window begins; `first`: of a new sequence.
  void begin_window(const Simulation& sim, bool first);
  /// Displacements count from where the sequence began, and from the ground as it was at the start.
  void count_from_since(State& state) const;

 private:
  Vec2 place(const Simulation& sim, std::size_t v) const;
  Furthest furthest_from(const Simulation& sim, const std::vector<Vec2>& places) const;
  std::vector<std::uint8_t> counted_;        ///< [nb]
  std::vector<Vec2> start_, last_;           ///< [nv]
  std::vector<double> speed_;                ///< [nb] over the last window, m/s
  double last_time_;                         ///< s
  std::vector<Vec2> window_;                 ///< [nv] where the window began
  Nodes since_x_, since_y_;                  ///< of the nodes, where the sequence of windows began
  Vec2 ground_;                              ///< its shift at the start, m
  double window_time_ = 0.0, looked_ = 0.0;  ///< s
  double phase_ = 0.0;                       ///< of the window, so far
  double pace_ = -1.0;                       ///< m/s, in the window before
  int gone_on_ = 0;
};

}  // namespace edda
