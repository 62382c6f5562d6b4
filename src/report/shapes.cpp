#include "report/shapes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace edda {
namespace {

using Edge = std::pair<std::int64_t, std::int64_t>;

std::vector<Edge> outline_of(const Grid& g, std::size_t first, std::size_t end) {
  std::vector<Edge> edges;
  for (std::size_t c = first; c < end; ++c) {
    const std::size_t from = g.begin(c), to = static_cast<std::size_t>(g.ends[c]);
    for (std::size_t k = from; k < to; ++k) {
      edges.emplace_back(g.corners[k], g.corners[k + 1 == to ? from : k + 1]);
    }
  }
  if (end - first == 1) return edges;
  std::vector<Edge> sorted = edges, outline;
  std::sort(sorted.begin(), sorted.end());
  for (const Edge& e : edges) {
    if (!std::binary_search(sorted.begin(), sorted.end(), Edge{e.second, e.first}))
      outline.push_back(e);
  }
  return outline;
}

/// Closed rings of the edges: at a point that several edges leave, any will do.
std::vector<std::vector<std::int64_t>> rings_of(const std::vector<Edge>& edges) {
  std::multimap<std::int64_t, std::int64_t> next(edges.begin(), edges.end());
  std::vector<std::vector<std::int64_t>> rings;
  while (!next.empty()) {
    std::vector<std::int64_t> ring;
    auto at = next.begin();
    while (at != next.end()) {
      ring.push_back(at->first);
      const std::int64_t to = at->second;
      next.erase(at);
      at = next.find(to);
    }
    rings.push_back(std::move(ring));
  }
  return rings;
}

std::vector<std::vector<std::int64_t>> rings_of_shape(const std::vector<Edge>& outline,
                                                      bool one_cell) {
  if (!one_cell) return rings_of(outline);
  std::vector<std::int64_t> ring;
  ring.reserve(outline.size());
  for (const Edge& e : outline) ring.push_back(e.first);
  return {ring};
}

}  // namespace

std::vector<BlockShape> block_shapes(const Grid& g) {
  std::vector<BlockShape> shapes;
  const Field* id = g.cell_field("id");
  for (std::size_t c = 0; c < g.cell_count();) {
    std::size_t end = c + 1;
    while (id != nullptr && end < g.cell_count() && id->values[end] == id->values[c]) ++end;
    std::vector<Edge> outline = outline_of(g, c, end);
    auto rings = rings_of_shape(outline, end - c == 1);
    shapes.push_back({c, end, std::move(outline), std::move(rings)});
    c = end;
  }
  return shapes;
}

std::vector<Vec2> drawn_points(const Grid& g, double scale) {
  const Field* u = g.point_field("displacement");
  std::vector<Vec2> points(g.point_count());
  for (std::size_t p = 0; p < points.size(); ++p) {
    points[p] = {g.points[3 * p], g.points[3 * p + 1]};
    if (u != nullptr) points[p] += (scale - 1.0) * Vec2{u->values[3 * p], u->values[3 * p + 1]};
  }
  return points;
}

std::vector<double> cell_areas(const Grid& g) {
  std::vector<double> areas(g.cell_count());
  const auto point = [&](std::size_t corner) {
    const auto p = static_cast<std::size_t>(g.corners[corner]);
    return Vec2{g.points[3 * p], g.points[3 * p + 1]};
  };
  for (std::size_t c = 0; c < areas.size(); ++c) {
    const std::size_t from = g.begin(c), to = static_cast<std::size_t>(g.ends[c]);
    double twice = 0.0;
    for (std::size_t k = from + 1; k + 1 < to; ++k)
      twice += cross(point(k) - point(from), point(k + 1) - point(from));
    areas[c] = 0.5 * std::abs(twice);
  }
  return areas;
}

Vec2 centre_of(const Grid& g, const BlockShape& shape, const std::vector<Vec2>& points) {
  const Vec2 base = points[static_cast<std::size_t>(g.corners[g.begin(shape.first_cell)])];
  Vec2 moment;
  double twice = 0.0;
  for (const auto& [a, b] : shape.outline) {
    const Vec2 p = points[static_cast<std::size_t>(a)] - base,
               q = points[static_cast<std::size_t>(b)] - base;
    twice += cross(p, q);
    moment += cross(p, q) / 3.0 * (p + q);
  }
  return twice == 0.0 ? base : base + moment / twice;
}

Vec2 mark_place(const Grid& g, const BlockShape& shape, const std::vector<Vec2>& points) {
  const auto point = [&](std::int64_t p) { return points[static_cast<std::size_t>(p)]; };
  // Distance from the outline, negative outside: an odd number of edges lies to the right inside.
  const auto depth = [&](Vec2 at) {
    bool inside = false;
    double nearest = std::numeric_limits<double>::infinity();
    for (const auto& [p, q] : shape.outline) {
      const Vec2 a = point(p), b = point(q);
      nearest = std::min(nearest, distance_to_segment(at, a, b));
      if ((a.y > at.y) != (b.y > at.y) && at.x < a.x + (at.y - a.y) / (b.y - a.y) * (b.x - a.x))
        inside = !inside;
    }
    return inside ? nearest : -nearest;
  };
  const Vec2 centre = centre_of(g, shape, points);
  if (shape.end_cell - shape.first_cell == 1 || depth(centre) > 0.0) return centre;
  Vec2 best = centre;
  double deepest = -std::numeric_limits<double>::infinity();
  for (std::size_t c = shape.first_cell; c < shape.end_cell; ++c) {
    Vec2 middle;
    const std::size_t from = g.begin(c), to = static_cast<std::size_t>(g.ends[c]);
    for (std::size_t k = from; k < to; ++k)
      middle += point(g.corners[k]) / static_cast<double>(to - from);
    if (const double d = depth(middle); d > deepest) deepest = d, best = middle;
  }
  return best;
}

Follower::Follower(const Grid& grid, std::vector<Vec2> from, const std::vector<Vec2>& to)
    : grid_(grid), from_(std::move(from)), to_(to) {
  bounds_.reserve(grid.cell_count());
  for (std::size_t c = 0; c < grid.cell_count(); ++c) {
    Bounds b{{1e300, 1e300}, {-1e300, -1e300}};
    for (std::size_t k = grid.begin(c); k < static_cast<std::size_t>(grid.ends[c]); ++k) {
      const Vec2 p = from_[static_cast<std::size_t>(grid.corners[k])];
      b.low = {std::min(b.low.x, p.x), std::min(b.low.y, p.y)};
      b.high = {std::max(b.high.x, p.x), std::max(b.high.y, p.y)};
    }
    const double slack = 1e-6 * (b.high.x - b.low.x + b.high.y - b.low.y);
    bounds_.push_back({b.low - Vec2{slack, slack}, b.high + Vec2{slack, slack}});
  }
  const auto [least, most] =
      std::minmax_element(from_.begin(), from_.end(), [](Vec2 a, Vec2 b) { return a.x < b.x; });
  if (least != from_.end()) width_ = most->x - least->x;
}

std::optional<Vec2> Follower::within(std::size_t cell, Vec2 start) const {
  const std::size_t from = grid_.begin(cell), to = static_cast<std::size_t>(grid_.ends[cell]);
  const auto a = static_cast<std::size_t>(grid_.corners[from]);
  for (std::size_t k = from + 1; k + 1 < to; ++k) {
    const auto b = static_cast<std::size_t>(grid_.corners[k]),
               d = static_cast<std::size_t>(grid_.corners[k + 1]);
    const double area = cross(from_[b] - from_[a], from_[d] - from_[a]);
    const double wb = cross(start - from_[a], from_[d] - from_[a]) / area;
    const double wd = cross(from_[b] - from_[a], start - from_[a]) / area;
    constexpr double slack = 1e-6;
    if (!(wb >= -slack) || !(wd >= -slack) || !(wb + wd <= 1.0 + slack)) continue;
    return to_[a] + wb * (to_[b] - to_[a]) + wd * (to_[d] - to_[a]);
  }
  return {};
}

std::optional<Vec2> Follower::operator()(Vec2 start) const {
  const Field* const fixed = grid_.cell_field("fixed");
  std::optional<Vec2> with_fixed;
  for (std::size_t c = 0; c < bounds_.size(); ++c) {
    const Bounds& b = bounds_[c];
    if (start.x < b.low.x || start.x > b.high.x || start.y < b.low.y || start.y > b.high.y)
      continue;
    const std::optional<Vec2> now = within(c, start);
    if (!now) continue;
    if (fixed == nullptr || fixed->values[c] == 0.0) return now;
    if (!with_fixed) with_fixed = now;
  }
  return with_fixed;
}

std::optional<Vec2> Follower::on_surface(Vec2 start) const {
  const double near = 2e-4 * width_;
  for (const Vec2 by : {Vec2{}, Vec2{0, -near}, Vec2{0, near}, Vec2{-near, 0}, Vec2{near, 0}}) {
    if (const auto now = (*this)(start + by)) return *now - by;
  }
  return {};
}

std::vector<std::size_t> thinned(const std::vector<Vec2>& centres, double raster) {
  struct Best {
    std::size_t shape;
    double distance;
  };
  std::map<std::pair<long, long>, Best> best;
  for (std::size_t i = 0; i < centres.size(); ++i) {
    const Vec2 p = centres[i] / raster;
    if (!std::isfinite(p.x) || !std::isfinite(p.y)) continue;
    const Vec2 square{std::floor(p.x), std::floor(p.y)};
    const double distance = norm(p - square - Vec2{0.5, 0.5});
    const auto [there, is_new] = best.try_emplace(
        {static_cast<long>(square.x), static_cast<long>(square.y)}, Best{i, distance});
    if (!is_new && distance < there->second.distance) there->second = {i, distance};
  }
  std::vector<std::size_t> kept;
  kept.reserve(best.size());
  for (const auto& [square, b] : best) kept.push_back(b.shape);
  return kept;
}

}  // namespace edda
