#include "cutting/planar_graph.hpp"

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <tuple>
#include <utility>

#include "cutting/orientation.hpp"

namespace edda {
namespace {

/// Half-edges leaving each node: item[begin[v] .. begin[v + 1]).
struct Leaving {
  std::vector<int> begin, item;
};

Leaving leaving(const PlanarGraph& g) {
  Leaving out;
  out.begin.assign(g.node.size() + 1, 0);
  const int half_edges = static_cast<int>(2 * g.edge.size());
  for (int h = 0; h < half_edges; ++h) {
    if (g.alive[at(h / 2)]) ++out.begin[at(origin_of(g, h)) + 1];
  }
  std::partial_sum(out.begin.begin(), out.begin.end(), out.begin.begin());
  out.item.resize(at(out.begin.back()));
  std::vector<int> fill(out.begin.begin(), out.begin.end() - 1);
  for (int h = 0; h < half_edges; ++h) {
    if (g.alive[at(h / 2)]) out.item[at(fill[at(origin_of(g, h))]++)] = h;
  }
  return out;
}

/// Sort key of a direction: those in (-90, 90] degrees come first.
bool points_right(Vec2 from, Vec2 to) {
  return to.x > from.x || (to.x == from.x && to.y > from.y);
}

/// Sorts the half-edges of every node counter-clockwise, beginning just past straight down, so that
/// at the leftmost node of a component the first has the component's surroundings on its right.
void sort_round_nodes(const PlanarGraph& g, Leaving& out) {
  for (std::size_t v = 0; v < g.node.size(); ++v) {
    const Vec2 p = g.node[v];
    std::sort(out.item.begin() + out.begin[v], out.item.begin() + out.begin[v + 1],
              [&](int h, int k) {
                const Vec2 a = g.node[at(target_of(g, h))], b = g.node[at(target_of(g, k))];
                const bool right_a = points_right(p, a), right_b = points_right(p, b);
                if (right_a != right_b) return right_a;
                return orientation(p, a, b) > 0;
              });
  }
}

int find_root(std::vector<int>& parent, int i) {
  while (parent[at(i)] != i) i = parent[at(i)] = parent[at(parent[at(i)])];
  return i;
}

/// Joins two sets; the root is the smallest member, for nodes the leftmost.
void join(std::vector<int>& parent, int i, int j) {
  i = find_root(parent, i);
  j = find_root(parent, j);
  parent[at(std::max(i, j))] = std::min(i, j);
}

std::vector<int> leftmost_of_components(const PlanarGraph& g) {
  std::vector<int> parent(g.node.size());
  std::iota(parent.begin(), parent.end(), 0);
  for (std::size_t e = 0; e < g.edge.size(); ++e) {
    if (g.alive[e]) join(parent, g.edge[e].from, g.edge[e].to);
  }
  return parent;
}

void number_cycles(Cycles& c) {
  c.cycle.assign(c.next.size(), -1);
  for (std::size_t h = 0; h < c.next.size(); ++h) {
    if (c.next[h] < 0 || c.cycle[h] >= 0) continue;
    const int id = static_cast<int>(c.start.size());
    c.start.push_back(static_cast<int>(h));
    for (int k = static_cast<int>(h); c.cycle[at(k)] < 0; k = c.next[at(k)]) c.cycle[at(k)] = id;
  }
}

void add_passages(PlanarGraph& g, const std::vector<NodedEdge>& edges,
                  const std::vector<int>& graph_edge, const std::vector<LineSource>& sources) {
  for (std::size_t i = 0; i < edges.size(); ++i) {
    const LineKind kind = sources[at(edges[i].source)].kind;
    if (kind != LineKind::outline && kind != LineKind::opening && kind != LineKind::region)
      continue;
    const int net = edges[i].from == g.edge[at(graph_edge[i])].from ? 1 : -1;
    g.passages.push_back({graph_edge[i], edges[i].source, net});
  }
  std::sort(g.passages.begin(), g.passages.end(), [](const auto& a, const auto& b) {
    return std::tie(a.source, a.edge) < std::tie(b.source, b.edge);
  });
  std::vector<RingPassage> summed;
  for (const RingPassage& p : g.passages) {
    if (!summed.empty() && summed.back().source == p.source && summed.back().edge == p.edge) {
      summed.back().net += p.net;
    } else {
      summed.push_back(p);
    }
  }
  std::erase_if(summed, [](const RingPassage& p) { return p.net == 0; });
  g.passages = std::move(summed);
}

}  // namespace

PlanarGraph planar_graph(NodedLines lines, const std::vector<LineSource>& sources) {
  PlanarGraph g;
  g.node = std::move(lines.nodes);
  const std::vector<NodedEdge>& edges = lines.edges;
  const auto key = [&](int i) {
    const NodedEdge& e = edges[at(i)];
    return std::make_tuple(std::min(e.from, e.to), std::max(e.from, e.to), e.source);
  };
  std::vector<int> order(edges.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](int i, int j) { return key(i) < key(j); });
  std::vector<int> graph_edge(edges.size());
  for (int i : order) {
    const auto [low, high, source] = key(i);
    if (g.edge.empty() || g.edge.back().from != low || g.edge.back().to != high) {
      g.edge.push_back({low, high, source});
    }
    graph_edge[at(i)] = static_cast<int>(g.edge.size()) - 1;
  }
  g.alive.assign(g.edge.size(), 1);
  add_passages(g, edges, graph_edge, sources);
  return g;
}

std::vector<int> trim_free_ends(PlanarGraph& graph) {
  const Leaving out = leaving(graph);
  std::vector<int> degree(graph.node.size());
  std::vector<int> ends;
  for (std::size_t v = 0; v < graph.node.size(); ++v) {
    degree[v] = out.begin[v + 1] - out.begin[v];
    if (degree[v] == 1) ends.push_back(static_cast<int>(v));
  }
  std::vector<int> waiting = ends;
  while (!waiting.empty()) {
    const std::size_t v = at(waiting.back());
    waiting.pop_back();
    for (int i = out.begin[v]; i < out.begin[v + 1]; ++i) {
      const int h = out.item[at(i)];
      if (!graph.alive[at(h / 2)]) continue;
      graph.alive[at(h / 2)] = 0;
      const int w = target_of(graph, h);
      if (--degree[at(w)] == 1) waiting.push_back(w);
    }
  }
  return ends;
}

Cycles trace_cycles(const PlanarGraph& graph) {
  Leaving out = leaving(graph);
  sort_round_nodes(graph, out);
  Cycles c;
  c.next.assign(2 * graph.edge.size(), -1);
  for (std::size_t v = 0; v < graph.node.size(); ++v) {
    const int begin = out.begin[v], end = out.begin[v + 1];
    for (int i = begin; i < end; ++i) {
      // Arriving along the twin of item i, the leftmost turn is the half-edge next clockwise.
      c.next[at(out.item[at(i)] ^ 1)] = out.item[at(i == begin ? end - 1 : i - 1)];
    }
  }
  number_cycles(c);
  const std::vector<int> leftmost = leftmost_of_components(graph);
  for (std::size_t v = 0; v < graph.node.size(); ++v) {
    if (leftmost[v] != static_cast<int>(v) || out.begin[v] == out.begin[v + 1]) continue;
    c.outward.push_back(c.cycle[at(out.item[at(out.begin[v])] ^ 1)]);
  }
  return c;
}

std::vector<int> remove_bridges(PlanarGraph& graph, const Cycles& cycles) {
  std::vector<int> bridges;
  for (std::size_t e = 0; e < graph.edge.size(); ++e) {
    if (!graph.alive[e] || cycles.cycle[2 * e] != cycles.cycle[2 * e + 1]) continue;
    graph.alive[e] = 0;
    bridges.push_back(static_cast<int>(e));
  }
  if (bridges.empty()) return {};
  std::vector<int> parent(graph.node.size());
  std::iota(parent.begin(), parent.end(), 0);
  for (int e : bridges) join(parent, graph.edge[at(e)].from, graph.edge[at(e)].to);
  std::vector<std::uint8_t> counted(graph.node.size(), 0);
  std::vector<int> runs;
  for (int e : bridges) {
    std::uint8_t& seen = counted[at(find_root(parent, graph.edge[at(e)].from))];
    if (!seen) runs.push_back(e);
    seen = 1;
  }
  return runs;
}

}  // namespace edda
