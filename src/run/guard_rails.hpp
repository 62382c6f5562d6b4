// What a user should know before a run: what holds the step, and settings that look right and are
// not.
#pragma once

#include <string>
#include <vector>

#include "run/simulation.hpp"

namespace edda {

/// "block 12 (slider) at (1, 2): 80 % contacts, 20 % its own elasticity; most by vertex ... of
/// block ..".
std::string governed_by(const Simulation& sim);

/// One sentence per warning, with what to do. Of a simulation as created, before start().
std::vector<std::string> guard_rails(const Simulation& sim);

}  // namespace edda
