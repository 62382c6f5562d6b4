#include "cutting/short_edges.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <functional>
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
    } while (join_triangles());
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

  bool is_sound(const std::vector<int>& ring, int moved, Vec2 to) const {
    Ring points;
    for (const int v : ring) points.push_back(v == moved ? to : place(v));
    return signed_area(points) > 0.0 && !self_crossing(points);
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

  /// Joins triangles with edges that are short still to the polygon beyond their longest edge;
  /// whether there were any.
  bool join_triangles() {
    bool any = false;
    for (std::size_t f = 0; f < tiling_.ring.size(); ++f) any = join_triangle(f) || any;
    return any;
  }

  bool join_triangle(std::size_t f) {
    std::vector<int> ring = tiling_.ring[f];
    if (ring.size() != 3) return false;
    const auto length = [&](std::size_t i) {
      return norm(place(ring[(i + 1) % 3]) - place(ring[i]));
    };
    if (!(std::min({length(0), length(1), length(2)}) < least_)) return false;
    std::array<std::size_t, 3> order{0, 1, 2};
    std::sort(order.begin(), order.end(),
              [&](std::size_t i, std::size_t j) { return length(i) > length(j); });
    return std::any_of(order.begin(), order.end(), [&](std::size_t i) {
      std::rotate_copy(tiling_.ring[f].begin(), tiling_.ring[f].begin() + static_cast<int>(i),
                       tiling_.ring[f].end(), ring.begin());
      return join(static_cast<int>(f), ring[0], ring[1], ring[2]);
    });
  }

  /// Joins triangle f = (v, w, u) to the polygon beyond its edge from v to w, unless that has u.
  bool join(int f, int v, int w, int u) {
    for (const int g : polygons_[at(v)]) {
      std::vector<int>& ring = tiling_.ring[at(g)];
      const auto from = std::find(ring.begin(), ring.end(), w);
      if (g == f || from == ring.end() || std::count(ring.begin(), ring.end(), u) > 0) continue;
      ring.insert(from + 1, u);
      tiling_.ring[at(f)].clear();
      for (const int node : {v, w, u}) std::erase(polygons_[at(node)], f);
      polygons_[at(u)].push_back(g);
      for (const int node : {v, w}) {  // of the border, with nothing else that ends there
        if (polygons_[at(node)].size() > 1 || freedom_[at(node)] != Freedom::side) continue;
        std::erase(ring, node);
        polygons_[at(node)].clear();
      }
      return true;
    }
    return false;
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
