// Circular arcs as polylines with their corners on the arc.
#pragma once

#include <vector>

#include "base/vec2.hpp"

namespace edda {

/// Corners after `from` up to and without the end of the arc round `centre` that begins at `from`
/// and turns by `turn` radians (positive: counter-clockwise), with so many corners that each piece
/// is at most 1/`segments` of a full turn; `segments` >= 3.
std::vector<Vec2> arc_corners(Vec2 centre, Vec2 from, double turn, int segments);

/// As above, from `from` to `to` with the bulge of a drawing: tan(turn / 4), positive where the arc
/// lies to the right of the chord. Only the corners between the ends.
std::vector<Vec2> bulge_corners(Vec2 from, Vec2 to, double bulge, int segments);

}  // namespace edda
