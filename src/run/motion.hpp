// Whether a model is at rest, and what moves fastest where it is not.
#pragma once

#include "run/observe.hpp"
#include "run/outcome.hpp"

namespace edda {

/// A model counts as at rest when forces balance to this part of a contact force, and when no
/// corner would move by this part of its block's half width in as long again as the run took.
inline constexpr double rest_limit = 1e-2;

/// Fills in what the outcome says of it; Outcome::unbalanced is known.
void look_at_motion(const Simulation& sim, const Instant& at, Outcome& outcome);

/// Blocks that fall, touching nothing, while local damping holds them back.
std::size_t held_back_in_fall(const Simulation& sim);

}  // namespace edda
