#include "cutting/fixed.hpp"

#include <algorithm>
#include <string>
#include <vector>

#include "base/place.hpp"
#include "base/polygon.hpp"
#include "base/rings.hpp"

namespace edda {
namespace {

/// Whether p lies within `margin` of the bounding box of the block's outer ring.
bool in_box(const BlockPolygon& block, Vec2 p, double margin) {
  bool left = false, right = false, below = false, above = false;
  for (Vec2 v : block.rings[0]) {
    left |= v.x <= p.x + margin;
    right |= v.x >= p.x - margin;
    below |= v.y <= p.y + margin;
    above |= v.y >= p.y - margin;
  }
  return left && right && below && above;
}

/// A fixed point and the blocks it lies in or on, ascending.
struct PointInBlocks {
  Vec2 point;  ///< local
  std::size_t row;
  std::vector<std::size_t> inside, on_edge;

  /// The block that contains it, or all blocks on whose edge it lies.
  std::vector<std::size_t> holders() const {
    return inside.empty() ? on_edge : std::vector<std::size_t>{inside.front()};
  }
};

/// All fixed points, in the order of the model. One pass over the blocks; each checks those of the
/// points, sorted by x, that may lie in it.
std::vector<PointInBlocks> find_holders(const Model& model, const PolygonSet& set,
                                        std::size_t first_cut, double snap) {
  std::vector<PointInBlocks> points;
  for (const FixedPoint& fixed : model.fixed) {
    points.push_back({fixed.point - set.origin, points.size(), {}, {}});
  }
  std::sort(points.begin(), points.end(),
            [](const PointInBlocks& a, const PointInBlocks& b) { return a.point.x < b.point.x; });
  for (std::size_t i = first_cut; i < set.blocks.size() && !points.empty(); ++i) {
    const Ring& ring = set.blocks[i].rings[0];
    const auto [low, high] =
        std::minmax_element(ring.begin(), ring.end(), [](Vec2 a, Vec2 b) { return a.x < b.x; });
    auto p = std::lower_bound(points.begin(), points.end(), low->x - 2.0 * snap,
                              [](const PointInBlocks& h, double x) { return h.point.x < x; });
    for (; p != points.end() && p->point.x <= high->x + 2.0 * snap; ++p) {
      if (!in_box(set.blocks[i], p->point, snap)) continue;
      const int side = side_of(set.blocks[i].rings, p->point, snap);
      if (side > 0) p->inside.push_back(i);
      if (side == 0) p->on_edge.push_back(i);
    }
  }
  std::sort(points.begin(), points.end(),
            [](const PointInBlocks& a, const PointInBlocks& b) { return a.row < b.row; });
  return points;
}

std::string list_of(const std::vector<std::size_t>& ids) {
  std::string text;
  for (std::size_t i = 0; i < ids.size(); ++i) {
    if (i > 0) text += i + 1 == ids.size() ? " and " : ", ";
    text += std::to_string(ids[i]);
  }
  return text;
}

std::string opening_name(const Model& model, Index opening) {
  const std::string& name = model.openings[static_cast<std::size_t>(opening)].name;
  return name.empty() ? "opening " + std::to_string(opening) : "opening \"" + name + "\"";
}

Fault in_no_block(const Model& model, const PolygonSet& set, const FixedPoint& fixed, double snap) {
  const Vec2 p = fixed.point - set.origin;
  for (const BlockPolygon& gone : set.removed) {
    if (!in_box(gone, p, snap) || side_of(gone.rings, p, snap) < 0) continue;
    return {member_of(fixed.where, "point"),
            "lies in " + opening_name(model, gone.opening) + ", which is excavated",
            "move it into a block that stays"};
  }
  return {member_of(fixed.where, "point"), "lies in no cut block",
          model.domain ? "move it inside domain.outline"
                       : "give a [domain], or set fixed = true on a [[block]]"};
}

}  // namespace

Faults fix_blocks(const Model& model, double snap, std::size_t first_cut, PolygonSet& set) {
  Faults faults;
  for (const PointInBlocks& point : find_holders(model, set, first_cut, snap)) {
    const FixedPoint& fixed = model.fixed[point.row];
    const auto found = point.holders();
    if (found.size() == 1) {
      set.blocks[found[0]].fixed = true;
    } else if (found.empty()) {
      faults.push_back(in_no_block(model, set, fixed, snap));
    } else {
      faults.push_back({member_of(fixed.where, "point"),
                        "lies on an edge shared by blocks " + list_of(found),
                        "move it into the one that is to be fixed"});
    }
  }
  return faults;
}

/// How a line from a to b meets a block: +1 inside, 0 only on its edge, -1 not at all.
static int meeting(const BlockPolygon& block, Vec2 a, Vec2 b, double snap) {
  const double length = norm(b - a);
  if (length <= snap) return side_of(block.rings, a, snap);
  const Vec2 along = (b - a) / length;
  int best = -1;
  for (const Stretch& part : common(clip_line(block.rings[0], a, along, snap), {{0.0, length}})) {
    if (part.second - part.first <= 4.0 * snap) continue;
    best = std::max(best, side_of(block.rings, a + 0.5 * (part.first + part.second) * along, snap));
  }
  return best;
}

Faults fix_along(const Model& model, const Imports& imports, double snap, std::size_t first_cut,
                 PolygonSet& set) {
  Faults faults;
  for (std::size_t i = 0; i < imports.fixed_lines.size(); ++i) {
    const Vec2 a = imports.fixed_lines[i].first - set.origin,
               b = imports.fixed_lines[i].second - set.origin;
    const double reach = 0.5 * norm(b - a) + snap;
    std::vector<std::size_t> within, touched;
    for (std::size_t k = first_cut; k < set.blocks.size(); ++k) {
      if (!in_box(set.blocks[k], 0.5 * (a + b), reach)) continue;
      const int how = meeting(set.blocks[k], a, b, snap);
      if (how > 0) within.push_back(k);
      if (how == 0) touched.push_back(k);
    }
    if (within.empty() && touched.size() == 1) within = touched;
    for (const std::size_t k : within) set.blocks[k].fixed = true;
    if (!within.empty()) continue;
    const Where where =
        member_of(model.imports[static_cast<std::size_t>(imports.fixed_import[i])].where, "file");
    const std::string which = "fixed line " + std::to_string(i);
    if (touched.empty()) {
      faults.push_back(
          {where, which + " meets no block", "move it into the one that is to be fixed"});
    } else {
      faults.push_back({where, which + " lies on an edge shared by blocks " + list_of(touched),
                        "move it into the one that is to be fixed"});
    }
  }
  return faults;
}

}  // namespace edda
