#include "report/shapes.hpp"

#include <algorithm>
#include <cmath>

namespace edda {
namespace {

std::size_t begin_of(const Grid& g, std::size_t cell) {
  return cell == 0 ? 0 : static_cast<std::size_t>(g.ends[cell - 1]);
}

using Edge = std::pair<std::int64_t, std::int64_t>;

std::vector<Edge> outline_of(const Grid& g, std::size_t first, std::size_t end) {
  std::vector<Edge> edges;
  for (std::size_t c = first; c < end; ++c) {
    const std::size_t from = begin_of(g, c), to = static_cast<std::size_t>(g.ends[c]);
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

}  // namespace

std::vector<BlockShape> block_shapes(const Grid& g) {
  std::vector<BlockShape> shapes;
  const Field* id = g.cell_field("id");
  for (std::size_t c = 0; c < g.cell_count();) {
    std::size_t end = c + 1;
    while (id != nullptr && end < g.cell_count() && id->values[end] == id->values[c]) ++end;
    shapes.push_back({c, end, outline_of(g, c, end)});
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

Vec2 centre_of(const Grid& g, const BlockShape& shape, const std::vector<Vec2>& points) {
  const Vec2 base = points[static_cast<std::size_t>(g.corners[begin_of(g, shape.first_cell)])];
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

bool follow(const Grid& g, const std::vector<Vec2>& drawn, Vec2 start, Vec2& now) {
  const std::vector<Vec2> before = drawn_points(g, 0.0);
  for (std::size_t c = 0; c < g.cell_count(); ++c) {
    const std::size_t from = begin_of(g, c), to = static_cast<std::size_t>(g.ends[c]);
    const auto a = static_cast<std::size_t>(g.corners[from]);
    for (std::size_t k = from + 1; k + 1 < to; ++k) {
      const auto b = static_cast<std::size_t>(g.corners[k]),
                 d = static_cast<std::size_t>(g.corners[k + 1]);
      const double area = cross(before[b] - before[a], before[d] - before[a]);
      const double wb = cross(start - before[a], before[d] - before[a]) / area;
      const double wd = cross(before[b] - before[a], start - before[a]) / area;
      constexpr double slack = 1e-6;
      if (!(wb >= -slack) || !(wd >= -slack) || !(wb + wd <= 1.0 + slack)) continue;
      now = drawn[a] + wb * (drawn[b] - drawn[a]) + wd * (drawn[d] - drawn[a]);
      return true;
    }
  }
  return false;
}

}  // namespace edda
