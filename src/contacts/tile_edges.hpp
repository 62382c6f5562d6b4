// The edges of a tile: where they are, and the forces on their blocks.
#pragma once

#include <cstddef>
#include <cstdint>

#include "base/vector_loop.hpp"
#include "blocks/edge_forces.hpp"

namespace edda {

/// Vertices of blocks and their neighbours, as in BlockSet.
struct VertexLinks {
  const Id *vertex_begin, *next, *previous;
};

inline VertexLinks vertex_links(const BlockSet& b) {
  return {b.vertex_begin.data(), b.next.data(), b.previous.data()};
}

/// Fills the records of the edges of a tile: start and end. blocks: [count] own ones, halo:
/// [halo_count] edges of others.
void place_edges(const VertexLinks& c, const Id* blocks, std::size_t count, const Id* halo,
                 std::size_t halo_count, const double* x, const double* y, double* to);

/// The forces on the own blocks of a tile: summed on each edge, in the order of their records.
/// wanted: [nb] on which blocks, or null.
void gather_blocks(const EdgeForcesView& on, const Id* blocks, std::size_t count,
                   const std::uint8_t* wanted, const Id* record_begin, const double* records);

}  // namespace edda
