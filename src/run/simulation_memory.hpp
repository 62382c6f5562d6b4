// Checkpoint data of a simulation: everything that cannot be computed again from its model.
#pragma once

#include <string>

#include "checkpoint/record.hpp"
#include "step/simulation.hpp"

namespace edda {

/// Passes on everything that has changed since create(), each value under its own name.
void remember(Simulation& sim, RecordSink& sink);
/// The same, into memory.
void remember(Simulation& sim, Record& record);

/// Restores the state of `record` in a simulation made from the same model. Returns what is wrong
/// with the record (missing, of another size, out of range), empty if nothing is; otherwise `sim`
/// must not be used.
std::string recall(Simulation& sim, const Record& record);

}  // namespace edda
