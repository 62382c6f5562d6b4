// What is too large to be started: for this machine's memory, for any disk.
#pragma once

#include <optional>

#include "base/fault.hpp"
#include "run/simulation.hpp"

namespace edda {

/// A model whose blocks cannot fit into `memory` bytes. Counts what is certain, so that nothing is
/// refused that would have fitted; what needs little more than there is, is not found here.
std::optional<Fault> beyond_memory(const Model& model, double memory);

/// Frames and rows so many that no disk would hold them.
std::optional<Fault> beyond_disks(const Simulation& sim);

}  // namespace edda
