// Short edges of polygons that fill an area, collapsed to points.
#pragma once

#include <vector>

#include "base/vec2.hpp"

namespace edda {

/// Polygons that fill an area without gaps or overlaps. What has a polygon on one side alone is its
/// border.
struct Tiling {
  std::vector<Vec2> node;              ///< m
  std::vector<std::vector<int>> ring;  ///< nodes of each polygon, counter-clockwise
};

/// Collapses edges shorter than `least`, m, to points, the shortest first, as long as each polygon
/// stays simple, with an interior. Nodes inside are free; those of the border move along its
/// straight sides, whose corners stay, so that the border stays what it was. A node off the line
/// between its neighbours on the border by more than `straight`, m, is a corner. What is thinner
/// than `least`, as triangles whose short edge cannot collapse, is joined to the polygon beyond its
/// longest edge. Edges that are short then lie on the border itself, or between two of its sides.
/// O(n log n).
void collapse_short_edges(Tiling& tiling, double least, double straight);

}  // namespace edda
