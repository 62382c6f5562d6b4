// Smallest area, edge and angle of a block system.
#pragma once

#include <span>

#include "base/vec2.hpp"
#include "cutting/polygon_set.hpp"

namespace edda {

/// Fills the smallest_* members of `report` over all blocks; places are moved by `origin` into
/// model coordinates. Angles between neighbouring edges, inside the block, in degrees.
void measure_quality(std::span<const BlockPolygon> blocks, Vec2 origin, CutReport& report);

/// Whether a block is smaller than min_area or thinner than min_edge. Its thickness is the least
/// distance between two parallel lines that contain it, or, where it is bent,
/// 4 area / perimeter (for a square and a circle this is the width). O(n log n) in its corners.
bool is_sliver(double area, double perimeter, std::span<const Vec2> ring, const Quality& quality);

/// Counts what is still below the limits of [quality] among the cut blocks, an edge between two
/// blocks once for each block. Fills slivers, short_edges and sharp_corners; and where slivers were
/// to be merged, lists those that remain in `kept` and marks them as slow. Places are moved by
/// `origin`.
void judge_blocks(std::span<BlockPolygon> cut, const Quality& quality, Vec2 origin,
                  CutReport& report);

}  // namespace edda
