// Broad phase: all vertices near edges of other blocks.
#pragma once

#include <cstdint>
#include <vector>

#include "blocks/block_set.hpp"

namespace edda {

struct NearPair {
  Id vertex, edge;
  // clang-tidy 14 takes the zero inside <=> for a pointer. NOLINTNEXTLINE(modernize-use-nullptr)
  friend auto operator<=>(const NearPair&, const NearPair&) = default;
};

/// Every (vertex, edge of another block) nearer than `reach` (m), sorted, with both blocks alive
/// and not both fixed. Uses hashed grids over the edges, with cells as wide as the blocks; O(n),
/// except for blocks much more than a hundred times longer than wide.
std::vector<NearPair> near_pairs(const BlockSet& blocks, const std::vector<std::uint8_t>& alive,
                                 const std::vector<double>& x, const std::vector<double>& y,
                                 double reach);

}  // namespace edda
