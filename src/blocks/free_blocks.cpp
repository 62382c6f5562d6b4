#include "blocks/free_blocks.hpp"

namespace edda {
namespace {

EDDA_VECTOR void complete_all(FreeForces f, std::size_t begin, std::size_t end) {
  for (std::size_t k = 0; k < nodes_per_block; ++k) {
#pragma omp simd
    for (std::size_t i = begin; i < end; ++i) f.complete(k, i);
  }
}

}  // namespace

void add_to_free(const BlockSet& b, const State& s, const ForcesToAdd& forces, std::size_t begin,
                 std::size_t end) {
  const FreeMarks free(b, s, begin, end);
  complete_all(free_forces(forces, free), begin, end);
}

void add_to_modes(const BlockSet& b, const ForcesToAdd& f, std::size_t begin, std::size_t end) {
  b.for_mode_places(begin, end, [&](std::size_t first, std::size_t last) {
    for (std::size_t m = first; m < last; ++m) f.forces.modes.add(m, f.on.modes[m]);
  });
}

}  // namespace edda
