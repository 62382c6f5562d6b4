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
  /// left out, unless `all`.
  Watch(const Simulation& sim, bool all);

  /// Largest displacement of a corner since the start, m.
  Furthest displacement(const Simulation& sim) const;
  /// Largest mean velocity of a corner since the last call, m/s; to be called at the ends of
  /// windows of time.
  Furthest velocity(const Simulation& sim);
  /// As far as any block would go within t if it kept its velocity of the last window and the
  /// resultant R of the forces on it: v t + (1 - local damping) R/m t^2/2, m. Of blocks that touch
  /// something now; infinite where none does.
  double prospect(const Simulation& sim, double t) const;

 private:
  Vec2 place(const Simulation& sim, std::size_t v) const;
  std::vector<std::uint8_t> counted_;  ///< [nb]
  std::vector<Vec2> start_, last_;     ///< [nv]
  std::vector<double> speed_;          ///< [nb] over the last window, m/s
  double last_time_;                   ///< s
};

}  // namespace edda
