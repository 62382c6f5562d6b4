// Rings and polygons, and their exact moments by simplex integration.
#pragma once

#include <span>
#include <vector>

#include "base/vec2.hpp"

namespace edda {

using Ring = std::vector<Vec2>;  ///< vertices in order, the first not repeated at the end

/// Integrals over a polygon. Second moments are about the centroid.
struct Moments {
  double area = 0.0;  ///< m2; negative for a clockwise ring
  Vec2 centroid;      ///< m
  double sxx = 0.0;   ///< integral of (x - cx)^2, m4
  double syy = 0.0;   ///< integral of (y - cy)^2, m4
  double sxy = 0.0;   ///< integral of (x - cx)(y - cy), m4
};

/// Moments of the region bounded by `rings`: counter-clockwise rings count positive, clockwise ones
/// (holes) negative, so any simple polygon, convex or not, is exact (theory, section 1.2; the
/// paper's "simplex integration"). The sum is formed about the first vertex, so that a polygon far
/// from the origin keeps its digits. A region of zero area has zero second moments and its first
/// vertex as centroid.
Moments moments(std::span<const Ring> rings);

/// Signed area of one ring, positive if counter-clockwise.
double signed_area(std::span<const Vec2> ring);

/// +1 inside, 0 on an edge (within `tolerance`), -1 outside the region bounded by `rings`.
int side_of(std::span<const Ring> rings, Vec2 point, double tolerance);

/// Distance between the closest two parallel lines that hold all points between them: the least
/// width of their convex hull in any direction. 0 for fewer than three points. O(n log n).
double least_width(std::span<const Vec2> points);

/// Whether the closed ring touches or crosses itself (edges that are not neighbours meet, or
/// neighbours fold back on each other). O(n log n) on average by a sweep over x.
bool self_crossing(std::span<const Vec2> ring);

}  // namespace edda
