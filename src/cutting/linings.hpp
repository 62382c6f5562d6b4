// Linings: strips of constant thickness along the outlines of openings or along lines, each a
// polygon whose corners are in pairs, the sections.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "base/fault.hpp"
#include "cutting/polygon_set.hpp"

namespace edda {

/// Adds them as the last blocks of the set, in the order of Model::linings.
Faults add_linings(const Model& model, PolygonSet& polygons);

/// The directions of the end sections of a strip; 0: at right angles to it.
struct EndSections {
  Vec2 first, last;
};

/// The points at the distance `thickness` (m) on the left of a line, mitred at its corners. closed:
/// it goes on from its last point to its first.
std::vector<Vec2> inner_side(std::span<const Vec2> outer, bool closed, double thickness,
                             const EndSections& ends = {});

/// The sections of the polygon of a lining. Corners are numbered ring after ring.
struct StripSections {
  std::uint32_t count = 0;
  bool closed = false;
  std::uint32_t outer(std::uint32_t k) const { return k % count; }
  std::uint32_t inner(std::uint32_t k) const { return 2 * count - 1 - k % count; }
  /// The pieces between two sections each.
  std::uint32_t pieces() const { return closed ? count : count - 1; }
  /// Outer 1, outer 2, inner 2, inner 1 of piece p, counter-clockwise.
  std::array<std::uint32_t, 4> corners(std::uint32_t p) const {
    return {outer(p), outer(p + 1), inner(p + 1), inner(p)};
  }
};
StripSections sections_of(const BlockPolygon& lining);
/// Its corners, ring after ring.
std::vector<Vec2> all_corners(const BlockPolygon& lining);

}  // namespace edda
