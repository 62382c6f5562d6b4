#include "cutting/short_edges.hpp"

#include <algorithm>
#include <cstddef>
#include <functional>
#include <map>
#include <optional>
#include <queue>
#include <tuple>
#include <utility>

#include "base/polygon.hpp"
#include "cutting/planar_graph.hpp"

namespace edda {
namespace {

enum class Freedom { free, side, corner };

/// The edges of a tiling while they are collapsed. A node that has been merged into another has no
/// polygons.
class Collapse {
 public:
  Collapse(Tiling& tiling, double least, double straight)
      : tiling_(tiling),
        least_(least),
        polygons_(tiling.node.size()),
        freedom_(tiling.node.size()) {
    for (std::size_t f = 0; f < tiling.ring.size(); ++f) {
      for (const int v : tiling.ring[f]) polygons_[at(v)].push_back(static_cast<int>(f));
    }
    for (std::size_t v = 0; v < polygons_.size(); ++v) {
      freedom_[v] = freedom_of(static_cast<int>(v), straight);
    }
  }

  /// What is refused may be possible after others, hence the repetition.
  void run() {
    do {
      while (pass()) {
      }
    } while (join_thin());
    std::erase_if(tiling_.ring, [](const std::vector<int>& ring) { return ring.empty(); });
  }

 private:
  struct Edge {
    double length;
    int a, b;  ///< a < b
    bool operator>(const Edge& o) const {
      return std::tie(length, a, b) > std::tie(o.length, o.a, o.b);
    }
  };
  using Queue = std::priority_queue<Edge, std::vector<Edge>, std::greater<>>;

  Vec2 place(int v) const { return tiling_.node[at(v)]; }

  /// How many polygons have an edge between these nodes.
  int sides(int a, int b) const {
    int count = 0;
    for (const int f : polygons_[at(a)]) {
      const std::vector<int>& ring = tiling_.ring[at(f)];
      for (std::size_t i = 0; i < ring.size(); ++i) {
        const int v = ring[i], w = ring[i + 1 == ring.size() ? 0 : i + 1];
        count += (v == a && w == b) || (v == b && w == a) ? 1 : 0;
      }
    }
    return count;
  }

  Freedom freedom_of(int v, double straight) const {
    std::vector<int> next;
    for (const int f : polygons_[at(v)]) {
      const std::vector<int>& ring = tiling_.ring[at(f)];
      const std::size_t n = ring.size(), i = static_cast<std::size_t>(
                                             std::find(ring.begin(), ring.end(), v) - ring.begin());
      for (const int w : {ring[(i + n - 1) % n], ring[(i + 1) % n]}) {
        if (sides(v, w) == 1) next.push_back(w);
      }
    }
    if (next.empty()) return Freedom::free;
    if (next.size() != 2) return Freedom::corner;
    const Vec2 a = place(next[0]), b = place(next[1]);
    return distance_to_segment(place(v), a, b) > straight ? Freedom::corner : Freedom::side;
  }

  void add(Queue& queue, int v, int w) const {
    const double length = norm(place(w) - place(v));
    if (length < least_) queue.push({length, std::min(v, w), std::max(v, w)});
  }

  /// Where both nodes may come together, the best first.
  std::vector<Vec2> targets(int a, int b, int count) const {
    const Freedom fa = freedom_[at(a)], fb = freedom_[at(b)];
    const Vec2 p = place(a), q = place(b);
    if (fa != Freedom::free && fb != Freedom::free && count == 2) return {};  // across the area
    if (fa == fb && fa == Freedom::corner) return {};
    if (fa == fb) return {0.5 * (p + q), p, q};
    return {fa > fb ? p : q};
  }

  /// The ring of polygon f with a merged into b; nothing where it has no interior left.
  std::optional<std::vector<int>> merged(int f, int a, int b) const {
    std::vector<int> ring = tiling_.ring[at(f)];
    std::replace(ring.begin(), ring.end(), a, b);
    ring.erase(std::unique(ring.begin(), ring.end()), ring.end());
    if (ring.size() > 1 && ring.front() == ring.back()) ring.pop_back();
    if (ring.size() < 3 || std::count(ring.begin(), ring.end(), b) > 1) return std::nullopt;
    return ring;
  }

  Ring points(const std::vector<int>& ring) const {
    Ring all;
    for (const int v : ring) all.push_back(place(v));
    return all;
  }

  bool is_sound(const std::vector<int>& ring, int moved, Vec2 to) const {
    Ring all = points(ring);
    all[static_cast<std::size_t>(std::find(ring.begin(), ring.end(), moved) - ring.begin())] = to;
    return signed_area(all) > 0.0 && !self_crossing(all);
  }

  std::vector<int> around(int a, int b) const {
    std::vector<int> all = polygons_[at(a)];
    all.insert(all.end(), polygons_[at(b)].begin(), polygons_[at(b)].end());
    std::sort(all.begin(), all.end());
    all.erase(std::unique(all.begin(), all.end()), all.end());
    return all;
  }

  /// Merges a into b, where the polygons around allow it.
  bool merge(int a, int b, int count) {
    const std::vector<int> faces = around(a, b);
    std::vector<std::vector<int>> rings;
    for (const int f : faces) {
      auto ring = merged(f, a, b);
      if (!ring) return false;
      rings.push_back(std::move(*ring));
    }
    for (const Vec2 to : targets(a, b, count)) {
      if (!std::all_of(rings.begin(), rings.end(),
                       [&](const auto& ring) { return is_sound(ring, b, to); })) {
        continue;
      }
      for (std::size_t i = 0; i < faces.size(); ++i) {
        tiling_.ring[at(faces[i])] = std::move(rings[i]);
      }
      tiling_.node[at(b)] = to;
      freedom_[at(b)] = std::max(freedom_[at(a)], freedom_[at(b)]);
      polygons_[at(b)] = faces;
      polygons_[at(a)].clear();
      return true;
    }
    return false;
  }

  /// Collapses what can be; whether there was any.
  bool pass() {
    Queue queue;
    for (const std::vector<int>& ring : tiling_.ring) add_edges(queue, ring, std::nullopt);
    bool any = false;
    while (!queue.empty()) {
      const Edge e = queue.top();
      queue.pop();
      const int count = sides(e.a, e.b);
      if (count == 0 || norm(place(e.b) - place(e.a)) != e.length) continue;
      if (!merge(e.a, e.b, count)) continue;
      any = true;
      for (const int f : polygons_[at(e.b)]) add_edges(queue, tiling_.ring[at(f)], e.b);
    }
    return any;
  }

  /// The edges of a ring; of a node, if one is given.
  void add_edges(Queue& queue, const std::vector<int>& ring, std::optional<int> node) const {
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const int v = ring[i], w = ring[i + 1 == ring.size() ? 0 : i + 1];
      if (!node || v == *node || w == *node) add(queue, v, w);
    }
  }

  /// Joins polygons that are thinner than an edge may be short; whether there were any.
  bool join_thin() {
    bool any = false;
    for (std::size_t f = 0; f < tiling_.ring.size(); ++f) {
      if (!tiling_.ring[f].empty() && least_width(points(tiling_.ring[f])) < least_) {
        any = join_beyond_longest(static_cast<int>(f)) || any;
      }
    }
    return any;
  }

  bool join_beyond_longest(int f) {
    const std::vector<int>& ring = tiling_.ring[at(f)];
    std::vector<std::tuple<double, int, int>> edges;
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const int v = ring[i], w = ring[i + 1 == ring.size() ? 0 : i + 1];
      edges.emplace_back(-norm(place(w) - place(v)), v, w);
    }
    std::sort(edges.begin(), edges.end());
    return std::any_of(edges.begin(), edges.end(), [&](const auto& edge) {
      const int g = beyond(f, std::get<1>(edge), std::get<2>(edge));
      return g >= 0 && join(f, g);
    });
  }

  static bool has_edge(const std::vector<int>& ring, int v, int w) {
    const auto i = std::find(ring.begin(), ring.end(), v);
    return i != ring.end() && (i + 1 == ring.end() ? ring.front() : *(i + 1)) == w;
  }

  /// The other polygon at the edge from v to w of polygon f; -1 on the border.
  int beyond(int f, int v, int w) const {
    for (const int g : polygons_[at(v)]) {
      if (g != f && has_edge(tiling_.ring[at(g)], w, v)) return g;
    }
    return -1;
  }

  /// The edges of polygons f and g but those between them, by the node at which each begins;
  /// nothing where they are no single ring.
  std::optional<std::vector<int>> united(int f, int g) const {
    std::map<int, int> next;
    for (const auto& [one, other] : {std::pair{f, g}, std::pair{g, f}}) {
      const std::vector<int>& ring = tiling_.ring[at(one)];
      for (std::size_t i = 0; i < ring.size(); ++i) {
        const int v = ring[i], w = ring[i + 1 == ring.size() ? 0 : i + 1];
        if (has_edge(tiling_.ring[at(other)], w, v)) continue;
        if (!next.emplace(v, w).second) return std::nullopt;
      }
    }
    std::vector<int> ring;
    int v = next.begin()->first;
    do {
      ring.push_back(v);
      v = next.at(v);
    } while (v != ring.front());
    if (ring.size() < next.size()) return std::nullopt;
    return ring;
  }

  /// Joins polygon f to g, where that leaves one ring. Nodes of the border at which nothing ends
  /// any more go.
  bool join(int f, int g) {
    auto ring = united(f, g);
    if (!ring) return false;
    for (const int side : {f, g}) {
      for (const int v : tiling_.ring[at(side)]) std::erase(polygons_[at(v)], side);
    }
    for (const int v : *ring) polygons_[at(v)].push_back(g);
    std::erase_if(*ring, [&](int v) {
      const bool idle = polygons_[at(v)].size() == 1 && freedom_[at(v)] == Freedom::side;
      if (idle) polygons_[at(v)].clear();
      return idle;
    });
    tiling_.ring[at(f)].clear();
    tiling_.ring[at(g)] = std::move(*ring);
    return true;
  }

  Tiling& tiling_;
  double least_;
  std::vector<std::vector<int>> polygons_;  ///< of each node
  std::vector<Freedom> freedom_;
};

}  // namespace

void collapse_short_edges(Tiling& tiling, double least, double straight) {
  Collapse(tiling, least, straight).run();
}

}  // namespace edda
