// Penetration of blocks in one another, by geometry alone.
#pragma once

#include <algorithm>
#include <limits>
#include <vector>

#include "blocks/pose.hpp"

namespace edda {

struct Overlap {
  double depth = 0.0;  ///< m
  Id block = no_id, other = no_id;
};

/// Largest penetration of any two blocks of one ring each. Two convex blocks: the least translation
/// that separates them (over the normals of both). Otherwise: the depth of a vertex of one inside
/// the other.
inline Overlap deepest_overlap(const BlockSet& b, const Pose& pose) {
  struct Box {
    double x0 = 1e300, y0 = 1e300, x1 = -1e300, y1 = -1e300;
    bool convex = true;
  };
  const std::size_t n = b.size();
  std::vector<Box> box(n);
  for (std::size_t i = 0; i < n; ++i) {
    for (Id v = b.vertex_begin[i]; v < b.vertex_begin[i + 1]; ++v) {
      const Vec2 p = at(pose.x, pose.y, v);
      box[i].x0 = std::min(box[i].x0, p.x);
      box[i].y0 = std::min(box[i].y0, p.y);
      box[i].x1 = std::max(box[i].x1, p.x);
      box[i].y1 = std::max(box[i].y1, p.y);
      const Vec2 q = at(pose.x, pose.y, b.previous[v]), r = at(pose.x, pose.y, b.next[v]);
      box[i].convex = box[i].convex && cross(p - q, r - p) >= 0.0;
    }
  }
  // Penetration along the outward normals of the edges of block i: the least.
  auto along_normals = [&](std::size_t i, std::size_t j) {
    double least = std::numeric_limits<double>::infinity();
    for (Id e = b.vertex_begin[i]; e < b.vertex_begin[i + 1]; ++e) {
      const Vec2 start = at(pose.x, pose.y, e), t = unit(at(pose.x, pose.y, b.next[e]) - start);
      double deepest = -std::numeric_limits<double>::infinity();
      for (Id v = b.vertex_begin[j]; v < b.vertex_begin[j + 1]; ++v)
        deepest = std::max(deepest, cross(t, at(pose.x, pose.y, v) - start));
      least = std::min(least, deepest);
    }
    return least;
  };
  auto vertex_inside = [&](std::size_t i, std::size_t j) {
    double deepest = 0.0;
    for (Id v = b.vertex_begin[i]; v < b.vertex_begin[i + 1]; ++v) {
      const Vec2 p = at(pose.x, pose.y, v);
      bool in = false;
      double nearest = std::numeric_limits<double>::infinity();
      for (Id e = b.vertex_begin[j]; e < b.vertex_begin[j + 1]; ++e) {
        const Vec2 s = at(pose.x, pose.y, e), t = at(pose.x, pose.y, b.next[e]);
        nearest = std::min(nearest, distance_to_segment(p, s, t));
        if ((s.y > p.y) != (t.y > p.y) && (cross(t - s, p - s) > 0.0) == (t.y > s.y)) in = !in;
      }
      if (in) deepest = std::max(deepest, nearest);
    }
    return deepest;
  };
  Overlap worst;
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = i + 1; j < n; ++j) {
      if (box[i].x1 < box[j].x0 || box[j].x1 < box[i].x0 || box[i].y1 < box[j].y0 ||
          box[j].y1 < box[i].y0 || (b.fixed[i] && b.fixed[j])) {
        continue;
      }
      const double depth = box[i].convex && box[j].convex
                               ? std::min(along_normals(i, j), along_normals(j, i))
                               : std::max(vertex_inside(i, j), vertex_inside(j, i));
      if (depth > worst.depth) worst = {depth, static_cast<Id>(i), static_cast<Id>(j)};
    }
  }
  return worst;
}

}  // namespace edda
