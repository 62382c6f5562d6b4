// Triangulation of polygons that are not convex, for viewers, which draw convex cells.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "base/polygon.hpp"

namespace edda {

using Triangle = std::array<std::uint32_t, 3>;

/// Whether the ring is drawn correctly as a fan of triangles from its first corner.
bool is_convex(std::span<const Vec2> ring);

/// Triangles of the region bounded by `rings` ([0] counter-clockwise, holes clockwise; each simple,
/// none crossing another), by constrained Delaunay triangulation. Corners are numbered through all
/// rings, corners at the same place have the number of the first; triangles run counter-clockwise
/// and cover the region once.
std::vector<Triangle> triangulate(std::span<const Ring> rings);

}  // namespace edda
