// The variables of the blocks. Leapfrog: positions at step n, velocities at n - 1/2.
#pragma once

#include <cstdint>
#include <vector>

#include "blocks/body_vectors.hpp"

namespace edda {

struct State {
  BodyVectors position;             ///< m (total, not accumulated increments)
  BodyVectors velocity;             ///< half a step earlier, m/s
  BodyVectors reference;            ///< positions from which displacements count, m
  std::vector<std::uint8_t> alive;  ///< [nb] 0: excavated
  std::vector<std::int32_t> turns;  ///< [nb] full rotations counted so far
  double time = 0.0;                ///< s, of the positions
  double step = 0.0;                ///< s, present step
  std::uint64_t steps = 0;          ///< number of steps made
};

}  // namespace edda
