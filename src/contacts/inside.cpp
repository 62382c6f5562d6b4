#include "contacts/inside.hpp"

#include <limits>

namespace edda {
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

}  // namespace edda
