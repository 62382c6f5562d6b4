// Rational splines as polylines.
#pragma once

#include <vector>

#include "base/vec2.hpp"

namespace edda {

/// B-spline with weights: the sum of N_i w_i P_i over the sum of N_i w_i.
struct SplineCurve {
  int degree = 0;               ///< >= 1
  std::vector<double> knots;    ///< [points + degree + 1], not decreasing
  std::vector<Vec2> points;     ///< the control points, more than degree
  std::vector<double> weights;  ///< [points], of which none is negligible against the largest

  double size()
      const;  ///< diagonal of the bounding box of its control points, which contains the curve
};

/// Corners on the curve, from its first to its last. No point of the curve is farther from the line
/// that joins them than 1/2000 of its size; every knot within the curve is a corner. A knot that is
/// repeated degree + 1 times joins two curves, as in rows of Bezier curves; none where these do not
/// meet within 1e-6 of the size.
std::vector<Vec2> spline_points(const SplineCurve& curve);

}  // namespace edda
