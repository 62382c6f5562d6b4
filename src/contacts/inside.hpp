// Position of a point relative to a block.
#pragma once

#include <vector>

#include "blocks/block_set.hpp"
#include "blocks/pose.hpp"

namespace edda {

/// Distance of p from the boundary of block j in the given pose, m; negative outside. O(number of
/// its edges).
double depth_inside(const BlockSet& blocks, const Pose& pose, Vec2 p, std::size_t j);

/// Whether p lies inside block j, and not on its boundary; for most blocks quicker than the depth.
bool lies_inside(const BlockSet& blocks, const Pose& pose, Vec2 p, std::size_t j);

}  // namespace edda
