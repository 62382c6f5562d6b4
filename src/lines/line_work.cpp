#include "lines/line_work.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <string>
#include <utility>

#include "lines/place.hpp"

namespace edda {
namespace {

using Stretch = std::pair<double, double>;

/// Without points that repeat the one before.
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
  const Stretch x = extent_along(ring, {1, 0}), y = extent_along(ring, {0, 1});
  return std::max(x.second - x.first, y.second - y.first);
}

/// The part of a line of a set that is drawn: from the first to the last meeting with the outline
/// and `margin` beyond, so that it crosses the outline instead of ending on it; inside the region,
/// if any.
std::vector<Stretch> drawn(const LineWork& work, const Ring& region, Vec2 point, Vec2 direction,
                           double snap, double margin) {
  const std::vector<Stretch> inside = clip_line(work.outline, point, direction, snap);
  if (inside.empty()) return {};
  const Stretch whole{inside.front().first, inside.back().second};
  const Stretch beyond{whole.first - margin, whole.second + margin};
  if (region.empty()) return {beyond};
  std::vector<Stretch> parts;
  for (Stretch part : clip_line(region, point, direction, snap)) {
    if (part.first <= whole.first + snap) part.first = beyond.first;
    if (part.second >= whole.second - snap) part.second = beyond.second;
    if (part.second - part.first > snap) parts.push_back(part);
  }
  return parts;
}

struct SetRange {
  double first = 0.0, last = -1.0;  ///< numbers of the lines, from that through the origin
};

SetRange range_of(const JointSet& set, const LineWork& work, const Ring& region, Vec2 point,
                  Vec2 normal, double snap) {
  Stretch across = extent_along(work.outline, normal);
  if (!region.empty()) {
    const Stretch limits = extent_along(region, normal);
    across.first = std::max(across.first, limits.first);
    across.second = std::min(across.second, limits.second);
  }
  const double zero = dot(point, normal);
  return {std::ceil((across.first - snap - zero) / set.spacing),
          std::floor((across.second + snap - zero) / set.spacing)};
}

/// Adds the lines of one set; false if they are more than `limit`.
bool add_set(LineWork& work, const JointSet& set, Index source, Vec2 origin, double snap,
             double limit) {
  const Vec2 direction = direction_of(set.angle);
  const Vec2 normal = perp(direction);
  const Vec2 point = set.origin - origin;
  const Ring region = local_ring(set.region, origin);
  const SetRange range = range_of(set, work, region, point, normal, snap);
  if (!(range.last - range.first < limit)) return false;
  const double margin = std::max(1e-3 * size_of(work.outline), 100.0 * snap);
  for (double k = range.first; k <= range.last; k += 1.0) {
    const Vec2 base = point + (k * set.spacing) * normal;
    for (Stretch part : drawn(work, region, base, direction, snap, margin)) {
      work.lines.push_back(
          {{base + part.first * direction, base + part.second * direction}, source});
    }
  }
  return true;
}

void add_ring(LineWork& work, const Ring& ring, Index source) {
  std::vector<Vec2> points = closed(ring);
  if (points.size() > 3) work.lines.push_back({std::move(points), source});
}

Index add_source(LineWork& work, LineKind kind, std::size_t index, Index joint) {
  work.sources.push_back({kind, static_cast<Index>(index), joint});
  return static_cast<Index>(work.sources.size()) - 1;
}

Fault too_many_lines(const JointSet& set, long long max_blocks) {
  return {member_of(set.where, "spacing"),
          "makes more lines than domain.max_blocks = " + std::to_string(max_blocks) + " blocks",
          "raise the spacing, give the set a region, or raise domain.max_blocks"};
}

}  // namespace

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

std::vector<std::pair<double, double>> clip_line(const Ring& ring, Vec2 point, Vec2 direction,
                                                 double tolerance) {
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

Result<LineWork> line_work(const Model& model, Vec2 origin, double snap) {
  const Domain& domain = *model.domain;
  const auto law = [&](Index joint) { return joint == none ? domain.joint : joint; };
  LineWork work;
  work.outline = local_ring(domain.outline, origin);
  for (const Opening& opening : model.openings) {
    work.openings.push_back(local_ring(opening.polygon, origin));
  }
  for (std::size_t i = 0; i < model.traces.size(); ++i) {
    const Index source = add_source(work, LineKind::trace, i, law(model.traces[i].joint));
    LineString line{{}, source};
    for (Vec2 p : model.traces[i].points) line.points.push_back(p - origin);
    line.points = without_repeats(std::move(line.points));
    if (line.points.size() > 1) work.lines.push_back(std::move(line));
  }
  for (std::size_t i = 0; i < model.joint_sets.size(); ++i) {
    const JointSet& set = model.joint_sets[i];
    const Index source = add_source(work, LineKind::joint_set, i, law(set.joint));
    if (!add_set(work, set, source, origin, snap, static_cast<double>(domain.max_blocks))) {
      return too_many_lines(set, domain.max_blocks);
    }
  }
  for (std::size_t i = 0; i < model.openings.size(); ++i) {
    const Index source = add_source(work, LineKind::opening, i, model.openings[i].joint);
    add_ring(work, work.openings[i], source);
  }
  add_ring(work, work.outline, add_source(work, LineKind::outline, 0, none));
  return work;
}

}  // namespace edda
