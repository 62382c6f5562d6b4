// Limits of model size: memory of the machine, and disk space.
#pragma once

#include <optional>

#include "base/fault.hpp"
#include "step/simulation.hpp"

namespace edda {

/// A fault if the blocks of a model cannot fit into `memory` bytes. Only certain needs are counted,
/// so that no model is refused that would fit; one that needs little more than there is may not be
/// detected.
std::optional<Fault> beyond_memory(const Model& model, double memory);

/// A fault if frames and rows exceed any disk.
std::optional<Fault> beyond_disks(const Simulation& sim);

}  // namespace edda
