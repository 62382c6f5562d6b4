// The complete state at the end of a step, at one time.
#pragma once

#include <vector>

#include "blocks/state.hpp"
#include "forces/nodal_forces.hpp"

namespace edda {

struct Simulation;

/// The state at step n. The leapfrog has velocities at n - 1/2 and forces at n - 1, so the forces
/// at n are computed here on copies, and v_n = (v_{n-1/2} + v_{n+1/2})/2 (theory, section 7.1). The
/// copies are large: do not keep one per row of output.
struct Instant {
  State state;                    ///< x, y and v at n
  BodyVectors forces;             ///< at n, N
  std::vector<Vec2> on_dashpots;  ///< at n, N
};

/// Fills `at` from the simulation after start() or step(). The contacts at that instant are those
/// of the simulation. An Instant that is filled again keeps its memory.
void observe(const Simulation& sim, Instant& at);

}  // namespace edda
