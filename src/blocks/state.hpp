// The variables of the blocks. Leapfrog: positions at step n, velocities at n - 1/2.
#pragma once

#include <cstdint>
#include <vector>

#include "blocks/bending.hpp"
#include "blocks/nodes.hpp"

namespace edda {

struct State {
  Nodes x, y;                   ///< [nodes][nb] positions, m (total, not accumulated increments)
  Nodes vx, vy;                 ///< [nodes][nb] velocities half a step earlier, m/s
  Nodes from_x, from_y;         ///< [nodes][nb] positions from which displacements count, m
  ModeVectors bend, bend_rate;  ///< [modes] amplitudes, m, and their velocities half a step
                                ///< earlier, m/s (blocks/bending.hpp)
  ModeVectors from_bend;        ///< [modes] amplitudes from which displacements count, m
  std::vector<std::uint8_t> alive;  ///< [nb] 0: excavated
  std::vector<std::int32_t> turns;  ///< [nb] full rotations counted so far
  double time = 0.0;                ///< s, of the positions
  double step = 0.0;                ///< s, present step
  std::uint64_t steps = 0;          ///< number of steps made
};

}  // namespace edda
