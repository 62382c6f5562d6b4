// Which blocks are in contact or attached.
#pragma once

#include <cstdint>
#include <vector>

namespace edda {

struct Simulation;

/// [nb] 1: the block has a closed contact, or a boundary spring or bolt acts on it.
std::vector<std::uint8_t> touching(const Simulation& sim);

}  // namespace edda
