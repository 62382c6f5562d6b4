// Models of the implicit method that more than one test runs.
#pragma once

#include <cmath>
#include <numbers>
#include <string>

#include "verification/scene.hpp"

namespace edda {

/// Lines of [solver]: the implicit method at a step, s.
inline std::string dda(double step) {
  return "method = 'dda'\ntime_step = " + number(step) + "\n";
}

/// Six pentagons that fall on each other and on a fixed base.
inline std::string falling_pentagons(const std::string& solver) {
  std::string toml = R"(
[materials.rock]
density = 2500.0
young = 2e9
poisson = 0.2
[joints.j]
friction_angle = 25.0
[[block]]
fixed = true
polygon = [[-20, -1], [20, -1], [20, 0], [-20, 0]]
[output]
history_every = 0.02
[solver]
duration = 0.6
)" + solver;
  for (int i = 0; i < 6; ++i) {
    const double x = 0.35 * (i % 3), y = 0.1 + 1.15 * i, t = 0.2 * i;
    toml += "[[block]]\npolygon = [";
    for (int c = 0; c < 5; ++c) {
      const double a = t + 2.0 * std::numbers::pi * c / 5;
      toml += (c ? ", [" : "[") + number(x + 0.55 * std::cos(a)) + ", " +
              number(y + 0.55 + 0.55 * std::sin(a)) + "]";
    }
    toml += "]\n";
  }
  return toml;
}

}  // namespace edda
