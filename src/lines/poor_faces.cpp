#include "lines/poor_faces.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "lines/quality.hpp"

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
      : g_(graph), parts_(parts), quality_(quality), groups_(groups) {}

  /// The face that `face` ought to be merged into; -1 if it is good as it is, or has none.
  int target(int face) const {
    const bool sliver = is_poor(face), sharp = !sliver && is_sharp(face);
    if ((!sliver && !sharp) || is_held(face)) return -1;
    const int into = longest_neighbour(face);
    return into >= 0 && (sliver || cures_corners(face, into)) ? into : -1;
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

  /// Whether one side of every sharp corner goes.
  bool cures_corners(int face, int into) const {
    bool cured = true;
    for_each_half_edge(faces(), face, [&](int h) {
      if (corner_after(g_, faces(), h) >= quality_.min_angle) return;
      const int next = faces().cycles.next[at(h)];
      cured = cured && (face_of(faces(), h ^ 1) == into || face_of(faces(), next ^ 1) == into);
    });
    return cured;
  }

  bool is_held(int face) const {
    if (groups_.held.empty()) return false;
    return std::any_of(groups_.held.begin(), groups_.held.end(),
                       [&](Vec2 p) { return holds(face, p); });
  }

  /// Whether p lies in the face or on its boundary: by how often a ray from it crosses.
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

  Index region(int face) const { return region_of(g_, faces(), face, groups_.region_of_half_edge); }

  /// The neighbour with the longest common boundary, of lowest number among equals.
  int longest_neighbour(int face) const {
    std::map<int, double> shared;
    const Index own = region(face);
    for_each_half_edge(faces(), face, [&](int h) {
      const int other = face_of(faces(), h ^ 1);
      if (other == face || parts_.rock[at(other)] != parts_.rock[at(face)]) return;
      shared[other] += norm(along(g_, h));
    });
    int best = -1;
    for (const auto& [other, length] : shared) {
      if ((best >= 0 && length <= shared[best]) || region(other) != own || is_held(other)) continue;
      best = other;
    }
    return best;
  }

  const PlanarGraph& g_;
  const Partition& parts_;
  const Quality& quality_;
  const FaceGroups& groups_;
};

}  // namespace

int merge_poor_faces(PlanarGraph& graph, const Partition& parts, const Quality& quality,
                     const FaceGroups& groups, double& area) {
  const Merger merger(graph, parts, quality, groups);
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
  std::vector<int> partner(parts.zone.size(), -1);
  int merged = 0;
  for (const Poor& p : poor) {
    if (partner[at(p.face)] >= 0 || partner[at(p.into)] >= 0) continue;
    partner[at(p.face)] = p.into;
    partner[at(p.into)] = p.face;
    area += p.area;
    ++merged;
  }
  if (merged == 0) return 0;
  for (std::size_t e = 0; e < graph.edge.size(); ++e) {
    if (!graph.alive[e]) continue;
    const int h = static_cast<int>(2 * e), a = face_of(parts.faces, h),
              b = face_of(parts.faces, h + 1);
    if (a == b || partner[at(a)] == b) graph.alive[e] = 0;
  }
  return merged;
}

}  // namespace edda
