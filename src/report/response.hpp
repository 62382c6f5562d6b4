// What seismic design asks of an acceleration over time: peaks, Arias intensity, response spectra.
#pragma once

#include <cstddef>
#include <vector>

namespace edda {

/// One component of the motion of a point, linear between its rows.
struct MotionRecord {
  std::vector<double> time;          ///< s, ascending
  std::vector<double> acceleration;  ///< m/s2
  std::vector<double> velocity;      ///< m/s
  std::vector<double> displacement;  ///< m, since the first row
};

struct MotionMeasures {
  double peak_acceleration = 0.0, peak_velocity = 0.0, peak_displacement = 0.0;  ///< magnitudes
  double permanent_displacement = 0.0;                                           ///< m, at the end
  double arias = 0.0;                                                            ///< m/s
  double arias_duration = 0.0;  ///< s, from 5 to 95 % of it
};
MotionMeasures measures_of(const MotionRecord& motion);

/// [periods] largest values of oscillators on the ground, which are at rest at the first row.
struct ResponseSpectrum {
  std::vector<double> pseudo_acceleration;    ///< (2 pi/T)^2 times the displacement, m/s2
  std::vector<double> relative_velocity;      ///< m/s, to the ground
  std::vector<double> relative_displacement;  ///< m, to the ground
};
/// `damping`: part of critical, below 1; periods: s, above 0.
ResponseSpectrum response_spectrum(const std::vector<double>& time,
                                   const std::vector<double>& acceleration, double damping,
                                   const std::vector<double>& periods);

/// `count` numbers from `low` to `high`, in equal ratios; both above 0, count at least 2.
std::vector<double> in_equal_ratios(double low, double high, std::size_t count);

/// The largest difference of the change of velocity since the first row and the integral of the
/// acceleration, over the largest change; 0 where there is none. Accelerations that swing faster
/// than rows follow each other do not integrate to the velocity.
double error_of_integral(const MotionRecord& motion);

}  // namespace edda
