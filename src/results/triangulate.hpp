// Polygons with holes as triangles, for viewers that only know convex cells.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "base/polygon.hpp"

namespace edda {

using Triangle = std::array<std::size_t, 3>;

/// Triangles of the region bounded by `rings` ([0] counter-clockwise, holes clockwise; each simple,
/// none crossing another) by ear clipping, holes joined to the outer ring by bridges. Corners are
/// numbered through all rings; triangles run counter-clockwise and cover the region once. O(n^2).
std::vector<Triangle> triangulate(std::span<const Ring> rings);

/// Whether a viewer that fans the ring from its first corner draws it right.
bool is_convex(std::span<const Vec2> ring);

}  // namespace edda
