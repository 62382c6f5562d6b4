// What [quality] did about slivers, for the user to read.
#pragma once

#include <string>
#include <vector>

#include "lines/polygon_set.hpp"
#include "results/json.hpp"
#include "run/simulation.hpp"

namespace edda {

/// A line for each sliver that was merged, and for each that stays.
std::vector<std::string> sliver_lines(const CutReport& report);

/// The same as lists "merged_slivers" and "kept_slivers".
void add_slivers(Json& json, const CutReport& report);

/// A warning if some stay, with the mass that they seem to have for it.
void warn_of_kept_slivers(const Simulation& sim, std::vector<std::string>& warnings);

}  // namespace edda
