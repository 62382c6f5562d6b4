#include "cutting/poor_faces.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "base/polygon.hpp"
#include "cutting/quality.hpp"

namespace edda {
namespace {

Vec2 along(const PlanarGraph& g, int h) {
  return g.node[at(target_of(g, h))] - g.node[at(origin_of(g, h))];
}

double perimeter_of(const PlanarGraph& g, const Faces& faces, int face) {
  double sum = 0.0;
  for_each_half_edge(faces, face, [&](int h) { sum += norm(along(g, h)); });
  return sum;
}

/// Angle inside the face between half-edge h and the next one, degrees.
double corner_after(const PlanarGraph& g, const Faces& faces, int h) {
  const Vec2 in = along(g, h), out = along(g, faces.cycles.next[at(h)]);
  return 180.0 - std::atan2(cross(in, out), dot(in, out)) * 180.0 / std::numbers::pi;
}

class Merger {
 public:
  Merger(const PlanarGraph& graph, const Partition& parts, const Quality& quality,
         const FaceGroups& groups)
      : g_(graph),
        parts_(parts),
        quality_(quality),
        groups_(groups),
        fixed_(parts.zone.size(), unknown),
        region_(parts.zone.size(), unknown) {}

  /// The face that `face` should be merged into; -1 if it need not be merged, or has no such
  /// neighbour.
  int target(int face) {
    const bool sliver = is_poor(face), sharp = !sliver && is_sharp(face);
    if ((!sliver && !sharp) || is_fixed(face)) return -1;
    return best_neighbour(face, sliver);
  }

 private:
  const Faces& faces() const { return parts_.faces; }

  bool is_poor(int face) const {
    std::vector<Vec2> ring;
    const int start = faces().cycles.start[at(faces().outer[at(face)])];
    int h = start;
    do {
      ring.push_back(g_.node[at(origin_of(g_, h))]);
      h = faces().cycles.next[at(h)];
    } while (h != start);
    return is_sliver(face_area(g_, faces(), face), perimeter_of(g_, faces(), face), ring, quality_);
  }

  bool is_sharp(int face) const {
    bool sharp = false;
    for_each_half_edge(faces(), face, [&](int h) {
      sharp = sharp || corner_after(g_, faces(), h) < quality_.min_angle;
    });
    return sharp;
  }

  /// Whether one side of every sharp corner is removed.
  bool cures_corners(int face, int into) const {
    bool cured = true;
    for_each_half_edge(faces(), face, [&](int h) {
      if (corner_after(g_, faces(), h) >= quality_.min_angle) return;
      const int next = faces().cycles.next[at(h)];
      cured = cured && (face_of(faces(), h ^ 1) == into || face_of(faces(), next ^ 1) == into);
    });
    return cured;
  }

  // Found once, since every sliver beside a long face needs it.
  bool is_fixed(int face) {
    if (groups_.fixed.empty()) return false;
    int& fixed = fixed_[at(face)];
    if (fixed == unknown) {
      fixed = std::any_of(groups_.fixed.begin(), groups_.fixed.end(),
                          [&](Vec2 p) { return holds(face, p); });
    }
    return fixed != 0;
  }

  /// Whether p lies in the face or on its boundary: by the number of crossings of a ray.
  bool holds(int face, Vec2 p) const {
    bool inside = false, on_edge = false;
    for_each_half_edge(faces(), face, [&](int h) {
      const Vec2 a = g_.node[at(origin_of(g_, h))], b = g_.node[at(target_of(g_, h))];
      on_edge = on_edge || distance_to_segment(p, a, b) <= groups_.snap;
      if ((a.y > p.y) != (b.y > p.y) && p.x < a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x)) {
        inside = !inside;
      }
    });
    return inside || on_edge;
  }

  Index region(int face) {
    int& region = region_[at(face)];
    if (region == unknown) region = region_of(g_, faces(), face, groups_.region_of_half_edge);
    return region;
  }

  /// The neighbour with the shortest common boundary that may be removed, the one of lowest number
  /// among equals. `any`: whether sharp corners may stay.
  int best_neighbour(int face, bool any) {
    std::map<int, double> shared;
    const Index own = region(face);
    for_each_half_edge(faces(), face, [&](int h) {
      const int other = face_of(faces(), h ^ 1);
      if (other != face && rock(other) == rock(face)) shared[other] += norm(along(g_, h));
    });
    int best = -1;
    for (const auto& [other, length] : shared) {
      if (best >= 0 && length >= shared[best]) continue;
      if (region(other) != own || is_fixed(other) || parts_a_joint(face, other)) continue;
      if (any || cures_corners(face, other)) best = other;
    }
    return best;
  }

  int rock(int face) const { return parts_.rock[at(face)]; }

  /// Whether merging the two would interrupt a continuous joint.
  bool parts_a_joint(int face, int into) const {
    bool harm = false;
    for_each_half_edge(faces(), face, [&](int h) {
      // Borders of Voronoi cells are not joint planes: each ends where three cells meet, also at
      // the surface.
      if (harm || face_of(faces(), h ^ 1) != into || kind_of(h) == LineKind::voronoi) return;
      harm = at_surface(h) || at_surface(h ^ 1) || (goes_on(h) && goes_on(h ^ 1));
    });
    return harm;
  }

  /// Calls visit(k) for every half-edge that leaves the target of h, except h's twin.
  template <class Visit>
  void for_each_beyond(int h, Visit visit) const {
    for (int k = faces().cycles.next[at(h)]; k != (h ^ 1); k = faces().cycles.next[at(k ^ 1)]) {
      visit(k);
    }
  }

  /// Whether h ends at the surface of the rock.
  bool at_surface(int h) const {
    const int own = rock(face_of(faces(), h));
    bool ends = false;
    for_each_beyond(h, [&](int k) {
      ends = ends || rock(face_of(faces(), k)) != own || rock(face_of(faces(), k ^ 1)) != own;
    });
    return ends;
  }

  /// Whether the joint of h continues beyond its target, also past further boundaries between the
  /// same two faces.
  bool goes_on(int h) const {
    const int face = face_of(faces(), h), into = face_of(faces(), h ^ 1);
    for (;;) {
      int next = -1;
      for_each_beyond(h, [&](int k) {
        if (straight_on(h, k) && (next < 0 || turn(h, k) < turn(h, next))) next = k;
      });
      if (next < 0) return false;
      if (face_of(faces(), next) != face || face_of(faces(), next ^ 1) != into) return true;
      h = next;
    }
  }

  LineKind kind_of(int h) const { return groups_.sources[at(g_.edge[at(h / 2)].source)].kind; }

  double turn(int h, int k) const {
    const Vec2 u = along(g_, h), v = along(g_, k);
    return std::abs(std::atan2(cross(u, v), dot(u, v)));
  }

  /// Whether k, which leaves where h ends, continues in its direction: within 3 degrees or the
  /// rounding of the line work; as one polyline, within 30.
  bool straight_on(int h, int k) const {
    constexpr double straight = 0.05, bend = 0.5;
    const Vec2 u = along(g_, h), v = along(g_, k);
    if (!(dot(u, v) > 0.0)) return false;
    const Index source = g_.edge[at(h / 2)].source;
    const LineKind kind = kind_of(h);
    const bool polyline = (kind == LineKind::trace || kind == LineKind::import) &&
                          g_.edge[at(k / 2)].source == source;
    return turn(h, k) <= (polyline ? bend : straight) ||
           std::abs(cross(u, v)) <= 4.0 * groups_.snap * std::max(norm(u), norm(v));
  }

  const PlanarGraph& g_;
  const Partition& parts_;
  const Quality& quality_;
  const FaceGroups& groups_;
  static constexpr int unknown = -2;
  std::vector<int> fixed_, region_;
};

}  // namespace

namespace {

FaceMerge merge_of(const PlanarGraph& graph, const Faces& faces, int face, int into) {
  Ring ring;
  FaceMerge merge;
  std::map<Index, double> lost;
  for_each_half_edge(faces, face, [&](int h) {
    if (face_of(faces, h ^ 1) != into) return;
    const double length = norm(along(graph, h));
    merge.lost += length;
    lost[graph.edge[at(h / 2)].source] += length;
  });
  const int start = faces.cycles.start[at(faces.outer[at(face)])];
  int h = start;
  do {
    ring.push_back(graph.node[at(origin_of(graph, h))]);
    h = faces.cycles.next[at(h)];
  } while (h != start);
  const Moments m = moments({&ring, 1});
  merge.at = m.centroid;
  merge.area = face_area(graph, faces, face);
  merge.source = std::max_element(lost.begin(), lost.end(), [](const auto& a, const auto& b) {
                   return a.second < b.second;
                 })->first;
  return merge;
}

}  // namespace

int merge_poor_faces(PlanarGraph& graph, const Partition& parts, const Quality& quality,
                     const FaceGroups& groups, std::vector<FaceMerge>& merges) {
  Merger merger(graph, parts, quality, groups);
  struct Poor {
    double area;
    int face, into;
  };
  std::vector<Poor> poor;
  for (int f = 1; f < static_cast<int>(parts.zone.size()); ++f) {
    if (parts.rock[at(f)] < 0) continue;
    const int into = merger.target(f);
    if (into >= 0) poor.push_back({face_area(graph, parts.faces, f), f, into});
  }
  std::stable_sort(poor.begin(), poor.end(),
                   [](const Poor& a, const Poor& b) { return a.area < b.area; });
  // Two poor faces may only merge with each other. A good face takes any number of poor ones, since
  // otherwise faces would have to be found again for each sliver beside a long one; but of two
  // neighbouring poor faces it takes one.
  const std::size_t n = parts.zone.size();
  std::vector<std::uint8_t> is_poor(n, 0), taken(n, 0);
  for (const Poor& p : poor) is_poor[at(p.face)] = 1;
  std::vector<int> joins(n, -1);
  int merged = 0;
  for (const Poor& p : poor) {
    bool wait = taken[at(p.face)] || taken[at(p.into)];
    for_each_half_edge(parts.faces, p.face, [&](int h) {
      wait = wait || joins[at(face_of(parts.faces, h ^ 1))] == p.into;
    });
    if (wait) continue;
    joins[at(p.face)] = p.into;
    taken[at(p.face)] = 1;
    taken[at(p.into)] = is_poor[at(p.into)];
    merges.push_back(merge_of(graph, parts.faces, p.face, p.into));
    ++merged;
  }
  if (merged == 0) return 0;
  for (std::size_t e = 0; e < graph.edge.size(); ++e) {
    if (!graph.alive[e]) continue;
    const int h = static_cast<int>(2 * e), a = face_of(parts.faces, h),
              b = face_of(parts.faces, h + 1);
    if (a == b || joins[at(a)] == b || joins[at(b)] == a) graph.alive[e] = 0;
  }
  return merged;
}

}  // namespace edda
