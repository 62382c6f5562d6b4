// Water in the pores of zones: where its pressure cannot be what it is in the ground.
#pragma once

#include <string>
#include <vector>

#include "step/simulation.hpp"

namespace edda {

/// Warns of walls of dry openings in rock with pore pressure, and of tables that end within it.
void warn_of_wet_rock(const Simulation& sim, std::vector<std::string>& warnings);

}  // namespace edda
