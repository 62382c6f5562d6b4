// Which side of a line a point lies on, decided in extended precision where doubles cannot.
#pragma once

#include "base/vec2.hpp"

namespace edda {

/// +1 where c lies left of the line from a to b, -1 right, 0 on it (Shewchuk's filter, then GEOS's
/// double-double determinant).
int orientation(Vec2 a, Vec2 b, Vec2 c);

}  // namespace edda
