// What a simulation holds in memory.
#pragma once

#include <cstddef>

#include "step/simulation.hpp"

namespace edda {

/// Bytes, as the allocator counts them.
struct MemoryInUse {
  std::size_t model = 0, polygons = 0, blocks = 0, state = 0, contacts = 0;
  std::size_t rest = 0;  ///< forces, attachments, scratch
  std::size_t sum() const { return model + polygons + blocks + state + contacts + rest; }
};

/// Takes the simulation apart and counts what each part gives back: nothing is left out when an
/// array is added to it.
MemoryInUse take_apart(Simulation sim);

/// Largest memory of this process so far, bytes.
std::size_t peak_memory();

}  // namespace edda
