// Everything about the blocks that changes. Leapfrog: positions at step n, velocities at n - 1/2.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace edda {

struct State {
  std::array<std::vector<double>, 3> x, y;  ///< [3][nb] node positions, m (total, never increments)
  std::array<std::vector<double>, 3> vx, vy;  ///< [3][nb] node velocities half a step earlier, m/s
  std::array<std::vector<double>, 3> from_x, from_y;  ///< [3][nb] where displacements count from, m
  std::vector<std::uint8_t> alive;                    ///< [nb] 0: taken out by an excavation
  std::vector<std::int32_t> turns;                    ///< [nb] full turns counted so far
  double time = 0.0;                                  ///< s, of the positions
  double step = 0.0;                                  ///< s, the step in force
  std::uint64_t steps = 0;                            ///< steps taken
};

}  // namespace edda
