// Accelerations of the ground: records of earthquakes, and sines.
#pragma once

#include <string>
#include <string_view>

#include "base/fault.hpp"
#include "model/model.hpp"

namespace edda {

/// Rows of three numbers, time (s) and the two components of the acceleration (m/s2), as
/// parse_rows() has them.
Result<Accelerogram> parse_acceleration_rows(std::string_view text, const std::string& path,
                                             const std::string& key);

/// A record of one component as the PEER database writes it (.AT2): lines of text, one of which
/// gives NPTS and DT (s), then the accelerations in units of g (9.80665 m/s2). `direction`: that of
/// the component.
Result<Accelerogram> parse_at2(std::string_view text, Vec2 direction, const std::string& path,
                               const std::string& key);

/// Reads either format, by the extension of the file name.
Result<Accelerogram> read_accelerogram(const std::string& path, Vec2 direction,
                                       const std::string& key);

/// Fills in the velocity: the integral of straight pieces, v_k = v_{k-1} + (a_{k-1} + a_k) dt/2.
void integrate(Accelerogram& record);

/// Acceleration of the ground, m/s2, and its integral from the time 0 on, m/s, `time` s after the
/// shaking began. A sine is a = A sin(2 pi f t), v = A (1 - cos(2 pi f t))/(2 pi f).
Vec2 acceleration_at(const Shaking& shaking, double time);
Vec2 velocity_at(const Shaking& shaking, double time);

}  // namespace edda
