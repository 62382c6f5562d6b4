#include "contacts/inside.hpp"

#include <limits>

namespace edda {
namespace {

/// Whether the ray from p along x crosses the edge from s to t.
bool crosses(Vec2 p, Vec2 s, Vec2 t) {
  return (s.y > p.y) != (t.y > p.y) && (cross(t - s, p - s) > 0.0) == (t.y > s.y);
}

}  // namespace

double depth_inside(const BlockSet& b, const Pose& pose, Vec2 p, std::size_t j) {
  bool in = false;
  double nearest = std::numeric_limits<double>::infinity();
  for (Id e = b.vertex_begin[j]; e < b.vertex_begin[j + 1]; ++e) {
    const Vec2 s = at(pose.x, pose.y, e), t = at(pose.x, pose.y, b.next[e]);
    const double distance = distance_to_segment(p, s, t);
    if (distance < nearest) nearest = distance;
    if (crosses(p, s, t)) in = !in;
  }
  return in ? nearest : -nearest;
}

bool lies_inside(const BlockSet& b, const Pose& pose, Vec2 p, std::size_t j) {
  bool in = false;
  for (Id e = b.vertex_begin[j]; e < b.vertex_begin[j + 1]; ++e) {
    if (crosses(p, at(pose.x, pose.y, e), at(pose.x, pose.y, b.next[e]))) in = !in;
  }
  return in && depth_inside(b, pose, p, j) > 0.0;
}

}  // namespace edda
