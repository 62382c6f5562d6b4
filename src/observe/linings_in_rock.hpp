// Linings that are drawn into what is there when they come.
#pragma once

#include <string>
#include <vector>

#include "step/simulation.hpp"

namespace edda {

/// A warning for each lining with a corner, as drawn, inside a block or another lining.
std::vector<std::string> linings_in_rock(const Simulation& sim);

}  // namespace edda
