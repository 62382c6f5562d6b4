// Affine maps of the plane: from a block of a drawing to the drawing, from the unit circle to an
// ellipse.
#pragma once

#include "base/vec2.hpp"

namespace edda {

struct PlaneMap {
  Vec2 origin;  ///< image of (0, 0)
  Vec2 x_axis{1.0, 0.0}, y_axis{0.0, 1.0};

  Vec2 along(Vec2 v) const { return v.x * x_axis + v.y * y_axis; }  ///< maps a difference of points
  Vec2 operator()(Vec2 p) const { return origin + along(p); }
};

/// The map that applies `inner` first, then `outer`.
inline PlaneMap operator*(const PlaneMap& outer, const PlaneMap& inner) {
  return {outer(inner.origin), outer.along(inner.x_axis), outer.along(inner.y_axis)};
}

}  // namespace edda
