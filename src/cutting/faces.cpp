#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>
#include <utility>

#include "cutting/orientation.hpp"
#include "cutting/planar_graph.hpp"

namespace edda {
namespace {

/// The edges that are not horizontal, by horizontal strips of equal height: item[begin[s] ..
/// begin[s + 1]).
struct Strips {
  double low = 0.0, height = 1.0;
  int count = 1;
  std::vector<int> begin, item;
};

int strip_of(const Strips& strips, double y) {
  const double s = (y - strips.low) / strips.height;
  return static_cast<int>(std::clamp(s, 0.0, strips.count - 1.0));
}

Strips strips_of(const PlanarGraph& g) {
  Strips strips;
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (Vec2 p : g.node) {
    low = std::min(low, p.y);
    high = std::max(high, p.y);
  }
  strips.low = low;
  strips.count = 1 + static_cast<int>(std::sqrt(static_cast<double>(g.edge.size())));
  if (high > low) strips.height = (high - low) / strips.count;
  const auto visit = [&](auto take) {
    for (std::size_t e = 0; e < g.edge.size(); ++e) {
      const double a = g.node[at(g.edge[e].from)].y, b = g.node[at(g.edge[e].to)].y;
      if (!g.alive[e] || a == b) continue;
      const int last = strip_of(strips, std::max(a, b));
      for (int s = strip_of(strips, std::min(a, b)); s <= last; ++s) take(s, static_cast<int>(e));
    }
  };
  strips.begin.assign(at(strips.count) + 1, 0);
  visit([&](int s, int) { ++strips.begin[at(s) + 1]; });
  std::partial_sum(strips.begin.begin(), strips.begin.end(), strips.begin.begin());
  strips.item.resize(at(strips.begin.back()));
  std::vector<int> fill(strips.begin.begin(), strips.begin.end() - 1);
  visit([&](int s, int e) { strips.item[at(fill[at(s)]++)] = e; });
  return strips;
}

/// The half-edge of e that runs upwards.
int upward(const PlanarGraph& g, int e) {
  return g.node[at(origin_of(g, 2 * e))].y < g.node[at(target_of(g, 2 * e))].y ? 2 * e : 2 * e + 1;
}

/// Whether edge e lies left of edge f on the horizontal line just above y, which meets both. Edges
/// do not cross.
bool left_of(const PlanarGraph& g, int e, int f) {
  const int h = upward(g, e), k = upward(g, f);
  const Vec2 e0 = g.node[at(origin_of(g, h))], e1 = g.node[at(target_of(g, h))];
  const Vec2 f0 = g.node[at(origin_of(g, k))], f1 = g.node[at(target_of(g, k))];
  if (e0.y >= f0.y) {
    const int side = orientation(f0, f1, e0);
    return side != 0 ? side > 0 : orientation(f0, f1, e1) > 0;
  }
  const int side = orientation(e0, e1, f0);
  return side != 0 ? side < 0 : orientation(e0, e1, f1) < 0;
}

/// The upward half-edge that is first to the left of node v, just above its height; -1 if there is
/// none.
int first_to_the_left(const PlanarGraph& g, const Strips& strips, int v) {
  const Vec2 p = g.node[at(v)];
  const std::size_t s = at(strip_of(strips, p.y));
  int nearest = -1;
  for (int i = strips.begin[s]; i < strips.begin[s + 1]; ++i) {
    const int e = strips.item[at(i)];
    const int h = upward(g, e);
    const Vec2 a = g.node[at(origin_of(g, h))], b = g.node[at(target_of(g, h))];
    if (p.y < a.y || p.y >= b.y || orientation(a, b, p) >= 0) continue;
    if (nearest < 0 || left_of(g, nearest, e)) nearest = e;
  }
  return nearest < 0 ? -1 : upward(g, nearest);
}

int leftmost_node(const PlanarGraph& g, const Cycles& c, int cycle) {
  int best = std::numeric_limits<int>::max();
  int h = c.start[at(cycle)];
  do {
    best = std::min(best, origin_of(g, h));
    h = c.next[at(h)];
  } while (h != c.start[at(cycle)]);
  return best;
}

/// Gives the outward cycle of each component the face that surrounds it.
void place_components(const PlanarGraph& g, Faces& f) {
  std::vector<std::pair<int, int>> components;  // leftmost node, outward cycle
  for (int cycle : f.cycles.outward) {
    components.emplace_back(leftmost_node(g, f.cycles, cycle), cycle);
  }
  std::sort(components.begin(), components.end());
  if (components.size() == 1) {
    f.of_cycle[at(components[0].second)] = 0;
    return;
  }
  const Strips strips = strips_of(g);
  for (auto [node, cycle] : components) {
    // The edge that was found lies further left, so that its component already has its face.
    const int h = first_to_the_left(g, strips, node);
    f.of_cycle[at(cycle)] = h < 0 ? 0 : f.of_cycle[at(f.cycles.cycle[at(h ^ 1)])];
  }
}

void list_holes(Faces& f) {
  f.hole_begin.assign(f.outer.size() + 1, 0);
  for (int cycle : f.cycles.outward) ++f.hole_begin[at(f.of_cycle[at(cycle)]) + 1];
  std::partial_sum(f.hole_begin.begin(), f.hole_begin.end(), f.hole_begin.begin());
  f.hole.resize(f.cycles.outward.size());
  std::vector<int> fill(f.hole_begin.begin(), f.hole_begin.end() - 1);
  for (int cycle : f.cycles.outward) f.hole[at(fill[at(f.of_cycle[at(cycle)])]++)] = cycle;
}

}  // namespace

Faces find_faces(const PlanarGraph& graph, Cycles cycles) {
  Faces f;
  f.cycles = std::move(cycles);
  f.of_cycle.assign(f.cycles.start.size(), -1);
  for (int cycle : f.cycles.outward) f.of_cycle[at(cycle)] = 0;
  f.outer.assign(1, -1);
  for (std::size_t c = 0; c < f.of_cycle.size(); ++c) {
    if (f.of_cycle[c] == 0) continue;
    f.of_cycle[c] = static_cast<int>(f.outer.size());
    f.outer.push_back(static_cast<int>(c));
  }
  if (!f.cycles.outward.empty()) place_components(graph, f);
  list_holes(f);
  return f;
}

std::vector<std::uint8_t> inside_ring(const PlanarGraph& graph, const Faces& faces, Index source) {
  std::vector<std::uint8_t> inside(faces.outer.size(), 0);
  std::vector<std::uint8_t> barrier(graph.edge.size(), 0);
  std::vector<int> waiting;
  const auto enter = [&](int face) {
    if (inside[at(face)]) return;
    inside[at(face)] = 1;
    waiting.push_back(face);
  };
  for (const RingPassage& p : graph.passages) {
    if (p.source != source || !graph.alive[at(p.edge)]) continue;
    barrier[at(p.edge)] = 1;
    enter(face_of(faces, p.net > 0 ? 2 * p.edge : 2 * p.edge + 1));
  }
  while (!waiting.empty()) {
    const int face = waiting.back();
    waiting.pop_back();
    for_each_half_edge(faces, face, [&](int h) {
      if (!barrier[at(h / 2)]) enter(face_of(faces, h ^ 1));
    });
  }
  return inside;
}

}  // namespace edda
