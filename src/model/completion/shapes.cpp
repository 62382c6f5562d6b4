#include "model/completion/shapes.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "base/arc.hpp"

namespace edda {
namespace {

using std::numbers::pi;

/// Largest height of a horseshoe over its width: below it the walls still leave a floor of more
/// than a tenth of the width.
constexpr double tallest_horseshoe = 1.3;

void append(Ring& ring, const std::vector<Vec2>& points) {
  ring.insert(ring.end(), points.begin(), points.end());
}

/// The right half of a curve through the crown, given from the floor up, and its mirror image.
Ring mirrored(const std::vector<Vec2>& right, double axis) {
  Ring left;
  for (const Vec2 p : right) {
    if (p.x != axis) left.push_back({2.0 * axis - p.x, p.y});
  }
  Ring ring = right;
  ring.insert(ring.end(), left.rbegin(), left.rend());
  return ring;
}

/// Rise h over half the width a: radius (a^2 + h^2)/(2 h), half of the arc atan2(a, r - h).
Ring arch(const OpeningShape& s) {
  const double a = 0.5 * s.width, rise = std::min(*s.height, a);
  const double radius = (a * a + rise * rise) / (2.0 * rise);
  const Vec2 crown{s.at.x, s.at.y + *s.height}, centre = crown - Vec2{0.0, radius};
  const Vec2 spring{s.at.x + a, s.at.y + *s.height - rise};
  std::vector<Vec2> right;
  if (spring.y > s.at.y) right.push_back({spring.x, s.at.y});
  right.push_back(spring);
  append(right, arc_corners(centre, spring, std::atan2(a, radius - rise), s.segments));
  right.push_back(crown);
  return mirrored(right, s.at.x);
}

/// The walls: circles of radius w round the opposite end of the widest line, down to the depth d
/// below it.
Ring horseshoe(const OpeningShape& s) {
  const double a = 0.5 * s.width, depth = *s.height - a;
  const Vec2 middle{s.at.x, s.at.y + depth}, opposite = middle - Vec2{a, 0.0};
  const double turn = std::asin(depth / s.width);
  const Vec2 springing = opposite + Vec2{s.width * std::cos(turn), -depth};
  std::vector<Vec2> right{springing};
  append(right, arc_corners(opposite, springing, turn, s.segments));
  right.push_back(middle + Vec2{a, 0.0});
  append(right, arc_corners(middle, right.back(), 0.5 * pi, s.segments));
  right.push_back(middle + Vec2{0.0, a});
  return mirrored(right, s.at.x);
}

Ring circle(const OpeningShape& s) {
  const Vec2 first = s.at + Vec2{0.5 * s.width, 0.0};
  Ring ring{first};
  append(ring, arc_corners(s.at, first, 2.0 * pi, s.segments));
  return ring;
}

Ring rectangle(const OpeningShape& s) {
  const double a = 0.5 * s.width, top = s.at.y + *s.height;
  return {{s.at.x - a, s.at.y}, {s.at.x + a, s.at.y}, {s.at.x + a, top}, {s.at.x - a, top}};
}

}  // namespace

Ring ring_of(const OpeningShape& shape) {
  switch (shape.kind) {
    case ShapeKind::arch:
      return arch(shape);
    case ShapeKind::circle:
      return circle(shape);
    case ShapeKind::rectangle:
      return rectangle(shape);
    case ShapeKind::horseshoe:
      return horseshoe(shape);
  }
  return {};
}

std::pair<std::string, std::string> shape_fault(const OpeningShape& shape) {
  if (shape.kind == ShapeKind::circle) {
    if (!shape.height) return {};
    return {"a circle has no height", "leave it out, the width is its diameter"};
  }
  if (!shape.height) return {"is missing", "give the height from the floor to the crown"};
  const double least = 0.5 * shape.width, most = tallest_horseshoe * shape.width;
  if (shape.kind == ShapeKind::horseshoe && !(*shape.height > least && *shape.height <= most)) {
    return {
        fmt::format("{} is not possible for a horseshoe of width {}", *shape.height, shape.width),
        fmt::format("give more than half the width, {}, and at most 1.3 times it, {:.6g}", least,
                    most)};
  }
  return {};
}

double run_of(const Slope& slope) {
  const double faces =
      slope.face_angle == 90.0 ? 0.0 : slope.height / std::tan(slope.face_angle * pi / 180.0);
  return faces + (slope.benches - 1) * slope.bench_width;
}

Ring ring_of(const Slope& slope) {
  const double left = slope.extent.x, right = slope.extent.y, top = slope.toe.y + slope.height;
  const int n = slope.benches;
  const double face = (run_of(slope) - (n - 1) * slope.bench_width) / n;
  Ring ring{{left, slope.base_y}, {right, slope.base_y}};
  // From the crest down to the toe.
  std::vector<Vec2> ground{{right, top}};
  const auto add = [&](Vec2 p) {
    if (p != ground.back()) ground.push_back(p);
  };
  for (int i = n; i >= 1; --i) {
    const double x = slope.toe.x + (i - 1) * (face + slope.bench_width);
    add({x + face, slope.toe.y + slope.height * i / n});
    add({x, slope.toe.y + slope.height * (i - 1) / n});
  }
  add({left, slope.toe.y});
  append(ring, ground);
  return ring;
}

}  // namespace edda
