#include "cutting/mesh.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <queue>
#include <utility>

#include "cutting/orientation.hpp"

namespace edda {
namespace {

using Node = std::uint32_t;
using Cell = std::uint32_t;
constexpr Cell outside = 0xffffffffu;

/// Circle through three points.
struct Circle {
  Vec2 centre;
  double square = 0.0;  ///< of the radius, m2
};
Circle circle_through(Vec2 a, Vec2 b, Vec2 c) {
  const Vec2 u = b - a, v = c - a;
  const double twice = cross(u, v), uu = dot(u, u), vv = dot(v, v);
  if (!(twice > 0.0)) return {a, std::numeric_limits<double>::infinity()};
  const Vec2 arm = (0.5 / twice) * Vec2{v.y * uu - u.y * vv, u.x * vv - v.x * uu};
  return {a + arm, dot(arm, arm)};
}

/// A triangle and its neighbours across the edges opposite to its corners.
struct Facet {
  std::array<Node, 3> node;
  std::array<Cell, 3> beside;
  Circle circle;
  double size = 0.0;  ///< m, asked for at its centroid
  bool alive = true;
};

class Mesher {
 public:
  Mesher(std::span<const Ring> rings, const MeshSize& size) : size_(size) {
    for (const Ring& ring : rings) nodes_.insert(nodes_.end(), ring.begin(), ring.end());
    fixed_ = nodes_.size();
    for (const Triangle& t : triangulate(rings))
      cells_.push_back({t, {outside, outside, outside}, {}});
    join_neighbours();
    for (Cell t = 0; t < cells_.size(); ++t) measure(t);
    make_delaunay();
  }

  void refine() {
    for (Cell t = 0; t < cells_.size(); ++t) enqueue(t);
    while (!queue_.empty()) {
      const Bad worst = queue_.top();
      queue_.pop();
      if (cells_[worst.cell].alive && cells_[worst.cell].node == worst.node)
        insert(worst.cell, cells_[worst.cell].circle.centre);
    }
  }

  /// Moves inner nodes towards the centres of the triangles around them, weighted by area.
  void smooth() {
    constexpr int rounds = 4;
    for (int round = 0; round < rounds; ++round) {
      std::vector<Vec2> sum(nodes_.size());
      std::vector<double> weight(nodes_.size(), 0.0);
      for (const Facet& f : cells_) {
        if (!f.alive) continue;
        const double area = twice_area(f);
        const Vec2 centre = centroid(f);
        for (const Node n : f.node) {
          sum[n] += area * centre;
          weight[n] += area;
        }
      }
      std::vector<std::vector<Cell>> around(nodes_.size());
      for (Cell t = 0; t < cells_.size(); ++t) {
        if (!cells_[t].alive) continue;
        for (const Node n : cells_[t].node) around[n].push_back(t);
      }
      for (std::size_t n = fixed_; n < nodes_.size(); ++n) {
        const Vec2 before = nodes_[n];
        const double flattest = worst_of(around[n]);
        nodes_[n] = sum[n] / weight[n];
        if (worst_of(around[n]) < flattest) nodes_[n] = before;
      }
      for (Cell t = 0; t < cells_.size(); ++t) {
        if (cells_[t].alive) measure(t);
      }
      make_delaunay();
    }
  }

  Mesh take() {
    Mesh mesh;
    mesh.nodes = std::move(nodes_);
    for (const Facet& f : cells_) {
      if (f.alive) mesh.triangles.push_back(f.node);
    }
    return mesh;
  }

 private:
  /// A triangle to be divided, the worst first.
  struct Bad {
    double badness;
    Cell cell;
    std::array<Node, 3> node;
    bool operator<(const Bad& other) const {
      return badness < other.badness || (badness == other.badness && cell > other.cell);
    }
  };
  /// An edge of the hole that a new node leaves, with the triangle beyond.
  struct HoleEdge {
    Node from, to;
    Cell beyond;
  };

  Vec2 at(const Facet& f, std::size_t k) const { return nodes_[f.node[k % 3]]; }
  double twice_area(const Facet& f) const {
    return cross(at(f, 1) - at(f, 0), at(f, 2) - at(f, 0));
  }
  Vec2 centroid(const Facet& f) const { return (at(f, 0) + at(f, 1) + at(f, 2)) / 3.0; }
  double shortest_square(const Facet& f) const {
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec2 u = at(f, k + 1) - at(f, k);
      least = std::min(least, dot(u, u));
    }
    return least;
  }
  void measure(Cell t) {
    Facet& f = cells_[t];
    f.circle = circle_through(at(f, 0), at(f, 1), at(f, 2));
    f.size = size_(centroid(f));
  }
  /// Area over the squares of the edges, of the worst triangle: 0 where one is turned over.
  double worst_of(const std::vector<Cell>& cells) const {
    double worst = std::numeric_limits<double>::infinity();
    for (const Cell t : cells) {
      const Facet& f = cells_[t];
      double squares = 0.0;
      for (std::size_t k = 0; k < 3; ++k) {
        const Vec2 u = at(f, k + 1) - at(f, k);
        squares += dot(u, u);
      }
      worst = std::min(worst, twice_area(f) / squares);
    }
    return worst;
  }

  void join_neighbours() {
    std::map<std::pair<Node, Node>, std::pair<Cell, std::size_t>> open;
    for (Cell t = 0; t < cells_.size(); ++t) {
      for (std::size_t k = 0; k < 3; ++k) {
        const Node from = cells_[t].node[(k + 1) % 3], to = cells_[t].node[(k + 2) % 3];
        const auto other = open.find({to, from});
        if (other == open.end()) {
          open[{from, to}] = {t, k};
          continue;
        }
        cells_[t].beside[k] = other->second.first;
        cells_[other->second.first].beside[other->second.second] = t;
        open.erase(other);
      }
    }
  }
  std::size_t place_of(Cell neighbour, const Facet& f) const {
    return static_cast<std::size_t>(std::find(f.beside.begin(), f.beside.end(), neighbour) -
                                    f.beside.begin());
  }

  /// Whether the circle of a triangle contains the corner of its neighbour across edge k; a
  /// triangle without area contains any.
  bool is_illegal(const Facet& f, std::size_t k, Vec2 p) const {
    constexpr double rounding = 1e-10;
    const Vec2 arm = p - f.circle.centre;
    return dot(arm, arm) < f.circle.square * (1.0 - rounding) &&
           orientation(at(f, k), at(f, k + 1), p) > 0 && orientation(at(f, k), p, at(f, k + 2)) > 0;
  }
  /// Exchanges edge k of t for the other diagonal.
  void flip(Cell t, std::size_t k) {
    Facet& f = cells_[t];
    const Cell u = f.beside[k];
    Facet& g = cells_[u];
    const std::size_t j = place_of(t, g);
    const Node a = f.node[k], b = f.node[(k + 1) % 3], c = f.node[(k + 2) % 3], d = g.node[j];
    const Cell beyond_ab = f.beside[(k + 2) % 3], beyond_ca = f.beside[(k + 1) % 3];
    const Cell beyond_bd = g.beside[(j + 1) % 3], beyond_dc = g.beside[(j + 2) % 3];
    f.node = {a, b, d};
    f.beside = {beyond_bd, u, beyond_ab};
    g.node = {a, d, c};
    g.beside = {beyond_dc, beyond_ca, t};
    if (beyond_bd != outside) cells_[beyond_bd].beside[place_of(u, cells_[beyond_bd])] = t;
    if (beyond_ca != outside) cells_[beyond_ca].beside[place_of(t, cells_[beyond_ca])] = u;
    measure(t);
    measure(u);
  }
  void make_delaunay() {
    std::vector<Cell> stack;
    for (Cell t = 0; t < cells_.size(); ++t) {
      if (cells_[t].alive) stack.push_back(t);
    }
    while (!stack.empty()) {
      const Cell t = stack.back();
      stack.pop_back();
      for (std::size_t k = 0; k < 3; ++k) {
        const Cell u = cells_[t].beside[k];
        if (u == outside) continue;
        const Node d = cells_[u].node[place_of(t, cells_[u])];
        if (!is_illegal(cells_[t], k, nodes_[d])) continue;
        flip(t, k);
        stack.push_back(u);
        stack.push_back(t);
        break;
      }
    }
  }

  void enqueue(Cell t) {
    // A triangle of equal edges h has the radius h/sqrt(3); one with an angle of 25 degrees 1.18
    // times its shortest edge.
    constexpr double largest = 0.75, flattest = 1.2;
    const Facet& f = cells_[t];
    const double radius = std::sqrt(f.circle.square);
    const double by_size = radius / (largest * f.size),
                 by_shape = radius / (flattest * std::sqrt(shortest_square(f)));
    // Triangles much smaller than asked for are so since corners of the rings are near each other.
    const bool small = radius < 0.5 * largest * f.size;
    const double badness = small ? by_size : std::max(by_size, by_shape);
    if (badness > 1.0) queue_.push({badness, t, f.node});
  }

  /// The triangle that contains p, on the straight way from the centroid of t; or outside.
  Cell find(Cell t, Vec2 p) const {
    for (std::size_t steps = 0; steps < cells_.size(); ++steps) {
      const Facet& f = cells_[t];
      std::size_t across = 3;
      for (std::size_t k = 0; k < 3 && across == 3; ++k) {
        if (orientation(at(f, k + 1), at(f, k + 2), p) < 0) across = k;
      }
      if (across == 3) return t;
      t = f.beside[across];
      if (t == outside) return outside;
    }
    return outside;
  }

  /// Whether p lies in the circle over an edge of the boundary, or nearer to a corner of the hole
  /// than a third of the size.
  bool encroaches(const HoleEdge& e, Vec2 p, double least) const {
    const Vec2 a = nodes_[e.from] - p, b = nodes_[e.to] - p;
    return (e.beyond == outside && dot(a, b) < 0.0) || dot(a, a) < least * least;
  }

  /// Adds a node at p, found from t on; not where it would encroach upon the boundary.
  void insert(Cell t, Vec2 p) {
    const Cell first = find(t, p);
    if (first == outside) return;
    std::vector<Cell> hole{first};
    std::vector<HoleEdge> edges;
    cells_[first].alive = false;
    for (std::size_t q = 0; q < hole.size(); ++q) {
      const Facet f = cells_[hole[q]];
      for (std::size_t k = 0; k < 3; ++k) {
        const Cell u = f.beside[k];
        if (u != outside && !cells_[u].alive) continue;
        if (u != outside && dot(p - cells_[u].circle.centre, p - cells_[u].circle.centre) <
                                cells_[u].circle.square) {
          cells_[u].alive = false;
          hole.push_back(u);
        } else {
          edges.push_back({f.node[(k + 1) % 3], f.node[(k + 2) % 3], u});
        }
      }
    }
    constexpr double third = 1.0 / 3.0;
    const double least = third * size_(p);
    const bool good = std::all_of(edges.begin(), edges.end(), [&](const HoleEdge& e) {
      return !encroaches(e, p, least) && orientation(nodes_[e.from], nodes_[e.to], p) > 0;
    });
    if (!good) {
      for (const Cell u : hole) cells_[u].alive = true;
      return;
    }
    fill(hole, edges, p);
  }

  /// Fills a hole by triangles around the new node.
  void fill(const std::vector<Cell>& hole, const std::vector<HoleEdge>& edges, Vec2 p) {
    const auto node = static_cast<Node>(nodes_.size());
    nodes_.push_back(p);
    std::map<Node, Cell> from, to;
    std::vector<Cell> fresh;
    for (std::size_t q = 0; q < edges.size(); ++q) {
      Cell t = static_cast<Cell>(cells_.size());
      if (q < hole.size()) {
        t = hole[q];
      } else {
        cells_.emplace_back();
      }
      const HoleEdge& e = edges[q];
      cells_[t] = {{node, e.from, e.to}, {e.beyond, outside, outside}, {}};
      if (e.beyond != outside) {
        Facet& g = cells_[e.beyond];
        for (std::size_t k = 0; k < 3; ++k) {
          if (g.node[(k + 1) % 3] == e.to && g.node[(k + 2) % 3] == e.from) g.beside[k] = t;
        }
      }
      from[e.from] = t;
      to[e.to] = t;
      fresh.push_back(t);
    }
    for (const Cell t : fresh) {
      cells_[t].beside[1] = from.at(cells_[t].node[2]);
      cells_[t].beside[2] = to.at(cells_[t].node[1]);
      measure(t);
    }
    for (const Cell t : fresh) enqueue(t);
  }

  const MeshSize& size_;
  std::vector<Vec2> nodes_;
  std::size_t fixed_ = 0;  ///< nodes of the rings
  std::vector<Facet> cells_;
  std::priority_queue<Bad> queue_;
};

}  // namespace

std::vector<Vec2> divisions(Vec2 a, Vec2 b, const MeshSize& size) {
  constexpr std::size_t samples = 32;
  constexpr double rounding = 1e-6;  // of a piece: neighbours differ by what cutting has rounded
  // Sampled from the lower end, so that both sides of a joint are divided alike.
  const bool turned = b.x < a.x || (b.x == a.x && b.y < a.y);
  const Vec2 from = turned ? b : a, along = turned ? a - b : b - a;
  const double length = norm(along);
  std::array<double, samples + 1> sum{};
  const double part_of = 1.0 / static_cast<double>(samples);
  for (std::size_t s = 0; s < samples; ++s) {
    const Vec2 middle = from + (static_cast<double>(s) + 0.5) * part_of * along;
    sum[s + 1] = sum[s] + part_of * length / size(middle);
  }
  const auto pieces = static_cast<int>(std::ceil(sum[samples] - rounding));
  std::vector<Vec2> points;
  for (int piece = 1; piece < pieces; ++piece) {
    const int nth = turned ? pieces - piece : piece;
    const double wanted = sum[samples] * nth / pieces;
    std::size_t s = 0;
    while (sum[s + 1] < wanted) ++s;
    const double part =
        part_of * (static_cast<double>(s) + (wanted - sum[s]) / (sum[s + 1] - sum[s]));
    points.push_back(from + part * along);
  }
  return points;
}

Ring divided(const Ring& ring, const MeshSize& size) {
  Ring out;
  for (std::size_t k = 0; k < ring.size(); ++k) {
    out.push_back(ring[k]);
    for (const Vec2 p : divisions(ring[k], ring[(k + 1) % ring.size()], size)) out.push_back(p);
  }
  return out;
}

Mesh mesh_polygon(std::span<const Ring> rings, const MeshSize& size) {
  Mesher mesher(rings, size);
  mesher.refine();
  mesher.smooth();
  return mesher.take();
}

}  // namespace edda
