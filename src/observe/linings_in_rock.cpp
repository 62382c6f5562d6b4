#include "observe/linings_in_rock.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "model/stage_names.hpp"

namespace edda {
namespace {

/// Whether block j is there, as drawn, when a lining comes at the start of this stage.
bool is_there(const Scene& scene, Id j, std::size_t stage) {
  const Model& model = scene.model;
  const BlockSet& b = scene.blocks;
  if (b.is_fill(j)) return false;
  if (b.is_lining(j)) {
    const Lining& other = model.linings[static_cast<std::size_t>(b.lining[j])];
    return installed_in(model, other.name).value_or(0) <= stage;
  }
  if (b.opening.empty() || b.opening[j] == none) return true;
  const auto opening = static_cast<std::size_t>(b.opening[j]);
  return excavated_in(model, model.openings[opening].name).value_or(0) > stage;
}

/// How deep a point lies inside a block as drawn, m; 0 outside.
double depth_in(const BlockSet& b, Id j, Vec2 p) {
  double depth = std::numeric_limits<double>::max();
  bool inside = false;
  for (Id v = b.vertex_begin[j]; v < b.vertex_begin[j + 1]; ++v) {
    const Vec2 from = b.vertex(v), to = b.vertex(b.next[v]), along = to - from;
    depth = std::min(depth, distance_to_segment(p, from, to));
    if ((from.y > p.y) != (to.y > p.y) && (cross(along, p - from) > 0.0) == (to.y > from.y))
      inside = !inside;
  }
  return inside ? depth : 0.0;
}

struct Deepest {
  double depth = 0.0;
  Id block = no_id;
  Vec2 at;
};

Deepest deepest_corner(const Scene& scene, Id i) {
  const BlockSet& b = scene.blocks;
  const Model& model = scene.model;
  const Lining& lining = model.linings[static_cast<std::size_t>(b.lining[i])];
  const std::size_t stage = installed_in(model, lining.name).value_or(0);
  Deepest deepest;
  for (Id j = 0; j < b.size(); ++j) {
    if (j == i || !is_there(scene, j, stage)) continue;
    for (Id v = b.vertex_begin[i]; v < b.vertex_begin[i + 1]; ++v) {
      const Vec2 p = b.vertex(v);
      if (norm(p - Vec2{b.centroid_x[j], b.centroid_y[j]}) > b.radius[j]) continue;
      const double depth = depth_in(b, j, p);
      if (depth > deepest.depth) deepest = {depth, j, p};
    }
  }
  return deepest;
}

}  // namespace

std::vector<std::string> linings_in_rock(const Simulation& sim) {
  constexpr double rounding = 1e-3;  // of the thickness
  const Scene& scene = *sim.scene;
  const BlockSet& b = scene.blocks;
  std::vector<std::string> warnings;
  for (Id i = 0; i < b.size(); ++i) {
    if (!b.is_lining(i)) continue;
    const Lining& lining = scene.model.linings[static_cast<std::size_t>(b.lining[i])];
    const Deepest d = deepest_corner(scene, i);
    if (d.depth <= rounding * lining.drawn_thickness()) continue;
    const bool other = b.is_lining(d.block);
    const Vec2 at = d.at + b.origin;
    warnings.push_back(fmt::format(
        "{} is drawn {:.2g} m into {} at ({:.6g}, {:.6g}), which is there when it comes, and will "
        "be pressed there: {}",
        lining.where.key, d.depth,
        other ? scene.model.linings[static_cast<std::size_t>(b.lining[d.block])].where.key
              : fmt::format("block {}", d.block),
        at.x, at.y,
        other ? "let one begin in the point of the wall where the other ends"
              : "let it end there with a straight piece at right angles to that face"));
  }
  return warnings;
}

}  // namespace edda
