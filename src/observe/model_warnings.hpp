// Warnings before a run: what governs the step, and settings that look right and are not.
#pragma once

#include <string>
#include <vector>

#include "step/simulation.hpp"

namespace edda {

/// What governs the step, for instance "block 12 (slider) at (1, 2): 80 % contacts, 20 % its own
/// elasticity; most of it by the contact with block 7 at (1, 3); other blocks need as small a
/// step". The simulation is as before afterwards.
std::string governed_by(Simulation& sim);

/// Whether gravity acts from the beginning on blocks without stress, and no damping but that of the
/// rock removes the oscillation.
bool gravity_acts_at_once(const Simulation& sim);

/// One sentence per warning, with a remedy. Call for a simulation as created, before start().
std::vector<std::string> model_warnings(const Simulation& sim);

}  // namespace edda
