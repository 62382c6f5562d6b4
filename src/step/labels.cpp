#include "step/labels.hpp"

#include <fmt/format.h>

#include <cmath>

namespace edda {

std::string block_label(const BlockSet& b, std::size_t i) {
  return b.name(i).empty() ? fmt::format("block {}", i)
                           : fmt::format("block {} ({})", i, b.name(i));
}

std::string place_label(Vec2 p) {
  constexpr double rounding = 1e-9;  // m
  const auto shown = [](double u) { return std::abs(u) < rounding ? 0.0 : u; };
  return fmt::format("({:.6g}, {:.6g})", shown(p.x), shown(p.y));
}

std::string row_label(const char* what, const std::string& name, std::size_t row) {
  return name.empty() ? fmt::format("{} {}", what, row) : fmt::format("{} {}", what, name);
}

}  // namespace edda
