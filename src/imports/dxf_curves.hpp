// Arcs, ellipses and polylines of drawings as polylines with their corners on the curve.
#pragma once

#include <vector>

#include "base/vec2.hpp"
#include "imports/plane_map.hpp"

namespace edda {

struct BulgedCorner {
  Vec2 point;
  double bulge = 0.0;  ///< of the side that begins here
};

/// A polyline; closed ones end at the point where they begin.
std::vector<Vec2> bulged_points(const std::vector<BulgedCorner>& corners, bool closed);

/// Counter-clockwise rotation from one angle to the other; `full_turn` where both have the same
/// direction. All three in the same unit.
double turn_between(double from, double to, double full_turn);

/// The image of the arc of the unit circle that begins at `from`, runs counter-clockwise through
/// `turn` radians and ends at `to`.
std::vector<Vec2> arc_points(const PlaneMap& map, Vec2 from, Vec2 to, double turn);

}  // namespace edda
