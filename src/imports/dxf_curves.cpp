#include "imports/dxf_curves.hpp"

#include <cmath>

#include "base/arc.hpp"

namespace edda {
namespace {

/// Number of straight pieces per full turn for arcs and ellipses.
constexpr int arc_segments = 48;

}  // namespace

std::vector<Vec2> bulged_points(const std::vector<BulgedCorner>& corners, bool closed) {
  std::vector<Vec2> points;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    points.push_back(corners[i].point);
    const bool last = i + 1 == corners.size();
    if (last && !closed) break;
    const Vec2 to = corners[last ? 0 : i + 1].point;
    const auto arc = bulge_corners(corners[i].point, to, corners[i].bulge, arc_segments);
    points.insert(points.end(), arc.begin(), arc.end());
  }
  if (closed && corners.size() > 1) points.push_back(corners[0].point);
  return points;
}

double turn_between(double from, double to, double full_turn) {
  const double turns = (to - from) / full_turn;
  constexpr double digits_left_out =
      1e-6;  // relative rounding of the 2 pi at which some files end an ellipse
  const double whole = std::round(turns);
  if (turns == 0.0) return full_turn;
  if (whole != 0.0 && std::abs(turns - whole) <= digits_left_out) return full_turn;
  return (turns - std::floor(turns)) * full_turn;
}

std::vector<Vec2> arc_points(const PlaneMap& map, Vec2 from, Vec2 to, double turn) {
  std::vector<Vec2> points{map(from)};
  for (const Vec2 p : arc_corners({0.0, 0.0}, from, turn, arc_segments)) points.push_back(map(p));
  points.push_back(map(to));
  return points;
}

}  // namespace edda
