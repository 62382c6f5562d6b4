// Report of an [initial_stress]: lines, warnings, checks. Empty without one.
#pragma once

#include <string>
#include <vector>

#include "observe/summary.hpp"
#include "step/simulation.hpp"

namespace edda {

/// Fills Accounts::initial except its joints. Call for a simulation as created.
void judge_initial_stress(Simulation& sim);

/// Lines for `edda check` and the start of a run.
std::vector<std::string> initial_stress_report(const Simulation& sim);

/// Warnings before the run, with a remedy.
void warn_of_initial_stress(const Simulation& sim, std::vector<std::string>& warnings);

/// Adds the checks of summary.json.
void add_initial_checks(const Simulation& sim, std::vector<Check>& checks);

}  // namespace edda
