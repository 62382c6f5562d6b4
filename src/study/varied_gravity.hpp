// Quantities of [fos] that are a change of gravity.
#pragma once

#include <cmath>
#include <numbers>

#include "base/vec2.hpp"
#include "model/model.hpp"

namespace edda {

constexpr bool changes_gravity(Varied varied) {
  return varied == Varied::tilt || varied == Varied::kh || varied == Varied::kv ||
         varied == Varied::gravity;
}

/// The factor at which what is varied is as the model has it: no seismic coefficient, no tilt, no
/// ground motion; else 1.
constexpr double factor_as_given(Varied varied) {
  return varied == Varied::shaking || (changes_gravity(varied) && varied != Varied::gravity) ? 0.0
                                                                                             : 1.0;
}

/// Gravity as given, g, changed by a seismic coefficient (a force of that part of the weight to the
/// right of g, seen with g downwards, or against it), by a tilt in degrees or by a factor.
inline Vec2 varied_gravity(Vec2 g, Varied varied, double by) {
  const double angle = by * std::numbers::pi / 180.0;
  switch (varied) {
    case Varied::kh:
      return g + by * perp(g);
    case Varied::kv:
      return (1.0 - by) * g;
    case Varied::gravity:
      return by * g;
    case Varied::tilt:
      return std::cos(angle) * g + std::sin(angle) * perp(g);
    default:
      return g;
  }
}

}  // namespace edda
