// Blocks that rest on nothing: neither they nor what they touch is held, and nothing that is lies
// below them. The run of such a model is a fall that nobody asked for.
#pragma once

#include <string>
#include <vector>

#include "run/simulation.hpp"

namespace edda {

using BlockGroup = std::vector<Id>;  ///< blocks that touch each other or share a bolt, ascending

/// Those groups at the start, by their first block. Without gravity nothing falls; blocks that are
/// given a velocity are meant to fly, those that carry loads may hang by them, and those above
/// something held are meant to fall on it: none of these counts. Boundaries hold where they bear
/// something along gravity; of a simulation as created, before start().
std::vector<BlockGroup> resting_on_nothing(const Simulation& sim);

/// One warning where all free blocks fall, else one for each of the first few groups.
std::vector<std::string> warnings_of(const Simulation& sim, const std::vector<BlockGroup>& groups);

}  // namespace edda
