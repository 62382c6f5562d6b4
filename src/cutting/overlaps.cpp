#include "cutting/overlaps.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "base/polygon.hpp"
#include "base/text.hpp"
#include "cutting/geos.hpp"
#include "cutting/line_work.hpp"

namespace edda {
namespace {

using Rings = std::vector<Ring>;

struct Box {
  Vec2 low, high;
};

Box box_of(const Rings& rings) {
  Box box{rings[0][0], rings[0][0]};
  for (Vec2 p : rings[0]) {
    box.low = {std::min(box.low.x, p.x), std::min(box.low.y, p.y)};
    box.high = {std::max(box.high.x, p.x), std::max(box.high.y, p.y)};
  }
  return box;
}

/// The smaller side of the intersection of two boxes, an upper bound of the depth; negative where
/// they are apart.
double shared_width(const Box& a, const Box& b) {
  return std::min(std::min(a.high.x, b.high.x) - std::max(a.low.x, b.low.x),
                  std::min(a.high.y, b.high.y) - std::max(a.low.y, b.low.y));
}

template <class Visit>
void for_each_edge(const Rings& rings, Visit visit) {
  for (const Ring& ring : rings) {
    for (std::size_t i = 0; i < ring.size(); ++i) {
      visit(ring[i], ring[i + 1 == ring.size() ? 0 : i + 1]);
    }
  }
}

double distance_to_boundary(const Rings& rings, Vec2 p) {
  double nearest = std::numeric_limits<double>::infinity();
  for_each_edge(rings,
                [&](Vec2 a, Vec2 b) { nearest = std::min(nearest, distance_to_segment(p, a, b)); });
  return nearest;
}

/// Distance from p to the boundary if p is inside, else 0.
double depth_inside(const Rings& rings, Vec2 p) {
  return side_of(rings, p, 0.0) > 0 ? distance_to_boundary(rings, p) : 0.0;
}

/// The values of t at which the segment a + t (b - a) meets edges of the polygon, with 0 and 1, in
/// order.
std::vector<double> meetings(const Rings& rings, Vec2 a, Vec2 b) {
  std::vector<double> meets = {0.0, 1.0};
  for_each_edge(rings, [&](Vec2 c, Vec2 d) {
    const double sc = cross(b - a, c - a), sd = cross(b - a, d - a);
    if ((sc > 0.0 && sd > 0.0) || (sc < 0.0 && sd < 0.0) || sc == sd) return;
    const Vec2 at = c + (sc / (sc - sd)) * (d - c);
    const double t = dot(at - a, b - a) / dot(b - a, b - a);
    if (t > 0.0 && t < 1.0) meets.push_back(t);
  });
  std::sort(meets.begin(), meets.end());
  return meets;
}

/// Depth to which the boundary of `rings` runs inside `other`.
double boundary_depth(const Rings& rings, const Rings& other, const Box& reach) {
  double depth = 0.0;
  for_each_edge(rings, [&](Vec2 a, Vec2 b) {
    const Box edge{{std::min(a.x, b.x), std::min(a.y, b.y)},
                   {std::max(a.x, b.x), std::max(a.y, b.y)}};
    if (a == b || shared_width(edge, reach) < 0.0) return;
    depth = std::max(depth, depth_inside(other, a));
    const std::vector<double> t = meetings(other, a, b);
    for (std::size_t i = 0; i + 1 < t.size(); ++i) {
      for (double part : {0.25, 0.5, 0.75}) {
        const Vec2 p = a + (t[i] + part * (t[i + 1] - t[i])) * (b - a);
        depth = std::max(depth, depth_inside(other, p));
      }
    }
  });
  return depth;
}

/// A point well inside: the middle of the widest interval along a few horizontal lines.
Vec2 point_inside(const Rings& rings, const Box& box) {
  Vec2 best = box.low;
  double clearance = -1.0;
  for (double part : {0.5, 0.37, 0.63, 0.11, 0.89}) {
    const double y = box.low.y + part * (box.high.y - box.low.y);
    std::vector<double> xs;
    for_each_edge(rings, [&](Vec2 a, Vec2 b) {
      if ((a.y > y) != (b.y > y)) xs.push_back(a.x + (y - a.y) / (b.y - a.y) * (b.x - a.x));
    });
    std::sort(xs.begin(), xs.end());
    for (std::size_t i = 0; i + 1 < xs.size(); i += 2) {
      const Vec2 p{0.5 * (xs[i] + xs[i + 1]), y};
      const double d = depth_inside(rings, p);
      if (d > clearance) best = p, clearance = d;
    }
  }
  return best;
}

double shared_circle(const Rings& rings, const Rings& other, const Box& box) {
  const Vec2 p = point_inside(rings, box);
  return 2.0 * std::min(depth_inside(rings, p), depth_inside(other, p));
}

std::string name_of(const BlockPolygon& block, std::size_t id) {
  return block.name.empty() ? "block " + std::to_string(id) : "block \"" + block.name + "\"";
}

/// The fault is at the later of the two that is a [[block]]: a cut block has only the domain's
/// place.
Fault overlap_fault(std::span<const BlockPolygon> blocks, std::size_t first_cut, std::size_t i,
                    std::size_t j, double depth, double allowed) {
  const std::size_t placed = j < first_cut ? j : i;
  const std::size_t other = placed == j ? i : j;
  int digits = 4;  // as many as tell the two from each other
  while (number_text(depth, digits) == number_text(allowed, digits) && digits < 17) ++digits;
  return {blocks[placed].where,
          name_of(blocks[placed], placed) + " overlaps " + (other >= first_cut ? "cut " : "") +
              name_of(blocks[other], other) + " by " + number_text(depth, digits) +
              " m, more than " + number_text(allowed, digits) + " m",
          "move them apart, or fix both"};
}

std::vector<Box> boxes_of(std::span<const BlockPolygon> blocks) {
  std::vector<Box> boxes;
  boxes.reserve(blocks.size());
  for (const BlockPolygon& block : blocks) boxes.push_back(box_of(block.rings));
  return boxes;
}

/// Calls visit(i, j), i a block given as it is, for all pairs of meeting boxes, each once, in
/// order.
template <class Visit>
void for_each_near_pair(const std::vector<Box>& boxes, std::size_t first_cut, Visit visit) {
  geos::index::strtree::TemplateSTRtree<std::size_t> tree(10, boxes.size());
  const auto envelope = [&](std::size_t i) {
    return geos::geom::Envelope(boxes[i].low.x, boxes[i].high.x, boxes[i].low.y, boxes[i].high.y);
  };
  for (std::size_t i = 0; i < boxes.size(); ++i) tree.insert(envelope(i), i);
  std::vector<std::size_t> near;
  for (std::size_t i = 0; i < first_cut; ++i) {
    near.clear();
    tree.query(envelope(i), near);
    std::sort(near.begin(), near.end());
    for (std::size_t j : near) {
      if (j > i) visit(i, j);
    }
  }
}

}  // namespace

double overlap_depth(const BlockPolygon& a, const BlockPolygon& b) {
  const Box box_a = box_of(a.rings), box_b = box_of(b.rings);
  if (shared_width(box_a, box_b) <= 0.0) return 0.0;
  return std::max({boundary_depth(a.rings, b.rings, box_b), boundary_depth(b.rings, a.rings, box_a),
                   shared_circle(a.rings, b.rings, box_a), shared_circle(b.rings, a.rings, box_b)});
}

double overlap_by_rounding(const Model& model, const Imports& imports) {
  std::vector<Ring> rings;
  Box box{{1e300, 1e300}, {-1e300, -1e300}};
  const auto look = [&](const Ring& ring) {
    for (const Vec2 p : ring) {
      box.low = {std::min(box.low.x, p.x), std::min(box.low.y, p.y)};
      box.high = {std::max(box.high.x, p.x), std::max(box.high.y, p.y)};
    }
  };
  for (const BlockInput& block : model.blocks) rings.push_back(block.polygon);
  std::for_each(rings.begin(), rings.end(), look);
  double unit = last_digit(rings);
  for (const ImportedBlock& block : imports.blocks) {
    look(block.ring);
    unit = std::max(unit, imports.last_digit[static_cast<std::size_t>(block.import)]);
  }
  // Each of two corners is moved by half a unit at most in both directions.
  return 1.5 * rounding(unit, std::max(box.high.x - box.low.x, box.high.y - box.low.y));
}

double allowed_overlap(const BlockPolygon& a, const BlockPolygon& b, double rounding) {
  const double size = std::sqrt(std::min(moments(a.rings).area, moments(b.rings).area));
  return std::max(1e-3 * size, std::min(rounding, 1e-2 * size));
}

Faults find_overlaps(std::span<const BlockPolygon> blocks, std::size_t first_cut, double rounding) {
  Faults faults;
  if (first_cut == 0) return faults;
  const std::vector<Box> boxes = boxes_of(blocks);
  constexpr std::size_t listed = 10;
  std::size_t more = 0;
  for_each_near_pair(boxes, first_cut, [&](std::size_t i, std::size_t j) {
    if (blocks[i].fixed && blocks[j].fixed) return;
    const double allowed = allowed_overlap(blocks[i], blocks[j], rounding);
    if (shared_width(boxes[i], boxes[j]) <= allowed) return;
    const double depth = overlap_depth(blocks[i], blocks[j]);
    if (depth <= allowed) return;
    if (faults.size() < listed) {
      faults.push_back(overlap_fault(blocks, first_cut, i, j, depth, allowed));
    } else {
      ++more;
    }
  });
  if (more > 0) faults.back().problem += "; so do " + std::to_string(more) + " more pairs";
  return faults;
}

}  // namespace edda
