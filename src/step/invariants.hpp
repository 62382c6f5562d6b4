// What must hold of a simulation after every step, whatever the model: asserted in builds with
// EDDA_CHECKS (debug and sanitizers).
#pragma once

#include <string>

namespace edda {

struct Simulation;

#ifdef EDDA_CHECKS
inline constexpr bool invariants_are_checked = true;
#else
inline constexpr bool invariants_are_checked = false;
#endif

/// The first invariant that does not hold, or nothing: blocks that are there have finite
/// positions, velocities and forces; faces join edges of two blocks, in range, each pair once, with
/// a law; their gates and the positions of their ends lie in [0, 1], what they store and dissipate
/// is not negative; in the explicit method, unless a law depends on slip or a stage glues, an end
/// without bond or dashpot carries no more shear than Coulomb's limit; time does not pass the event
/// that the steps lead to.
std::string broken_invariant(const Simulation& sim);

}  // namespace edda
