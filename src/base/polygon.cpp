#include "base/polygon.hpp"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <numeric>

namespace edda {
namespace {

/// Integrals about a fixed point: area, first and second moments.
struct RawMoments {
  double area = 0.0, x = 0.0, y = 0.0, xx = 0.0, yy = 0.0, xy = 0.0;
};

/// Adds the signed triangles (origin, a, b) of a ring: the simplex with one corner at the origin
/// has area J/2, first moment J (a + b)/6 and second moments J (a a + b b + (a + b)(a + b))/24.
void add_ring(RawMoments& m, std::span<const Vec2> ring, Vec2 origin) {
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Vec2 a = ring[i] - origin;
    const Vec2 b = ring[i + 1 == ring.size() ? 0 : i + 1] - origin;
    const Vec2 s = a + b;
    const double j = cross(a, b);
    m.area += j / 2.0;
    m.x += j * s.x / 6.0;
    m.y += j * s.y / 6.0;
    m.xx += j * (a.x * a.x + b.x * b.x + s.x * s.x) / 24.0;
    m.yy += j * (a.y * a.y + b.y * b.y + s.y * s.y) / 24.0;
    m.xy += j * (a.x * a.y + b.x * b.y + s.x * s.y) / 24.0;
  }
}

/// Twice the signed area of a, b, c: positive when c is left of the line from a to b.
double orient(Vec2 a, Vec2 b, Vec2 c) {
  return cross(b - a, c - a);
}

bool in_box(Vec2 a, Vec2 b, Vec2 p) {
  return std::min(a.x, b.x) <= p.x && p.x <= std::max(a.x, b.x) && std::min(a.y, b.y) <= p.y &&
         p.y <= std::max(a.y, b.y);
}

bool segments_meet(Vec2 a, Vec2 b, Vec2 c, Vec2 d) {
  const double o1 = orient(a, b, c), o2 = orient(a, b, d);
  const double o3 = orient(c, d, a), o4 = orient(c, d, b);
  if (((o1 > 0 && o2 < 0) || (o1 < 0 && o2 > 0)) && ((o3 > 0 && o4 < 0) || (o3 < 0 && o4 > 0))) {
    return true;
  }
  return (o1 == 0 && in_box(a, b, c)) || (o2 == 0 && in_box(a, b, d)) ||
         (o3 == 0 && in_box(c, d, a)) || (o4 == 0 && in_box(c, d, b));
}

}  // namespace

Moments moments(std::span<const Ring> rings) {
  Moments result;
  if (rings.empty() || rings[0].empty()) return result;
  const Vec2 origin = rings[0][0];
  RawMoments about_corner;
  for (const Ring& ring : rings) add_ring(about_corner, ring, origin);
  result.area = about_corner.area;
  if (about_corner.area == 0.0) {
    result.centroid = origin;
    return result;
  }
  const Vec2 offset{about_corner.x / about_corner.area, about_corner.y / about_corner.area};
  result.centroid = origin + offset;
  // A second pass about the centroid costs little and loses no digits to the parallel-axis shift.
  RawMoments m;
  for (const Ring& ring : rings) add_ring(m, ring, result.centroid);
  result.sxx = m.xx;
  result.syy = m.yy;
  result.sxy = m.xy;
  return result;
}

double signed_area(std::span<const Vec2> ring) {
  if (ring.empty()) return 0.0;
  RawMoments m;
  add_ring(m, ring, ring[0]);
  return m.area;
}

int side_of(std::span<const Ring> rings, Vec2 point, double tolerance) {
  bool inside = false;
  for (const Ring& ring : rings) {
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const Vec2 a = ring[i];
      const Vec2 b = ring[i + 1 == ring.size() ? 0 : i + 1];
      if (distance_to_segment(point, a, b) <= tolerance) return 0;
      if ((a.y > point.y) != (b.y > point.y)) {
        const double o = orient(a, b, point);
        if ((o > 0.0) == (b.y > a.y)) inside = !inside;
      }
    }
  }
  return inside ? 1 : -1;
}

/// Andrew's monotone chain, then rotating calipers: the farthest corner from an edge only moves
/// forward from edge to edge. Points that are collinear within rounding are not corners of the
/// hull: among them the farthest corner would be undetermined.
double least_width(std::span<const Vec2> points) {
  std::vector<Vec2> p(points.begin(), points.end());
  const auto before = [](Vec2 a, Vec2 b) { return a.x < b.x || (a.x == b.x && a.y < b.y); };
  std::sort(p.begin(), p.end(), before);
  p.erase(std::unique(p.begin(), p.end()), p.end());
  if (p.size() < 3) return 0.0;
  Vec2 low = p.front(), high = p.back();
  for (const Vec2 q : p) {
    low.y = std::min(low.y, q.y);
    high.y = std::max(high.y, q.y);
  }
  const double straight = 1e-12 * dot(high - low, high - low);
  std::vector<Vec2> hull;
  const auto half = [&hull, straight](auto first, auto last) {
    const std::size_t floor = hull.size();
    for (auto i = first; i != last; ++i) {
      while (hull.size() >= floor + 2 && orient(hull[hull.size() - 2], hull.back(), *i) <= straight)
        hull.pop_back();
      hull.push_back(*i);
    }
    hull.pop_back();
  };
  half(p.begin(), p.end());
  half(p.rbegin(), p.rend());
  const std::size_t n = hull.size();
  if (n < 3) return 0.0;
  double least = std::numeric_limits<double>::infinity();
  std::size_t far = 1;
  for (std::size_t i = 0; i < n; ++i) {
    const Vec2 a = hull[i], b = hull[(i + 1) % n];
    while (orient(a, b, hull[(far + 1) % n]) > orient(a, b, hull[far])) far = (far + 1) % n;
    least = std::min(least, orient(a, b, hull[far]) / norm(b - a));
  }
  return least;
}

bool self_crossing(std::span<const Vec2> ring) {
  const std::size_t n = ring.size();
  if (n < 3) return true;
  auto end_of = [&](std::size_t i) { return ring[i + 1 == n ? 0 : i + 1]; };
  for (std::size_t i = 0; i < n; ++i) {
    const Vec2 a = ring[i], b = end_of(i), c = end_of(i + 1 == n ? 0 : i + 1);
    if (a == b) return true;
    if (cross(b - a, c - b) == 0.0 && dot(b - a, c - b) < 0.0) return true;
  }
  std::vector<std::size_t> order(n);
  std::iota(order.begin(), order.end(), std::size_t{0});
  auto left = [&](std::size_t i) { return std::min(ring[i].x, end_of(i).x); };
  auto right = [&](std::size_t i) { return std::max(ring[i].x, end_of(i).x); };
  std::sort(order.begin(), order.end(),
            [&](std::size_t i, std::size_t j) { return left(i) < left(j); });
  for (std::size_t p = 0; p < n; ++p) {
    const std::size_t i = order[p];
    for (std::size_t q = p + 1; q < n && left(order[q]) <= right(i); ++q) {
      const std::size_t j = order[q];
      const std::size_t gap = i > j ? i - j : j - i;
      if (gap == 1 || gap == n - 1) continue;
      if (segments_meet(ring[i], end_of(i), ring[j], end_of(j))) return true;
    }
  }
  return false;
}

}  // namespace edda
