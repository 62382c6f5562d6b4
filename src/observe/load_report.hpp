// What the loads of a model act on, reported before a run.
#pragma once

#include <string>
#include <vector>

#include "step/simulation.hpp"

namespace edda {

/// A line for each load and water: faces or block, resultant at the start and, where a history
/// changes it, its largest factor or rise.
std::vector<std::string> load_report(const Simulation& sim);

}  // namespace edda
