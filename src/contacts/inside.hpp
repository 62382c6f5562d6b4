// Position of a point relative to a block.
#pragma once

#include <vector>

#include "blocks/block_set.hpp"
#include "blocks/pose.hpp"

namespace edda {

/// Position of a point relative to a block.
struct Inside {
  double depth;  ///< distance from the block's boundary, m; negative outside
  Id edge;       ///< the nearest edge
};

/// Position of p relative to block j in the given pose. O(number of its edges).
Inside inside_of(const BlockSet& blocks, const Pose& pose, Vec2 p, std::size_t j);

/// Whether p lies inside block j, and not on its boundary; for most blocks quicker than the depth.
bool lies_inside(const BlockSet& blocks, const Pose& pose, Vec2 p, std::size_t j);

}  // namespace edda
