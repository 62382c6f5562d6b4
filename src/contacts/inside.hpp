// How a point lies to a block.
#pragma once

#include <vector>

#include "blocks/block_set.hpp"
#include "blocks/pose.hpp"

namespace edda {

/// How a point lies to a block.
struct Inside {
  double depth;  ///< distance from its boundary, m; below zero outside
  Id edge;       ///< the nearest
};

/// How p lies to block j as that lies. O(its edges).
Inside inside_of(const BlockSet& blocks, const Pose& pose, Vec2 p, std::size_t j);

}  // namespace edda
