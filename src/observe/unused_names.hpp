// Joints and materials that are defined but not used.
#pragma once

#include <string>
#include <vector>

#include "step/simulation.hpp"

namespace edda {

/// A warning for each joint that no edge of a block has and no contact_pair gives, and for each
/// material that no block has: changing them has no effect.
std::vector<std::string> unused_names(const Simulation& sim);

}  // namespace edda
