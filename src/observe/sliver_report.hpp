// Report of the slivers that [quality] has merged or left.
#pragma once

#include <string>
#include <vector>

#include "cutting/polygon_set.hpp"
#include "results/json.hpp"
#include "step/simulation.hpp"

namespace edda {

/// A line for each merged sliver, and for each that remains.
std::vector<std::string> sliver_lines(const CutReport& report);

/// The same as lists "merged_slivers" and "kept_slivers".
void add_slivers(Json& json, const CutReport& report);

/// Adds a warning if some remain, with the inertia added to them by mass scaling.
void warn_of_kept_slivers(const Simulation& sim, std::vector<std::string>& warnings);

}  // namespace edda
