// Rings and intervals on lines, for drawing the line work.
#pragma once

#include <utility>
#include <vector>

#include "base/polygon.hpp"
#include "base/vec2.hpp"

namespace edda {

/// An interval along a line, m.
using Stretch = std::pair<double, double>;

/// The points without those that repeat the one before.
std::vector<Vec2> without_repeats(std::vector<Vec2> points);

/// The ring relative to `origin`, counter-clockwise, without repeated points.
Ring local_ring(const Ring& ring, Vec2 origin);

/// The ring with its first point repeated at the end.
std::vector<Vec2> closed(const Ring& ring);

/// Smallest and largest coordinate of the ring along a unit vector.
Stretch extent_along(const Ring& ring, Vec2 axis);

/// Larger side of the bounding box of the ring; 0 for an empty one.
double size_of(const Ring& ring);

/// Unit vector at `angle` degrees, exact at multiples of 90.
Vec2 direction_of(double angle);

/// Intervals [first, second] of the line point + t direction that lie inside `ring` or within
/// `tolerance` of its edge; direction is a unit vector, so t is in m. The ring need not be convex.
std::vector<Stretch> clip_line(const Ring& ring, Vec2 point, Vec2 direction, double tolerance);

/// Intersection of two lists of intervals, each sorted and without overlaps.
std::vector<Stretch> common(const std::vector<Stretch>& a, const std::vector<Stretch>& b);

/// The parts of the line point + t direction that are drawn to cut what lies inside `outline`: from
/// its first to its last meeting with the outline and `margin` beyond, so that it crosses the
/// outline instead of ending on it; inside the region, unless that is empty; and within `limits`.
std::vector<Stretch> drawn(const Ring& outline, const Ring& region, Vec2 point, Vec2 direction,
                           double snap, double margin, Stretch limits);

/// How far lines are drawn beyond the outline, m.
double margin_of(const Ring& outline, double snap);

}  // namespace edda
