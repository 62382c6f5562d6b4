#include "base/arc.hpp"

#include <cmath>
#include <numbers>

namespace edda {

std::vector<Vec2> arc_corners(Vec2 centre, Vec2 from, double turn, int segments) {
  constexpr double rounding = 1e-9;
  const double pieces = std::ceil(std::abs(turn) / (2.0 * std::numbers::pi) * segments - rounding);
  std::vector<Vec2> corners;
  for (double k = 1.0; k < pieces; k += 1.0) {
    corners.push_back(centre + rotated(from - centre, turn * k / pieces));
  }
  return corners;
}

/// With chord c and bulge b the centre lies beside the middle of the chord at c (1 - b^2)/(4 b), to
/// the left for b > 0.
std::vector<Vec2> bulge_corners(Vec2 from, Vec2 to, double bulge, int segments) {
  constexpr double straight = 1e-9;
  if (std::abs(bulge) < straight || from == to) return {};
  const Vec2 chord = to - from;
  const Vec2 centre = 0.5 * (from + to) + ((1.0 - bulge * bulge) / (4.0 * bulge)) * perp(chord);
  return arc_corners(centre, from, 4.0 * std::atan(bulge), segments);
}

}  // namespace edda
