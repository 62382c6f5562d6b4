#include "cutting/orientation.hpp"

#include <cmath>
#include <limits>

#include "cutting/geos.hpp"

namespace edda {

int orientation(Vec2 a, Vec2 b, Vec2 c) {
  constexpr double unit_roundoff = std::numeric_limits<double>::epsilon() / 2.0;
  constexpr double bound = (3.0 + 16.0 * unit_roundoff) * unit_roundoff;
  const double left = (a.x - c.x) * (b.y - c.y);
  const double right = (a.y - c.y) * (b.x - c.x);
  const double det = left - right;
  if (std::abs(det) > bound * (std::abs(left) + std::abs(right))) return det > 0.0 ? 1 : -1;
  return geos::algorithm::Orientation::index({a.x, a.y}, {b.x, b.y}, {c.x, c.y});
}

}  // namespace edda
