#include "report/ticks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace edda {

std::vector<Tick> ticks(double low, double high, double count) {
  std::vector<Tick> result;
  if (!(high > low) || !std::isfinite(high - low)) return result;
  const double rough = (high - low) / std::max(count, 1.0);
  const double power = std::pow(10.0, std::floor(std::log10(rough)));
  double step = 10.0 * power;
  for (const double round : {1.0, 2.0, 5.0}) {
    if (round * power >= rough * (1.0 - 1e-9)) {
      step = round * power;
      break;
    }
  }
  // The steps are below the precision of the numbers: no even ticks exist.
  if (step < 1e-12 * std::max(std::abs(low), std::abs(high))) return result;
  const int digits = std::clamp(static_cast<int>(std::ceil(-std::log10(step) - 1e-9)), 0, 15);
  const double largest = std::max(std::abs(low), std::abs(high));
  // Large coordinates that differ in their last digits keep them.
  const bool short_enough =
      (largest >= 1e6 && step >= 1e-3 * largest) || (largest < 1e-4 && digits > 4);
  for (double k = std::ceil(low / step - 1e-9); k * step <= high + 1e-9 * step; k += 1.0) {
    const double value = k * step + 0.0;
    result.push_back({value, short_enough ? fmt::format("{:.4g}", value)
                                          : fmt::format("{:.{}f}", value, digits)});
  }
  return result;
}

ScaledUnit scaled_unit(const std::string& unit, double largest) {
  constexpr std::array<std::pair<double, const char*>, 7> prefixes{
      {{1e9, "G"}, {1e6, "M"}, {1e3, "k"}, {1.0, ""}, {1e-3, "m"}, {1e-6, "µ"}, {1e-9, "n"}}};
  const bool metre = unit == "m" || unit == "m/s";
  if (!metre && unit != "Pa" && unit != "N" && unit != "N m" && unit != "J") return {unit, 1.0};
  if (!(largest > 0.0) || !std::isfinite(largest)) return {unit, 1.0};
  for (const auto& [size, prefix] : prefixes) {
    if (metre && size > 1.0) continue;
    if (largest >= 0.9999 * size) return {prefix + unit, 1.0 / size};
  }
  return {unit, 1.0};
}

}  // namespace edda
