// Round numbers for axes and legends.
#pragma once

#include <string>
#include <vector>

namespace edda {

struct Tick {
  double value = 0.0;
  std::string label;
};

/// Multiples of 1, 2 or 5 times a power of ten within [low, high], at most `count` steps, labelled
/// with as many digits as are needed to distinguish them. Nothing where high <= low.
std::vector<Tick> ticks(double low, double high, double count);

/// A unit with the prefix that suits the largest value, and the factor to it: 2.3e6 Pa -> "MPa",
/// 1e-6. Units without prefixes ("degrees", "") come back as they are.
struct ScaledUnit {
  std::string name;
  double factor = 1.0;
};
ScaledUnit scaled_unit(const std::string& unit, double largest);

}  // namespace edda
