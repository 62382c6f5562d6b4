// The panel of Ferris and Tin-Loi (2001), on a fixed base.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

namespace edda::testing {

/// Six courses of five units of 0.4 x 0.175 m, half units at the ends of the first and of every
/// second one; tan(phi) = 0.65, E of the stone in Pa.
inline std::string masonry_panel(double young) {
  const double b = 0.4, h = 0.175, phi = std::atan(0.65) * 180.0 / std::numbers::pi;
  const auto rectangle = [](double x0, double y0, double x1, double y1) {
    return fmt::format(
        "polygon = [[{0:.15g},{1:.15g}],[{2:.15g},{1:.15g}],[{2:.15g},{3:.15g}],"
        "[{0:.15g},{3:.15g}]]\n",
        x0, y0, x1, y1);
  };
  std::string text = fmt::format(
      "[materials.stone]\ndensity = 2000\nyoung = {}\npoisson = 0.2\n[joints.dry]\n"
      "friction_angle = {:.15g}\n[[block]]\nfixed = true\n",
      young, phi);
  text += rectangle(-b, -h, 6.0 * b, 0.0);
  for (int course = 0; course < 6; ++course) {
    double from = 0.0;
    for (double to = course % 2 == 0 ? 0.5 * b : b; from < 5.0 * b - 1e-9; to += b) {
      const double end = std::min(to, 5.0 * b);
      text += "[[block]]\n" + rectangle(from, course * h, end, (course + 1) * h);
      from = end;
    }
  }
  return text;
}

}  // namespace edda::testing
