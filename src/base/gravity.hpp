// The acceleration that stands for gravity where none acts.
#pragma once

namespace edda {

/// Acceleration that replaces gravity where there is none, m/s2.
inline constexpr double usual_acceleration = 9.81;

}  // namespace edda
