// Joints that are drawn open, such as those of masonry with its mortar.
#pragma once

#include <string>
#include <vector>

#include "cutting/polygon_set.hpp"

namespace edda {

/// Moves edges of blocks that face each other across a gap of at most `width` (m) to the middle
/// between them. Returns a sentence about what moved, empty where nothing did. Blocks must not have
/// holes. O(n log n) in edges where gaps are narrow.
std::string close_gaps(std::vector<BlockPolygon>& blocks, double width);

}  // namespace edda
