// Fourier transforms, and the dominant frequency of a ground motion record.
#pragma once

#include <complex>
#include <vector>

#include "base/vec2.hpp"

namespace edda {

/// Fast Fourier transform of 2^k values, in place: sum of a_q exp(-2 pi i f q/n).
void fourier(std::vector<std::complex<double>>& a);

/// Frequency of the largest Fourier amplitude of a curve in the plane, about its mean, Hz. `time`
/// ascends, the curve is straight between its points. 0 where there is none: fewer than three
/// points, or a constant curve.
double dominant_frequency(const std::vector<double>& time, const std::vector<Vec2>& value);

}  // namespace edda
