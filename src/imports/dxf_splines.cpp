#include "imports/dxf_splines.hpp"

#include <algorithm>

#include "base/text.hpp"
#include "imports/spline_curve.hpp"

namespace edda {
namespace {

constexpr int highest_degree = 11;

/// Why knots and weights define no curve; empty where they do.
std::string fault_of(const SplineCurve& curve, std::size_t weights) {
  const auto degree = static_cast<std::size_t>(curve.degree);
  const std::size_t points = curve.points.size(), knots = points + degree + 1;
  const std::vector<double>& u = curve.knots;
  if (points <= degree) return "SPLINE has fewer control points than its degree needs";
  if (u.size() != knots) {
    return "SPLINE has " + counted(u.size(), "knot") + ", but " + std::to_string(knots) +
           " belong to its degree and control points";
  }
  if (weights != 0 && weights != points) {
    return "SPLINE has " + counted(weights, "weight") + " for " + counted(points, "control point");
  }
  if (!std::is_sorted(u.begin(), u.end())) return "the knots of SPLINE decrease";
  const double first = u[degree], last = u[points];
  if (!(first < last)) return "the knots of SPLINE are all one";
  return {};
}

/// Divides the weights by the largest, so that their sums stay finite; false where some are then
/// not above 0.
bool take_weights(SplineCurve& curve, std::vector<double> weights) {
  if (weights.empty()) weights.assign(curve.points.size(), 1.0);
  const double largest = *std::max_element(weights.begin(), weights.end());
  constexpr double smallest = 1e-9;
  for (double& w : weights) {
    if (!(w > smallest * largest)) return false;
    w /= largest;
  }
  curve.weights = std::move(weights);
  return true;
}

/// Ends that coincide within the digits of a file become one point; returns false where they do
/// not.
bool close(std::vector<Vec2>& points, double size) {
  constexpr double digits = 1e-6;
  if (!(norm(points.back() - points.front()) <= digits * size)) return false;
  points.back() = points.front();
  return true;
}

}  // namespace

DxfSpline read_spline(DxfValues& values) {
  const bool closed = (values.whole(70, 0) & (1 | 2)) != 0;
  SplineCurve curve;
  curve.degree = values.whole(71);
  for (const BulgedCorner& c : values.corners(std::nullopt)) curve.points.push_back(c.point);
  curve.knots = values.numbers(40);
  std::vector<double> weights = values.numbers(41);
  if (!values.sound()) return {};
  if (curve.points.empty()) return {{}, "SPLINE without control points"};
  if (curve.degree < 1 || curve.degree > highest_degree) return {{}, "SPLINE of unusual degree"};
  if (const std::string fault = fault_of(curve, weights.size()); !fault.empty()) {
    values.fail(fault);
    return {};
  }
  if (!take_weights(curve, std::move(weights))) return {{}, "SPLINE of weights not above 0"};
  DxfSpline spline{spline_points(curve), {}};
  if (spline.points.empty()) return {{}, "SPLINE that is interrupted"};
  if (!close(spline.points, curve.size()) && closed) {
    return {{}, "SPLINE said to be closed that is open"};
  }
  return spline;
}

}  // namespace edda
