// Smallest area, edge and angle of a block system.
#pragma once

#include <span>

#include "base/vec2.hpp"
#include "lines/polygon_set.hpp"

namespace edda {

/// Fills the smallest_* members of `report` over all blocks; places are moved by `origin` into
/// model coordinates. Angles between neighbouring edges, inside the block, in degrees.
void measure_quality(std::span<const BlockPolygon> blocks, Vec2 origin, CutReport& report);

/// Counts what is still below the limits of [quality] among the cut blocks, edges between two
/// blocks once for each. Fills slivers, short_edges and sharp_corners.
void count_poor_blocks(std::span<const BlockPolygon> cut, const Quality& quality,
                       CutReport& report);

}  // namespace edda
