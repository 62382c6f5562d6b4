// Joints and materials that are defined and that no block has.
#pragma once

#include <string>
#include <vector>

#include "run/simulation.hpp"

namespace edda {

/// A warning per joint that no edge of a block has and no contact_pair gives, and per material that
/// no block has: whoever changes them changes nothing.
std::vector<std::string> idle_names(const Simulation& sim);

}  // namespace edda
