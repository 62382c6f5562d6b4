// Fill: blocks that a stage places, with the outline of an opening or one of their own, divided
// into lifts.
#pragma once

#include "base/fault.hpp"
#include "cutting/polygon_set.hpp"

namespace edda {

/// Adds them as the last blocks of the set, in the order of Model::fills, each from its lowest lift
/// up.
Faults add_fills(const Model& model, PolygonSet& polygons);

/// Fill that, as drawn, overlaps what is there when it is placed, or touches nothing. After all
/// blocks have been added.
Faults misplaced_fills(const Model& model, const PolygonSet& polygons);

}  // namespace edda
