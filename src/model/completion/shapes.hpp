// Outlines from a few parameters.
#pragma once

#include "model/model.hpp"

namespace edda {

/// Outline of an opening, counter-clockwise; the corners of its curved parts lie on the curve.
///  - arch: floor, upright walls, and a roof that is a half circle, or, where the height is less
///    than half the width, a flat arc from corner to corner;
///  - circle; rectangle;
///  - horseshoe: a half circle of the width over walls that curve inwards on arcs whose radius is
///    the width, down to a level floor.
/// Precondition: the height suits the kind (shape_fault() of it is empty).
Ring ring_of(const OpeningShape& shape);

/// What is wrong with the height, and which heights are possible; empty if nothing.
std::pair<std::string, std::string> shape_fault(const OpeningShape& shape);

/// Outline of a slope, counter-clockwise from the lower left corner.
Ring ring_of(const Slope& slope);

/// Horizontal length from the toe to the crest, m.
double run_of(const Slope& slope);

}  // namespace edda
