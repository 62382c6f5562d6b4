// All that a simulation cannot work out again from its model: what a checkpoint has to hold.
#pragma once

#include <string>

#include "checkpoint/record.hpp"
#include "run/simulation.hpp"

namespace edda {

/// Adds everything that has changed since create() to `record`, under names of its own.
void remember(const Simulation& sim, Record& record);

/// Brings a simulation made from the same model to where the other one was. Returns what is wrong
/// with the record (missing, of another size, out of range), empty if nothing is; then `sim` is
/// not to be used.
std::string recall(Simulation& sim, const Record& record);

}  // namespace edda
