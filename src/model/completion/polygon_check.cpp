#include "model/completion/polygon_check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/polygon.hpp"

namespace edda {
namespace {

/// Larger side of the bounding box of the points.
double extent(std::span<const Vec2> points) {
  Vec2 low = points[0], high = points[0];
  for (const Vec2 p : points) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y)};
  }
  return std::max(high.x - low.x, high.y - low.y);
}

}  // namespace

void check_points(std::span<const Vec2> points, Kind kind, const Value& written,
                  const std::string& path, Reading& reading) {
  const bool closed = kind == Kind::polygon;
  const std::size_t least = closed ? 3 : 2;
  if (points.size() < least) {
    add_fault(reading, written.place, path,
              fmt::format("has {} point{}", points.size(), points.size() == 1 ? "" : "s"),
              fmt::format("give at least {}", closed ? "three corners" : "two points"));
    return;
  }
  bool repeated = false;
  for (std::size_t i = 1; i < points.size() + (closed ? 1 : 0); ++i) {
    const bool last = i == points.size();
    if (points[i - 1] != points[last ? 0 : i]) continue;
    repeated = true;
    const std::size_t which = last ? i - 1 : i;
    add_fault(reading, child(&written, which)->place, fmt::format("{}[{}]", path, which),
              last ? "repeats the first point" : "is the same point as the one before",
              last ? "leave it out, a polygon closes itself" : "leave it out");
  }
  if (repeated || !closed) return;
  constexpr double flat = 1e-12;  // over the box's larger side, or its square: rounding only
  const double size = extent(points);
  const bool on_one_line = least_width(points) <= flat * size;
  if (!on_one_line && self_crossing(points)) {
    add_fault(reading, written.place, path, "crosses or touches itself",
              "list the corners in order along the outline, each once");
  } else if (on_one_line || std::abs(signed_area(points)) <= flat * size * size) {
    add_fault(reading, written.place, path, "has no area",
              "give corners that are not all on one line");
  }
}

}  // namespace edda
