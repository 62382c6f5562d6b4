#include "cutting/quality.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>

#include "base/polygon.hpp"

namespace edda {
namespace {

/// Angle inside the block at b, whose block lies on the left of a -> b -> c; degrees in [0, 360).
double inner_angle(Vec2 a, Vec2 b, Vec2 c) {
  const Vec2 in = b - a, out = c - b;
  const double turn = std::atan2(cross(in, out), dot(in, out));
  return 180.0 - turn * 180.0 / std::numbers::pi;
}

void keep_smaller(double value, Vec2 at, double& smallest, Vec2& place) {
  if (value >= smallest) return;
  smallest = value;
  place = at;
}

void measure_ring(const Ring& ring, Vec2 origin, CutReport& report) {
  const std::size_t n = ring.size();
  for (std::size_t i = 0; i < n; ++i) {
    const Vec2 a = ring[i], b = ring[(i + 1) % n], c = ring[(i + 2) % n];
    keep_smaller(norm(b - a), origin + (a + b) / 2.0, report.smallest_edge,
                 report.smallest_edge_at);
    keep_smaller(inner_angle(a, b, c), origin + b, report.smallest_angle, report.smallest_angle_at);
  }
}

}  // namespace

void measure_quality(std::span<const BlockPolygon> blocks, Vec2 origin, CutReport& report) {
  if (blocks.empty()) return;
  constexpr double huge = std::numeric_limits<double>::infinity();
  report.smallest_area = report.smallest_edge = report.smallest_angle = huge;
  for (const BlockPolygon& block : blocks) {
    const Moments m = moments(block.rings);
    keep_smaller(m.area, origin + m.centroid, report.smallest_area, report.smallest_area_at);
    for (const Ring& ring : block.rings) measure_ring(ring, origin, report);
  }
}

/// Width w, area A, diameter D and perimeter P of a convex ring: A <= w D and 2 D <= P, so it is at
/// least 2 A/P wide.
bool is_sliver(double area, double perimeter, std::span<const Vec2> ring, const Quality& quality) {
  if (area < quality.min_area) return true;
  if (2.0 * area >= quality.min_edge * perimeter) return false;
  if (4.0 * area < quality.min_edge * perimeter) return true;
  return least_width(ring) < quality.min_edge;
}

void judge_blocks(std::span<BlockPolygon> cut, const Quality& quality, Vec2 origin,
                  CutReport& report) {
  for (BlockPolygon& block : cut) {
    const Moments m = moments(block.rings);
    double perimeter = 0.0;
    for (const Ring& ring : block.rings) {
      const std::size_t n = ring.size();
      for (std::size_t i = 0; i < n; ++i) {
        const Vec2 a = ring[i], b = ring[(i + 1) % n], c = ring[(i + 2) % n];
        perimeter += norm(b - a);
        report.short_edges += norm(b - a) < quality.min_edge;
        report.sharp_corners += inner_angle(a, b, c) < quality.min_angle;
      }
    }
    if (!is_sliver(m.area, perimeter, block.rings[0], quality)) continue;
    ++report.slivers;
    if (quality.action != QualityAction::merge || block.fixed) continue;
    block.slow = true;
    report.kept.push_back({origin + m.centroid, m.area});
  }
}

}  // namespace edda
