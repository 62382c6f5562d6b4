// SPLINE entities of drawings.
#pragma once

#include <string>
#include <vector>

#include "imports/dxf_values.hpp"

namespace edda {

struct DxfSpline {
  std::vector<Vec2> points;  ///< corners of its polyline
  std::string
      left_out;  ///< the kind under which it is counted as left out; empty where it is drawn
};

/// Faults, reported by sound(): knots or weights that do not fit its control points and degree.
DxfSpline read_spline(DxfValues& values);

}  // namespace edda
