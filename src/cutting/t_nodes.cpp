#include "cutting/t_nodes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <unordered_map>
#include <vector>

namespace edda {
namespace {

struct Corner {
  Vec2 at;
  std::size_t block;
  Vec2 in, out;  ///< unit vectors of the edges before and after it

  /// Whether both of its edges lie along this direction: then it is hardly a corner.
  bool lies_along(Vec2 direction) const {
    return std::min(std::abs(dot(in, direction)), std::abs(dot(out, direction))) > along_from;
  }
  static constexpr double along_from = 0.99;  // cosine: 8 degrees
};

/// The corners of all blocks, in square cells.
class Cells {
 public:
  explicit Cells(const PolygonSet& set) {
    double length = 0.0;
    std::size_t edges = 0;
    for (const BlockPolygon& block : set.blocks) {
      for (const Ring& ring : block.rings) {
        for (std::size_t v = 0; v < ring.size(); ++v, ++edges)
          length += norm(ring[(v + 1) % ring.size()] - ring[v]);
      }
    }
    size_ = edges > 0 ? length / static_cast<double>(edges) : 1.0;
    for (std::size_t i = 0; i < set.blocks.size(); ++i) {
      for (const Ring& ring : set.blocks[i].rings) {
        const std::size_t n = ring.size();
        for (std::size_t v = 0; v < n; ++v) {
          const Vec2 p = ring[v];
          corners_[key(index(p.x), index(p.y))].push_back(
              {p, i, unit(p - ring[(v + n - 1) % n]), unit(ring[(v + 1) % n] - p)});
        }
      }
    }
  }

  /// Calls body(corner) for those in the cells along the edge from a to b.
  template <class Body>
  void along(Vec2 a, Vec2 b, double tolerance, Body body) const {
    const auto columns = span(a.x, b.x, tolerance);
    for (std::int64_t x = columns.first; x <= columns.second; ++x) {
      const auto rows = rows_of(a, b, x, tolerance);
      for (std::int64_t y = rows.first; y <= rows.second; ++y) {
        const auto found = corners_.find(key(x, y));
        if (found == corners_.end()) continue;
        for (const Corner& c : found->second) body(c);
      }
    }
  }

 private:
  using Range = std::pair<std::int64_t, std::int64_t>;
  std::int64_t index(double x) const { return static_cast<std::int64_t>(std::floor(x / size_)); }
  static std::uint64_t key(std::int64_t x, std::int64_t y) {
    return (static_cast<std::uint64_t>(x) << 32) ^ (static_cast<std::uint64_t>(y) & 0xffffffffu);
  }
  Range span(double p, double q, double more) const {
    return {index(std::min(p, q) - more), index(std::max(p, q) + more)};
  }
  /// The rows through which the edge passes in column x.
  Range rows_of(Vec2 a, Vec2 b, std::int64_t x, double more) const {
    if (std::abs(b.x - a.x) <= size_) return span(a.y, b.y, more);
    const auto y_at = [&](double at) {
      return a.y + std::clamp((at - a.x) / (b.x - a.x), 0.0, 1.0) * (b.y - a.y);
    };
    const double left = static_cast<double>(x) * size_ - more;
    return span(y_at(left), y_at(left + size_ + 2.0 * more), more);
  }

  double size_;
  std::unordered_map<std::uint64_t, std::vector<Corner>> corners_;
};

/// A corner of a neighbour within an edge, by its fraction of the way.
struct Node {
  double fraction;
  Vec2 at;
};

/// Those of the edge from a to b of block i, in order.
std::vector<Node> nodes_within(const Cells& cells, Vec2 a, Vec2 b, std::size_t i,
                               double tolerance) {
  const Vec2 along = b - a;
  const double square = dot(along, along);
  std::vector<Node> nodes;
  cells.along(a, b, tolerance, [&](const Corner& c) {
    if (c.block == i || c.lies_along(unit(along))) return;
    const double fraction = dot(c.at - a, along) / square;
    if (std::abs(cross(c.at - a, along)) > tolerance * std::sqrt(square)) return;
    nodes.push_back({fraction, c.at});
  });
  std::sort(nodes.begin(), nodes.end(),
            [](const Node& p, const Node& q) { return p.fraction < q.fraction; });
  return nodes;
}

constexpr double shortest =
    0.05;  // of an edge: the motion of a shorter piece is that of its corner

/// The edges of a block, ring after ring, and the nodes within each.
struct Edge {
  Vec2 from, to;
  std::vector<Node> nodes;

  /// Adds it unless another or an end is nearer than `apart`, a fraction of the edge.
  void add(const Node& node, double apart = shortest) {
    if (node.fraction < apart || node.fraction > 1.0 - apart) return;
    const auto after = std::find_if(nodes.begin(), nodes.end(), [&](const Node& other) {
      return other.fraction > node.fraction - apart;
    });
    if (after != nodes.end() && after->fraction < node.fraction + apart) return;
    nodes.insert(after, node);
  }
};

/// What lies across the block from p, a point of one of its edges: the edge, the fraction of the
/// way along it, and how far away it is, m; infinite if none does.
struct Across {
  std::size_t edge = 0;
  double fraction = 0.0, distance = std::numeric_limits<double>::infinity();
};
Across across_from(const std::vector<Edge>& edges, std::size_t own, Vec2 p) {
  const Vec2 inward = perp(unit(edges[own].to - edges[own].from));
  Across nearest;
  for (std::size_t k = 0; k < edges.size(); ++k) {
    const Vec2 along = edges[k].to - edges[k].from;
    const double turn = cross(inward, along);
    if (k == own || turn == 0.0) continue;
    const double distance = cross(edges[k].from - p, along) / turn,
                 fraction = cross(edges[k].from - p, inward) / turn;
    if (distance > 0.0 && distance < nearest.distance && fraction >= 0.0 && fraction <= 1.0)
      nearest = {k, fraction, distance};
  }
  return nearest;
}

/// Where a node within a long edge moves, the block seems to bend as a whole, since the opposite
/// edge, which a face or a boundary may hold all along, has no corner that tells. So nodes of edges
/// that are longer than the block is thick there have partners across it.
void add_partners(std::vector<Edge>& edges) {
  constexpr double long_from = 1.5;  // of the thickness
  std::vector<Across> wanted;
  for (std::size_t k = 0; k < edges.size(); ++k) {
    const double length = norm(edges[k].to - edges[k].from);
    for (const Node& node : edges[k].nodes) {
      const Across across = across_from(edges, k, node.at);
      if (length > long_from * across.distance) wanted.push_back(across);
    }
  }
  for (const Across& w : wanted) {
    Edge& e = edges[w.edge];
    const Vec2 along = e.to - e.from;
    e.add({w.fraction, e.from + w.fraction * along},
          std::max(shortest, 0.5 * w.distance / norm(along)));
  }
}

std::size_t corners_of(const std::vector<Edge>& edges) {
  std::size_t corners = edges.size();
  for (const Edge& e : edges) corners += e.nodes.size();
  return corners;
}

}  // namespace

void divide_edges(BlockPolygon& block, const std::function<std::vector<Vec2>(Vec2, Vec2)>& within) {
  for (std::size_t r = 0; r < block.rings.size(); ++r) {
    Ring ring;
    std::vector<Index> joint, table;
    for (std::size_t e = 0; e < block.joint[r].size(); ++e) {
      const Vec2 from = block.rings[r][e], to = block.rings[r][(e + 1) % block.rings[r].size()];
      const std::vector<Vec2> points = within(from, to);
      ring.push_back(from);
      ring.insert(ring.end(), points.begin(), points.end());
      joint.insert(joint.end(), 1 + points.size(), block.joint[r][e]);
      if (!block.table.empty()) table.insert(table.end(), 1 + points.size(), block.table[r][e]);
    }
    block.rings[r] = std::move(ring);
    block.joint[r] = std::move(joint);
    if (!block.table.empty()) block.table[r] = std::move(table);
  }
}

void add_t_nodes(PolygonSet& set, double tolerance,
                 const std::function<TNodes(std::size_t)>& may_have) {
  const Cells cells(set);
  for (std::size_t i = 0; i < set.blocks.size(); ++i) {
    const TNodes allowed = may_have(i);
    if (allowed.most == 0) continue;
    BlockPolygon& block = set.blocks[i];
    std::vector<Edge> edges;
    for (const Ring& ring : block.rings) {
      for (std::size_t v = 0; v < ring.size(); ++v) {
        edges.push_back({ring[v], ring[(v + 1) % ring.size()], {}});
        for (const Node& node :
             nodes_within(cells, edges.back().from, edges.back().to, i, tolerance))
          edges.back().add(node);
      }
    }
    if (corners_of(edges) > allowed.most) continue;
    if (allowed.partners) {
      std::vector<Edge> with_partners = edges;
      add_partners(with_partners);
      if (corners_of(with_partners) <= allowed.most) edges = std::move(with_partners);
    }
    auto edge = edges.begin();
    divide_edges(block, [&](Vec2, Vec2) {
      std::vector<Vec2> points;
      for (const Node& node : edge->nodes) points.push_back(node.at);
      ++edge;
      return points;
    });
  }
}

}  // namespace edda
