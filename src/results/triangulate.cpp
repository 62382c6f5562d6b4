#include "results/triangulate.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace edda {
namespace {

struct Corner {
  Vec2 p;
  std::size_t id;
};

using Loop = std::vector<Corner>;

double orient(Vec2 a, Vec2 b, Vec2 c) {
  return cross(b - a, c - a);
}

/// In the closed triangle, which runs counter-clockwise.
bool in_triangle(Vec2 a, Vec2 b, Vec2 c, Vec2 p) {
  return orient(a, b, p) >= 0.0 && orient(b, c, p) >= 0.0 && orient(c, a, p) >= 0.0;
}

/// Whether the segment from corner k of the loop towards p starts into the region.
bool locally_inside(const Loop& loop, std::size_t k, Vec2 p) {
  const std::size_t n = loop.size();
  const Vec2 a = loop[(k + n - 1) % n].p, b = loop[k].p, c = loop[(k + 1) % n].p;
  if (orient(a, b, c) >= 0.0) return orient(b, c, p) >= 0.0 && orient(a, b, p) >= 0.0;
  return orient(b, c, p) >= 0.0 || orient(a, b, p) >= 0.0;
}

/// Corner of the loop that is seen from `from`, looking to +x (Eberly): the nearer end of the edge
/// that the ray strikes first or, where other corners stand before it, the one at the smallest
/// angle.
/// A hole that touches the loop at `from` is joined there; `before` and `after` are its next
/// corners.
std::size_t visible_corner(const Loop& loop, Vec2 from, Vec2 before, Vec2 after) {
  const std::size_t n = loop.size();
  double nearest = std::numeric_limits<double>::infinity();
  std::size_t best = n;
  for (std::size_t k = 0; k < n; ++k) {
    const Vec2 a = loop[k].p, b = loop[(k + 1) % n].p;
    if (a == from && locally_inside(loop, k, before) && locally_inside(loop, k, after)) return k;
    // The region lies left of its edges, so the ray leaves it through an edge that runs upwards.
    if (!(a.y <= from.y && from.y <= b.y && a.y < b.y)) continue;
    const double x = a.x + (from.y - a.y) / (b.y - a.y) * (b.x - a.x);
    if (x < from.x || x >= nearest) continue;
    nearest = x;
    best = a.x > b.x ? k : (k + 1) % n;
  }
  if (best == n) return n;
  const Vec2 hit{nearest, from.y}, end = loop[best].p;
  double smallest = std::numeric_limits<double>::infinity();
  std::size_t seen = best;
  for (std::size_t k = 0; k < n; ++k) {
    const Vec2 p = loop[k].p;
    if (p.x < from.x || p == from) continue;
    const bool inside =
        end.y < from.y ? in_triangle(from, end, hit, p) : in_triangle(from, hit, end, p);
    if (!inside || !locally_inside(loop, k, from)) continue;
    const double slope = std::abs(p.y - from.y) / std::max(p.x - from.x, 1e-300);
    if (slope < smallest || (slope == smallest && p.x < loop[seen].p.x)) {
      smallest = slope;
      seen = k;
    }
  }
  return seen;
}

/// Joins the hole to the loop by a bridge run in both directions.
void bridge(Loop& loop, const Loop& hole) {
  const auto right = std::max_element(
      hole.begin(), hole.end(), [](const Corner& a, const Corner& b) { return a.p.x < b.p.x; });
  const Vec2 before = (right == hole.begin() ? hole.back() : *(right - 1)).p;
  const Vec2 after = (right + 1 == hole.end() ? hole.front() : *(right + 1)).p;
  const std::size_t k = visible_corner(loop, right->p, before, after);
  if (k == loop.size()) return;
  Loop path(right, hole.end());
  path.insert(path.end(), hole.begin(), right + 1);
  path.push_back(loop[k]);
  loop.insert(loop.begin() + static_cast<std::ptrdiff_t>(k) + 1, path.begin(), path.end());
}

bool is_ear(const Loop& loop, std::size_t k) {
  const std::size_t n = loop.size(), before = (k + n - 1) % n, after = (k + 1) % n;
  const Vec2 a = loop[before].p, b = loop[k].p, c = loop[after].p;
  if (!(orient(a, b, c) > 0.0)) return false;
  for (std::size_t q = 0; q < n; ++q) {
    const Vec2 p = loop[q].p;
    if (q == before || q == k || q == after || p == a || p == c) continue;
    if (p == b) {
      // Another corner on this one, as where holes touch: its edges must not run through the ear.
      for (const std::size_t r : {(q + n - 1) % n, (q + 1) % n}) {
        const Vec2 d = loop[r].p - b;
        if (cross(c - b, d) > 0.0 && cross(d, a - b) > 0.0) return false;
      }
      continue;
    }
    if (!in_triangle(a, b, c, p)) continue;
    if (orient(loop[(q + n - 1) % n].p, p, loop[(q + 1) % n].p) <= 0.0) return false;
  }
  return true;
}

/// The ear of the widest smallest angle: fewer slivers, and no order of corners is preferred.
std::size_t best_ear(const Loop& loop) {
  const std::size_t n = loop.size();
  std::size_t best = n;
  double quality = -1.0;
  for (std::size_t k = 0; k < n; ++k) {
    const Vec2 a = loop[(k + n - 1) % n].p, b = loop[k].p, c = loop[(k + 1) % n].p;
    const double longest = std::max({dot(b - a, b - a), dot(c - b, c - b), dot(a - c, a - c)});
    const double q = orient(a, b, c) / longest;
    if (q > quality && is_ear(loop, k)) {
      quality = q;
      best = k;
    }
  }
  return best;
}

/// Takes out a corner whose neighbours lie on one another: there and back again, no area. Such
/// spurs are left where holes touch.
bool drop_spur(Loop& loop) {
  const std::size_t n = loop.size();
  for (std::size_t k = 0; k < n; ++k) {
    const std::size_t after = (k + 1) % n;
    if (!(loop[(k + n - 1) % n].p == loop[after].p)) continue;
    loop.erase(loop.begin() + static_cast<std::ptrdiff_t>(std::max(k, after)));
    loop.erase(loop.begin() + static_cast<std::ptrdiff_t>(std::min(k, after)));
    return true;
  }
  return false;
}

/// Where rounding has left no ear: the flattest corner adds the least that is wrong.
std::size_t flattest(const Loop& loop) {
  const std::size_t n = loop.size();
  std::size_t best = 0;
  double smallest = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < n; ++k) {
    const double twice = std::abs(orient(loop[(k + n - 1) % n].p, loop[k].p, loop[(k + 1) % n].p));
    if (twice < smallest) {
      smallest = twice;
      best = k;
    }
  }
  return best;
}

}  // namespace

std::vector<Triangle> triangulate(std::span<const Ring> rings) {
  std::vector<Triangle> triangles;
  std::vector<Loop> loops;
  std::size_t id = 0;
  for (const Ring& ring : rings) {
    Loop& loop = loops.emplace_back();
    for (const Vec2 p : ring) loop.push_back({p, id++});
  }
  if (loops.empty()) return triangles;
  // The rightmost hole first: it sees the outer ring past all the others.
  auto right_end = [](const Loop& l) {
    double x = -std::numeric_limits<double>::infinity();
    for (const Corner& c : l) x = std::max(x, c.p.x);
    return x;
  };
  std::stable_sort(loops.begin() + 1, loops.end(),
                   [&](const Loop& a, const Loop& b) { return right_end(a) > right_end(b); });
  Loop loop = loops[0];
  for (std::size_t h = 1; h < loops.size(); ++h) bridge(loop, loops[h]);

  while (loop.size() > 2) {
    if (drop_spur(loop)) continue;
    const std::size_t n = loop.size();
    std::size_t k = best_ear(loop);
    if (k < n) {
      triangles.push_back({loop[(k + n - 1) % n].id, loop[k].id, loop[(k + 1) % n].id});
    } else {
      k = flattest(loop);
    }
    loop.erase(loop.begin() + static_cast<std::ptrdiff_t>(k));
  }
  return triangles;
}

bool is_convex(std::span<const Vec2> ring) {
  const std::size_t n = ring.size();
  for (std::size_t k = 0; k < n; ++k) {
    if (orient(ring[k], ring[(k + 1) % n], ring[(k + 2) % n]) < 0.0) return false;
  }
  return true;
}

}  // namespace edda
