// Blocks that overlap at the start.
#pragma once

#include <cstddef>
#include <span>

#include "base/fault.hpp"
#include "cutting/polygon_set.hpp"
#include "imports/imports.hpp"
#include "model/model.hpp"

namespace edda {

/// Depth to which two polygons penetrate each other, m: the largest distance at which the boundary
/// of one runs inside the other (at corners and three points of each piece between crossings), or,
/// where the boundaries coincide, the width of a circle that fits in both. 0 where they are apart,
/// touch, or one lies in a hole of the other. For convex blocks at least half the exact depth along
/// every piece.
double overlap_depth(const BlockPolygon& a, const BlockPolygon& b);

/// Depth to which blocks overlap at most where their coordinates, given or imported, are those of
/// blocks that touch, rounded to their last digit, m.
double overlap_by_rounding(const Model& model, const Imports& imports);

/// Allowed depth, m: 1e-3 of the smaller block's size (the square root of its area), or what
/// `rounding` makes, if that is at most a hundredth of the size.
double allowed_overlap(const BlockPolygon& a, const BlockPolygon& b, double rounding = 0.0);

/// One fault per pair that overlaps by more than allowed; two fixed blocks may. Blocks from
/// `first_cut` on come from one cut and cannot overlap each other. Lists ten pairs, then how many
/// more.
Faults find_overlaps(std::span<const BlockPolygon> blocks, std::size_t first_cut,
                     double rounding = 0.0);

}  // namespace edda
