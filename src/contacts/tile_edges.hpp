// The edges of a tile: where they are, and the forces on their blocks.
#pragma once

#include <cstddef>
#include <cstdint>

#include "base/vector_loop.hpp"
#include "blocks/block_set.hpp"

namespace edda {

/// Vertex data in the layout of BlockSet.
struct Corners {
  ConstNodeValues weight;
  const Id *vertex_begin, *next, *previous;
};

inline Corners corners_of(const BlockSet& b) {
  return {values_of(b.weight), b.vertex_begin.data(), b.next.data(), b.previous.data()};
}

/// Fills the records of the edges of a tile: start and end. blocks: [count] own ones, halo:
/// [halo_count] edges of others.
void place_edges(const Corners& c, const Id* blocks, std::size_t count, const Id* halo,
                 std::size_t halo_count, const double* x, const double* y, double* to);

/// The forces on the modes of the blocks (blocks/bending.hpp), to be filled; null where none bends.
struct ModeForces {
  const Bending* bending = nullptr;
  double *x = nullptr, *y = nullptr;
};
inline ModeForces mode_forces(const BlockSet& b, ModeVectors& on) {
  if (!b.bending.any()) return {};
  return {&b.bending, on.x.data(), on.y.data()};
}

/// The forces on the nodes and modes of the own blocks of a tile: summed on each edge, then spread
/// from its two corners (Eq. 15). wanted: [nb] for which blocks, or null.
void gather_blocks(const Corners& c, const Id* blocks, std::size_t count,
                   const std::uint8_t* wanted, const Id* record_begin, const double* records,
                   NodeValues fx, NodeValues fy, ModeForces modes);

}  // namespace edda
