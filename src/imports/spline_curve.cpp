#include "imports/spline_curve.hpp"

#include <algorithm>
#include <cmath>

namespace edda {
namespace {

/// About the tolerance of arcs of 48 pieces per circle.
constexpr double tolerance_of_size = 1.0 / 2000.0;

struct Weighted {
  Vec2 moment;  ///< weight times position
  double weight = 1.0;
  Vec2 place() const { return moment / weight; }
};

Weighted between(const Weighted& a, const Weighted& b, double share) {
  return {(1.0 - share) * a.moment + share * b.moment, (1.0 - share) * a.weight + share * b.weight};
}

/// Control points of a piece of the spline as a Bezier curve.
using Bezier = std::vector<Weighted>;

/// Those of the piece from knot k to the next. Point j is the spline's polar form, with the knot k
/// degree - j times and the next one j times as its arguments; all weights are between 0 and 1.
Bezier piece_from(const SplineCurve& curve, std::size_t k) {
  const auto degree = static_cast<std::size_t>(curve.degree);
  Bezier corners, row(degree + 1);
  for (std::size_t j = 0; j <= degree; ++j) {
    for (std::size_t i = 0; i <= degree; ++i) {
      const std::size_t point = k - degree + i;
      row[i] = {curve.weights[point] * curve.points[point], curve.weights[point]};
    }
    for (std::size_t round = 1; round <= degree; ++round) {
      const double at = curve.knots[round <= degree - j ? k : k + 1];
      for (std::size_t i = 0; i <= degree - round; ++i) {
        const double low = curve.knots[k - degree + round + i], high = curve.knots[k + 1 + i];
        row[i] = between(row[i], row[i + 1], (at - low) / (high - low));
      }
    }
    corners.push_back(row[0]);
  }
  return corners;
}

/// Bound of the distance of a Bezier curve from its chord. Distance from a chord is convex, so it
/// is at most that of the inner control points times their weight, 1 - (1 - t)^p - t^p without
/// weights, at most f = 1 - 2^(1 - p); with weights at most f W/(f W + (1 - f) w), W the largest
/// inner weight and w the smaller one of the ends.
double off_chord(const Bezier& curve) {
  const Weighted &first = curve.front(), &last = curve.back();
  const Vec2 from = first.place(), to = last.place();
  double distance = 0.0, inner_weight = 0.0;
  for (std::size_t i = 1; i + 1 < curve.size(); ++i) {
    distance = std::max(distance, distance_to_segment(curve[i].place(), from, to));
    inner_weight = std::max(inner_weight, curve[i].weight);
  }
  const double ends = std::ldexp(1.0, 2 - static_cast<int>(curve.size()));  // 1 - f
  const double inner = (1.0 - ends) * inner_weight;
  return distance * inner / (inner + ends * std::min(first.weight, last.weight));
}

/// Adds the corners of the polyline after the first one; halves the curve `deepest` times at most.
void add_corners(const Bezier& curve, double tolerance, int deepest, std::vector<Vec2>& points) {
  if (deepest == 0 || off_chord(curve) <= tolerance) {
    points.push_back(curve.back().place());
    return;
  }
  Bezier row = curve, left, right(curve.size());
  for (std::size_t n = curve.size(); n > 0; --n) {
    left.push_back(row[0]);
    right[n - 1] = row[n - 1];
    for (std::size_t i = 0; i + 1 < n; ++i) row[i] = between(row[i], row[i + 1], 0.5);
  }
  add_corners(left, tolerance, deepest - 1, points);
  add_corners(right, tolerance, deepest - 1, points);
}

}  // namespace

double SplineCurve::size() const {
  Vec2 low = points.front(), high = low;
  for (const Vec2 p : points) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y)};
  }
  return norm(high - low);
}

std::vector<Vec2> spline_points(const SplineCurve& curve) {
  const double tolerance = tolerance_of_size * curve.size();
  std::vector<Vec2> points;
  for (auto k = static_cast<std::size_t>(curve.degree); k < curve.points.size(); ++k) {
    if (!(curve.knots[k] < curve.knots[k + 1])) continue;
    const Bezier piece = piece_from(curve, k);
    if (points.empty()) points.push_back(piece.front().place());
    constexpr double digits = 1e-6;
    if (!(norm(piece.front().place() - points.back()) <= digits * curve.size())) return {};
    constexpr int deepest = 20;
    add_corners(piece, tolerance, deepest, points);
  }
  return points;
}

}  // namespace edda
