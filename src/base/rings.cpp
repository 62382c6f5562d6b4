#include "base/rings.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>

namespace edda {

std::vector<Vec2> without_repeats(std::vector<Vec2> points) {
  points.erase(std::unique(points.begin(), points.end()), points.end());
  return points;
}

Ring local_ring(const Ring& ring, Vec2 origin) {
  Ring local;
  local.reserve(ring.size());
  for (Vec2 p : ring) local.push_back(p - origin);
  local = without_repeats(std::move(local));
  if (local.size() > 1 && local.front() == local.back()) local.pop_back();
  if (signed_area(local) < 0.0) std::reverse(local.begin(), local.end());
  return local;
}

std::vector<Vec2> closed(const Ring& ring) {
  std::vector<Vec2> points = ring;
  if (!ring.empty()) points.push_back(ring.front());
  return points;
}

Stretch extent_along(const Ring& ring, Vec2 axis) {
  Stretch extent{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
  for (Vec2 p : ring) {
    extent.first = std::min(extent.first, dot(p, axis));
    extent.second = std::max(extent.second, dot(p, axis));
  }
  return extent;
}

double size_of(const Ring& ring) {
  if (ring.empty()) return 0.0;
  const Stretch x = extent_along(ring, {1, 0}), y = extent_along(ring, {0, 1});
  return std::max(x.second - x.first, y.second - y.first);
}

Vec2 direction_of(double angle) {
  const double turn = std::fmod(angle, 360.0);
  const double quarters = turn / 90.0;
  if (quarters == std::round(quarters)) {
    constexpr Vec2 axes[4] = {{1, 0}, {0, 1}, {-1, 0}, {0, -1}};
    return axes[(static_cast<int>(quarters) + 4) % 4];
  }
  const double radians = turn * std::numbers::pi / 180.0;
  return {std::cos(radians), std::sin(radians)};
}

std::vector<Stretch> clip_line(const Ring& ring, Vec2 point, Vec2 direction, double tolerance) {
  const Vec2 normal = perp(direction);
  std::vector<double> meets;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Vec2 a = ring[i] - point, b = ring[i + 1 == ring.size() ? 0 : i + 1] - point;
    const double da = dot(a, normal), db = dot(b, normal);
    if (std::abs(da) <= tolerance) {
      meets.push_back(dot(a, direction));
    } else if (std::abs(db) > tolerance && (da > 0.0) != (db > 0.0)) {
      meets.push_back(dot(a + (da / (da - db)) * (b - a), direction));
    }
  }
  std::sort(meets.begin(), meets.end());
  std::vector<Stretch> inside;
  for (std::size_t i = 0; i + 1 < meets.size(); ++i) {
    if (meets[i + 1] - meets[i] <= tolerance) continue;
    const Vec2 middle = point + 0.5 * (meets[i] + meets[i + 1]) * direction;
    if (side_of({&ring, 1}, middle, tolerance) < 0) continue;
    if (!inside.empty() && meets[i] - inside.back().second <= tolerance) {
      inside.back().second = meets[i + 1];
    } else {
      inside.emplace_back(meets[i], meets[i + 1]);
    }
  }
  return inside;
}

std::vector<Stretch> common(const std::vector<Stretch>& a, const std::vector<Stretch>& b) {
  std::vector<Stretch> both;
  for (const Stretch& s : a) {
    for (const Stretch& t : b) {
      const Stretch part{std::max(s.first, t.first), std::min(s.second, t.second)};
      if (part.second > part.first) both.push_back(part);
    }
  }
  return both;
}

std::vector<Stretch> drawn(const Ring& outline, const Ring& region, Vec2 point, Vec2 direction,
                           double snap, double margin, Stretch limits) {
  const std::vector<Stretch> inside = clip_line(outline, point, direction, snap);
  if (inside.empty()) return {};
  const Stretch whole{inside.front().first, inside.back().second};
  const Stretch beyond{whole.first - margin, whole.second + margin};
  std::vector<Stretch> parts;
  const auto add = [&](Stretch part) {
    part.first = std::max(part.first, limits.first);
    part.second = std::min(part.second, limits.second);
    if (part.second - part.first > snap) parts.push_back(part);
  };
  if (region.empty()) {
    add(beyond);
    return parts;
  }
  for (Stretch part : clip_line(region, point, direction, snap)) {
    if (part.first <= whole.first + snap) part.first = beyond.first;
    if (part.second >= whole.second - snap) part.second = beyond.second;
    add(part);
  }
  return parts;
}

double margin_of(const Ring& outline, double snap) {
  return std::max(1e-3 * size_of(outline), 100.0 * snap);
}

}  // namespace edda
