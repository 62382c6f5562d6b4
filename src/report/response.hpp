// What seismic design asks of an acceleration over time: peaks, Arias intensity, response spectra.
#pragma once

#include <cstddef>
#include <vector>

namespace edda {

/// Rows of one component of the motion of a point.
struct MotionRecord {
  std::vector<double> time;          ///< s, ascending
  std::vector<double> acceleration;  ///< m/s2 in a frame at rest, the mean since the row before
  std::vector<double> velocity;      ///< m/s; under apply = "inertia" relative to the ground
  std::vector<double> displacement;  ///< m since the first row, as the velocity
};

/// An interval of `length` s in which the acceleration goes linearly from one value to another.
struct AccelerationPiece {
  double length, from, to;  ///< s, m/s2
};

/// The interval from each row to the next. Its acceleration gives the changes of velocity and of
/// displacement that the rows have, however fast the motion swings between them; of a smooth motion
/// an oscillator feels it with an error of fourth order in the interval over its period.
std::vector<AccelerationPiece> pieces_of(const MotionRecord& motion);

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
ResponseSpectrum response_spectrum(const std::vector<AccelerationPiece>& pieces, double damping,
                                   const std::vector<double>& periods);

/// `count` numbers from `low` to `high`, in equal ratios; both above 0, count at least 2.
std::vector<double> in_equal_ratios(double low, double high, std::size_t count);

}  // namespace edda
