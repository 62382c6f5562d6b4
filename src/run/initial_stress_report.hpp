// What is said of an [initial_stress]: lines, warnings, checks. Nothing without one.
#pragma once

#include <string>
#include <vector>

#include "run/simulation.hpp"
#include "run/summary.hpp"

namespace edda {

/// Fills Simulation::initial but its joints. Of a simulation as created.
void judge_initial_stress(Simulation& sim);

/// Lines for `edda check` and the start of a run.
std::vector<std::string> initial_stress_report(const Simulation& sim);

/// What should be looked at before the run, with what to do.
void warn_of_initial_stress(const Simulation& sim, std::vector<std::string>& warnings);

/// For summary.json.
void add_initial_checks(const Simulation& sim, std::vector<Check>& checks);

}  // namespace edda
