#include "contacts/shield.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "contacts/candidates.hpp"
#include "contacts/gap.hpp"

namespace edda {
namespace {

constexpr double full_turn = 2.0 * std::numbers::pi;

/// Angle of v counter-clockwise from u, in [0, 2 pi).
double turn(Vec2 u, Vec2 v) {
  const double a = std::atan2(cross(u, v), dot(u, v));
  return a < 0.0 ? a + full_turn : a;
}

/// The corner of a block: it fills the angle from `from` counter-clockwise to `to`.
struct Wedge {
  Vec2 from, to;
  Vec2 middle() const { return rotated(from, 0.5 * turn(from, to)); }
  double angle() const { return turn(from, to); }
};

Wedge wedge_at(const BlockSet& b, const Pose& pose, Id vertex) {
  const Vec2 p = at(pose.x, pose.y, vertex);
  return {at(pose.x, pose.y, b.next[vertex]) - p, at(pose.x, pose.y, b.previous[vertex]) - p};
}

/// Part of the sector of `angle` counter-clockwise from `from` that the fillers take.
double filled(Vec2 from, double angle, const std::array<Wedge, 16>& fillers, std::size_t n) {
  double sum = 0.0;
  for (std::size_t i = 0; i < n; ++i) {
    if (turn(from, fillers[i].middle()) < angle) sum += fillers[i].angle();
  }
  return sum;
}

}  // namespace

bool shielded(const ContactSet& c, const BlockSet& b, const Pose& pose, std::size_t k) {
  const Id vertex = c.vertex[k];
  const Vec2 a = at(pose.x, pose.y, vertex);
  const double shortest = std::min(
      {b.edge_length[c.edge[k]], b.edge_length[vertex], b.edge_length[b.previous[vertex]]});
  const double near = corner_reach * shortest;
  auto is_near = [&](Id v) { return norm(at(pose.x, pose.y, v) - a) <= near; };
  Id corner = no_id;
  if (is_near(c.edge[k])) corner = c.edge[k];
  if (is_near(c.edge_end[k])) corner = c.edge_end[k];
  if (corner == no_id) return false;

  // Corners of third blocks at the same point, from what either of the two corners is near to (held
  // blocks know nothing of each other).
  std::array<Wedge, 16> fillers;
  std::array<Id, 16> seen;
  std::size_t n = 0;
  for (const Id from : {vertex, corner}) {
    for (Id q = c.begin_of_vertex[from]; q < c.begin_of_vertex[from + 1]; ++q) {
      if (c.block_j[q] == c.block_i[k] || c.block_j[q] == c.block_j[k]) continue;
      for (Id v : {c.edge[q], c.edge_end[q]}) {
        const bool known = std::find(seen.begin(), seen.begin() + n, v) != seen.begin() + n;
        if (known || n == fillers.size() || !is_near(v)) continue;
        seen[n] = v;
        fillers[n++] = wedge_at(b, pose, v);
      }
    }
  }
  if (n == 0) return false;
  const Wedge mine = wedge_at(b, pose, vertex), theirs = wedge_at(b, pose, corner);
  constexpr double adjacent = 0.01, straight = 0.02;  // rad
  for (const auto& [from, to] :
       {std::pair{mine.to, theirs.from}, std::pair{theirs.to, mine.from}}) {
    const double gap = turn(from, to);
    if (gap < adjacent || gap > full_turn - adjacent) return false;
  }
  for (const auto& [from, to] :
       {std::pair{mine.to, theirs.from}, std::pair{theirs.to, mine.from}}) {
    const double gap = turn(from, to);
    if (gap < std::numbers::pi - straight && filled(from, gap, fillers, n) >= 0.9 * gap)
      return true;
  }
  return false;
}

}  // namespace edda
