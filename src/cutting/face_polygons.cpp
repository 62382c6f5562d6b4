#include "cutting/face_polygons.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <utility>

#include "cutting/straight_runs.hpp"

namespace edda {
namespace {

/// A closed walk along half-edges.
using Walk = std::vector<int>;

/// Splits a cycle where it comes back to a node, so that each part is a simple ring. Few cycles do,
/// so this is checked first.
std::vector<Walk> simple_walks(const PlanarGraph& g, const Walk& cycle) {
  std::vector<int> nodes;
  nodes.reserve(cycle.size());
  for (int h : cycle) nodes.push_back(origin_of(g, h));
  std::sort(nodes.begin(), nodes.end());
  if (std::adjacent_find(nodes.begin(), nodes.end()) == nodes.end()) return {cycle};
  std::vector<Walk> walks;
  Walk open;
  for (int h : cycle) {
    const int node = origin_of(g, h);
    const auto seen =
        std::find_if(open.begin(), open.end(), [&](int k) { return origin_of(g, k) == node; });
    if (seen != open.end()) {
      walks.emplace_back(seen, open.end());
      open.erase(seen, open.end());
    }
    open.push_back(h);
  }
  walks.push_back(std::move(open));
  return walks;
}

Ring ring_of(const PlanarGraph& g, const Walk& walk) {
  Ring ring;
  ring.reserve(walk.size());
  for (int h : walk) ring.push_back(g.node[at(origin_of(g, h))]);
  return ring;
}

Walk walk_of(const Faces& faces, int cycle) {
  Walk walk;
  const int start = faces.cycles.start[at(cycle)];
  int h = start;
  do {
    walk.push_back(h);
    h = faces.cycles.next[at(h)];
  } while (h != start);
  return walk;
}

/// All rings of a face, the outer one first: that is the walk of the outer cycle with the largest
/// area.
std::vector<Walk> walks_of(const PlanarGraph& g, const Faces& faces, int face) {
  std::vector<Walk> walks = simple_walks(g, walk_of(faces, faces.outer[at(face)]));
  const auto area = [&](const Walk& w) { return signed_area(ring_of(g, w)); };
  const auto outer = std::max_element(
      walks.begin(), walks.end(), [&](const Walk& a, const Walk& b) { return area(a) < area(b); });
  std::iter_swap(walks.begin(), outer);
  for (int i = faces.hole_begin[at(face)]; i < faces.hole_begin[at(face) + 1]; ++i) {
    for (Walk& w : simple_walks(g, walk_of(faces, faces.hole[at(i)])))
      walks.push_back(std::move(w));
  }
  return walks;
}

double length_of(const PlanarGraph& g, int h) {
  return norm(g.node[at(target_of(g, h))] - g.node[at(origin_of(g, h))]);
}

/// 2 area / perimeter: the width of a long thin face, m.
double width_of(const PlanarGraph& g, const Faces& faces, int face) {
  double perimeter = 0.0;
  for_each_half_edge(faces, face, [&](int h) { perimeter += length_of(g, h); });
  return 2.0 * face_area(g, faces, face) / perimeter;
}

/// The rock face with which `face` shares the longest boundary, or -1.
int longest_neighbour(const PlanarGraph& g, const Faces& faces, const std::vector<int>& rock,
                      int face) {
  std::vector<std::pair<int, double>> shared;
  for_each_half_edge(faces, face, [&](int h) {
    const int other = face_of(faces, h ^ 1);
    if (other == face || rock[at(other)] != rock[at(face)]) return;
    auto known =
        std::find_if(shared.begin(), shared.end(), [&](const auto& s) { return s.first == other; });
    if (known == shared.end()) known = shared.insert(shared.end(), {other, 0.0});
    known->second += length_of(g, h);
  });
  const auto best =
      std::max_element(shared.begin(), shared.end(),
                       [](const auto& a, const auto& b) { return a.second < b.second; });
  return best == shared.end() ? -1 : best->first;
}

double distance_to_edge(const PlanarGraph& g, int h, Vec2 p) {
  return distance_to_segment(p, g.node[at(origin_of(g, h))], g.node[at(target_of(g, h))]);
}

/// The two long sides of a sliver are one line: where the side towards `into` comes first in
/// precedence, its source passes to the side that stays.
void pass_on_source(PlanarGraph& g, const Faces& faces, int sliver, int into, double snap) {
  std::vector<int> going, staying;
  for_each_half_edge(faces, sliver, [&](int h) {
    if (length_of(g, h) <= 4.0 * snap) return;
    (face_of(faces, h ^ 1) == into ? going : staying).push_back(h);
  });
  for (int h : staying) {
    const Vec2 middle = 0.5 * (g.node[at(origin_of(g, h))] + g.node[at(target_of(g, h))]);
    Index& source = g.edge[at(h / 2)].source;
    for (int k : going) {
      if (distance_to_edge(g, k, middle) > 4.0 * snap) continue;
      source = std::min(source, g.edge[at(k / 2)].source);
    }
  }
}

/// The larger `width` of the sources of a face with two edges or more of sources that have one;
/// fewer are no lines that met before they were rounded.
double width_between_rounded(const PlanarGraph& graph, const Faces& faces, int face,
                             const std::vector<double>& width) {
  int edges = 0;
  double largest = 0.0;
  for_each_half_edge(faces, face, [&](int h) {
    const double w = width[at(graph.edge[at(h / 2)].source)];
    edges += w > 0.0;
    largest = std::max(largest, w);
  });
  return edges >= 2 ? largest : 0.0;
}

}  // namespace

double face_area(const PlanarGraph& graph, const Faces& faces, int face) {
  const int outer = faces.outer[at(face)];
  const Vec2 base = graph.node[at(origin_of(graph, faces.cycles.start[at(outer)]))];
  double twice = 0.0;
  for_each_half_edge(faces, face, [&](int h) {
    twice += cross(graph.node[at(origin_of(graph, h))] - base,
                   graph.node[at(target_of(graph, h))] - base);
  });
  return twice / 2.0;
}

bool has_thin_face(const PlanarGraph& graph, const Faces& faces, double width) {
  for (int face = 1; face < static_cast<int>(faces.outer.size()); ++face) {
    if (width_of(graph, faces, face) < width) return true;
  }
  return false;
}

int merge_slivers(PlanarGraph& graph, const Faces& faces, const std::vector<int>& rock, double snap,
                  const std::vector<double>& width) {
  std::vector<int> parent(rock.size());
  std::iota(parent.begin(), parent.end(), 0);
  const auto root = [&](int i) {
    while (parent[at(i)] != i) i = parent[at(i)];
    return i;
  };
  int merged = 0;
  for (std::size_t f = 1; f < rock.size(); ++f) {
    const int face = static_cast<int>(f);
    if (rock[f] < 0) continue;
    const double least = std::max(2.0 * snap, width_between_rounded(graph, faces, face, width));
    if (width_of(graph, faces, face) >= least) continue;
    const int into = longest_neighbour(graph, faces, rock, face);
    if (into < 0 || root(into) == root(face)) continue;
    parent[at(root(face))] = root(into);
    pass_on_source(graph, faces, face, into, std::max(snap, 0.5 * least));
    ++merged;
  }
  if (merged == 0) return 0;
  for (std::size_t e = 0; e < graph.edge.size(); ++e) {
    if (!graph.alive[e]) continue;
    const int h = static_cast<int>(2 * e);
    if (root(face_of(faces, h)) == root(face_of(faces, h + 1))) graph.alive[e] = 0;
  }
  return merged;
}

BlockPolygon face_polygon(const PlanarGraph& graph, const Faces& faces, int face,
                          const std::vector<LineSource>& sources, double tolerance) {
  BlockPolygon block;
  for (const Walk& walk : walks_of(graph, faces, face)) {
    Ring ring = ring_of(graph, walk);
    std::vector<Index> law, table;
    for (int h : walk) {
      const Index row = graph.edge[at(h / 2)].source;
      const LineSource& source = sources[at(row)];
      law.push_back(source.joint);
      table.push_back(source.kind == LineKind::outline ? none : row);
    }
    remove_straight_runs(ring, law, tolerance, &table);
    block.rings.push_back(std::move(ring));
    block.joint.push_back(std::move(law));
    block.table.push_back(std::move(table));
  }
  return block;
}

void sort_by_centroid(std::vector<BlockPolygon>& blocks, double tolerance) {
  std::vector<std::pair<Vec2, std::size_t>> order;
  order.reserve(blocks.size());
  for (const BlockPolygon& block : blocks) {
    order.emplace_back(moments(block.rings).centroid, order.size());
  }
  const auto across = [](const auto& a, const auto& b) { return a.first.x < b.first.x; };
  std::sort(order.begin(), order.end(), [](const auto& a, const auto& b) {
    return a.first.y < b.first.y || (a.first.y == b.first.y && a.first.x < b.first.x);
  });
  for (auto row = order.begin(); row != order.end();) {
    auto end = row + 1;
    while (end != order.end() && end->first.y - (end - 1)->first.y <= tolerance) ++end;
    std::stable_sort(row, end, across);
    row = end;
  }
  std::vector<BlockPolygon> sorted;
  sorted.reserve(blocks.size());
  for (const auto& [centroid, i] : order) sorted.push_back(std::move(blocks[i]));
  blocks = std::move(sorted);
}

}  // namespace edda
