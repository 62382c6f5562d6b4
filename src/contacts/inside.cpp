#include "contacts/inside.hpp"

#include <algorithm>
#include <limits>

#include "contacts/gap.hpp"

namespace edda {
namespace {

/// Whether p lies on a side of block j (within `tolerance`, m) that makes a wedge of less than 60
/// degrees with an edge of tangent t.
bool on_far_side(const BlockSet& b, const Pose& pose, Vec2 p, Id j, Vec2 t, double tolerance) {
  constexpr double sharp = -0.5;
  for (Id f = b.vertex_begin[j]; f < b.vertex_begin[j + 1]; ++f) {
    const Vec2 from = at(pose.x, pose.y, f), to = at(pose.x, pose.y, b.next[f]);
    if (distance_to_segment(p, from, to) <= tolerance && dot(unit(to - from), t) < sharp)
      return true;
  }
  return false;
}

}  // namespace

Inside inside_of(const BlockSet& b, const Pose& pose, Vec2 p, std::size_t j) {
  bool in = false;
  Inside found{std::numeric_limits<double>::infinity(), no_id};
  for (Id e = b.vertex_begin[j]; e < b.vertex_begin[j + 1]; ++e) {
    const Vec2 s = at(pose.x, pose.y, e), t = at(pose.x, pose.y, b.next[e]);
    const double distance = distance_to_segment(p, s, t);
    if (distance < found.depth) found = {distance, e};
    if ((s.y > p.y) == (t.y > p.y)) continue;
    if ((cross(t - s, p - s) > 0.0) == (t.y > s.y)) in = !in;
  }
  if (!in) found.depth = -found.depth;
  return found;
}

bool lies_outside(const ContactSet& c, const BlockSet& b, const Pose& pose, std::size_t k,
                  double tolerance) {
  const double depth = c.depth[k];
  if (depth <= tolerance) return false;
  const double past = c.foot[k] - std::clamp(c.foot[k], 0.0, c.span[k]);
  const Vec2 t = c.tangent(k), p = at(pose.x, pose.y, c.vertex[k]) - past * t;
  const Inside in = inside_of(b, pose, p, c.block_j[k]);
  if (past != 0.0) return in.depth < -0.5 * depth;
  if (in.depth < -tolerance) return true;
  if (in.depth <= tolerance) return on_far_side(b, pose, p, c.block_j[k], t, tolerance);
  const Id e = c.edge[k], f = in.edge;
  if (in.depth >= depth - tolerance || b.next[e] == f || b.next[f] == e) return false;
  return dot(at(pose.x, pose.y, b.next[f]) - at(pose.x, pose.y, f), t) < 0.0;
}

}  // namespace edda
