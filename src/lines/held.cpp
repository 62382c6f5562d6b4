#include "lines/held.hpp"

#include <algorithm>
#include <string>
#include <vector>

#include "base/polygon.hpp"
#include "lines/place.hpp"
#include "lines/rings.hpp"

namespace edda {
namespace {

/// Whether p lies within `margin` of the box round the block's outer ring.
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

/// A held point and the blocks it lies in or on, ascending.
struct Held {
  Vec2 point;  ///< local
  std::size_t row;
  std::vector<std::size_t> inside, on_edge;

  /// The block that holds it, or all those on whose edge it lies.
  std::vector<std::size_t> holders() const {
    return inside.empty() ? on_edge : std::vector<std::size_t>{inside.front()};
  }
};

/// All held points, in the order of the model. One pass over the blocks, each asking those of the
/// points, sorted by x, that may lie in it.
std::vector<Held> find_holders(const Model& model, const PolygonSet& set, std::size_t first_cut,
                               double snap) {
  std::vector<Held> points;
  for (const HeldPoint& held : model.held) {
    points.push_back({held.point - set.origin, points.size(), {}, {}});
  }
  std::sort(points.begin(), points.end(),
            [](const Held& a, const Held& b) { return a.point.x < b.point.x; });
  for (std::size_t i = first_cut; i < set.blocks.size() && !points.empty(); ++i) {
    const Ring& ring = set.blocks[i].rings[0];
    const auto [low, high] =
        std::minmax_element(ring.begin(), ring.end(), [](Vec2 a, Vec2 b) { return a.x < b.x; });
    auto p = std::lower_bound(points.begin(), points.end(), low->x - 2.0 * snap,
                              [](const Held& h, double x) { return h.point.x < x; });
    for (; p != points.end() && p->point.x <= high->x + 2.0 * snap; ++p) {
      if (!in_box(set.blocks[i], p->point, snap)) continue;
      const int side = side_of(set.blocks[i].rings, p->point, snap);
      if (side > 0) p->inside.push_back(i);
      if (side == 0) p->on_edge.push_back(i);
    }
  }
  std::sort(points.begin(), points.end(),
            [](const Held& a, const Held& b) { return a.row < b.row; });
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

Fault in_no_block(const Model& model, const PolygonSet& set, const HeldPoint& held, double snap) {
  const Vec2 p = held.point - set.origin;
  for (const BlockPolygon& gone : set.removed) {
    if (!in_box(gone, p, snap) || side_of(gone.rings, p, snap) < 0) continue;
    return {member_of(held.where, "point"),
            "lies in " + opening_name(model, gone.opening) + ", which is taken out",
            "move it into a block that stays"};
  }
  return {member_of(held.where, "point"), "lies in no cut block",
          model.domain ? "move it inside domain.outline"
                       : "give a [domain], or set fixed = true on a [[block]]"};
}

}  // namespace

Faults hold_blocks(const Model& model, double snap, std::size_t first_cut, PolygonSet& set) {
  Faults faults;
  for (const Held& point : find_holders(model, set, first_cut, snap)) {
    const HeldPoint& held = model.held[point.row];
    const auto found = point.holders();
    if (found.size() == 1) {
      set.blocks[found[0]].fixed = true;
    } else if (found.empty()) {
      faults.push_back(in_no_block(model, set, held, snap));
    } else {
      faults.push_back({member_of(held.where, "point"),
                        "lies on an edge shared by blocks " + list_of(found),
                        "move it into the one that is to be held"});
    }
  }
  return faults;
}

/// How a block meets a line from a to b: +1 within, 0 on its edge alone, -1 not at all.
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

Faults hold_along(const Model& model, const Imports& imports, double snap, std::size_t first_cut,
                  PolygonSet& set) {
  Faults faults;
  for (std::size_t i = 0; i < imports.held_lines.size(); ++i) {
    const Vec2 a = imports.held_lines[i].first - set.origin,
               b = imports.held_lines[i].second - set.origin;
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
        member_of(model.imports[static_cast<std::size_t>(imports.held_import[i])].where, "file");
    const std::string which = "fixed line " + std::to_string(i);
    if (touched.empty()) {
      faults.push_back(
          {where, which + " meets no block", "move it into the one that is to be held"});
    } else {
      faults.push_back({where, which + " lies on an edge shared by blocks " + list_of(touched),
                        "move it into the one that is to be held"});
    }
  }
  return faults;
}

}  // namespace edda
