// What a model defines to no effect: joints, materials, bolts, water.
#pragma once

#include <string>
#include <vector>

#include "step/simulation.hpp"

namespace edda {

/// A warning for each joint that no edge of a block has and no contact_pair gives, and for each
/// material that no block has, for bolts within a single block, and for each water that reaches no
/// face of a free block.
std::vector<std::string> unused_names(const Simulation& sim);

}  // namespace edda
