// The dominant frequency of a ground motion record.
#pragma once

#include <vector>

#include "base/vec2.hpp"

namespace edda {

/// Frequency of the largest Fourier amplitude of a curve in the plane, about its mean, Hz. `time`
/// ascends, the curve is straight between its points. 0 where there is none: fewer than three
/// points, or a constant curve.
double dominant_frequency(const std::vector<double>& time, const std::vector<Vec2>& value);

}  // namespace edda
