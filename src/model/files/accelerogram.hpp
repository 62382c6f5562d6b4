// Accelerations of the ground: records of earthquakes, and sines.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "base/fault.hpp"
#include "model/model.hpp"

namespace edda {

/// What the model says about a record.
struct RecordReading {
  Vec2 direction{1.0, 0.0};    ///< of its component, where it has one
  int component = 1;           ///< which, of a file that has several
  std::optional<double> unit;  ///< m/s2; none: as the file states
};

/// Rows of time (s) and the two components of the acceleration, or one, as parse_rows() has them;
/// also with semicolons, tabs or blanks between the columns. In m/s2 unless a header states the
/// unit; one component has to have a unit.
Result<Accelerogram> parse_acceleration_rows(std::string_view text, const RecordReading& reading,
                                             const std::string& path, const std::string& key);

/// A record of one component as the PEER database writes it (.AT2): lines of text, one of which
/// gives NPTS and DT (s), then the accelerations in units of g (9.80665 m/s2) unless it names
/// others.
Result<Accelerogram> parse_at2(std::string_view text, const RecordReading& reading,
                               const std::string& path, const std::string& key);

/// Reads these and the records of strong_motion.hpp, which are recognised by their heads.
Result<Accelerogram> read_accelerogram(const std::string& path, const RecordReading& reading,
                                       const std::string& key);

/// Fills in the velocity: the integral of straight pieces, v_k = v_{k-1} + (a_{k-1} + a_k) dt/2.
void integrate(Accelerogram& record);

/// Acceleration of the ground, m/s2, and its integral from the time 0 on, m/s, `time` s after the
/// shaking began. A sine is a = A sin(2 pi f t), v = A (1 - cos(2 pi f t))/(2 pi f).
Vec2 acceleration_at(const Shaking& shaking, double time);
Vec2 velocity_at(const Shaking& shaking, double time);

}  // namespace edda
