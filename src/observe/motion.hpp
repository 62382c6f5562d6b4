// Whether a model is in equilibrium, and what moves fastest where it is not.
#pragma once

#include "observe/observe.hpp"
#include "observe/outcome.hpp"

namespace edda {

/// A model counts as in equilibrium if forces balance to this part of a contact force, and if no
/// vertex would move by this part of its block's half-width in another time as long as the run.
inline constexpr double equilibrium_limit = 1e-2;

/// Fills fastest, speed and at_rest of the outcome; requires Outcome::unbalanced.
void look_at_motion(const Simulation& sim, const Instant& at, Outcome& outcome);

/// Number of blocks in free fall that local damping slows down.
std::size_t slowed_down_in_fall(const Simulation& sim);

}  // namespace edda
