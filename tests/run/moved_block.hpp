// A block that a test moves by hand.
#pragma once

#include <string>

#include "run/prepared.hpp"

namespace edda::testing {

/// A model of one block of 1 m, and the lines of `besides`.
inline Simulation one_block(const std::string& besides = {}) {
  return prepared(R"([materials.rock]
density = 2500
young = 1e9
poisson = 0.2
[solver]
duration = 1
[[block]]
polygon = [[0, 0], [1, 0], [1, 1], [0, 1]]
)" + besides)
      .sim;
}

/// Advances by a millisecond, to `place(t)` m along the x axis from the position at `start`.
template <class Place>
void move_on(Simulation& sim, const State& start, const Place& place) {
  sim.motion.state.time += 1e-3;
  for (std::size_t k = 0; k < 3; ++k)
    sim.motion.state.x[k][0] = start.x[k][0] + place(sim.motion.state.time);
}

}  // namespace edda::testing
