// A vertex against an edge: the formulas of method.md section 4, once.
#pragma once

#include "base/vector_loop.hpp"
#include "blocks/block_set.hpp"
#include "blocks/pose.hpp"
#include "contacts/contact_set.hpp"

namespace edda {

/// Edge P2P3 as it lies: unit tangent t, length l, start P2.
struct EdgeFrame {
  Vec2 start, t;
  double length;
  Vec2 normal() const { return outward_normal(t); }
};

struct Gap {
  double depth;  ///< d = -(P1 - P2).n = (Eq. 32) S0/l up to sign, m; > 0 penetrated
  double foot;   ///< z = (P1 - P2).t, m
};

inline Vec2 at(const std::vector<double>& x, const std::vector<double>& y, Id v) {
  return {x[v], y[v]};
}

EDDA_INLINE EdgeFrame edge_frame(Vec2 start, Vec2 end) {
  const Vec2 u = end - start;
  const double l = norm(u);
  return {start, u / l, l};
}

EDDA_INLINE Gap gap_to(const EdgeFrame& e, Vec2 p) {
  const Vec2 r = p - e.start;
  return {cross(e.t, r), dot(r, e.t)};
}

/// Unit tangent and outward normal of the edge of candidate k at step n, as update_gap() left them.
EDDA_INLINE Vec2 tangent_of(const ContactSet& c, std::size_t k) {
  return {c.tx[k], c.ty[k]};
}
inline Vec2 normal_of(const ContactSet& c, std::size_t k) {
  return {c.ty[k], -c.tx[k]};
}

/// How far a neighbour of A may reach below the edge, as a part of its distance from A.
inline constexpr double entrance_slack = 0.1;

/// Entrance cone: both neighbours A' of A satisfy (A' - A).n >= -(entrance_slack + turn) |A' - A| -
/// margin, so that the block lies on the outer side of the edge and may touch it with A. margin in
/// m; turn: how much n itself may change.
inline bool facing(const BlockSet& b, const std::vector<double>& x, const std::vector<double>& y,
                   Id vertex, Vec2 n, double margin = 0.0, double turn = 0.0) {
  const Vec2 a = at(x, y, vertex);
  for (Id other : {b.next[vertex], b.previous[vertex]}) {
    const Vec2 u = at(x, y, other) - a;
    if (dot(u, n) < -(entrance_slack + turn) * norm(u) - margin) return false;
  }
  return true;
}

/// Whether A may come to face the edge e before any vertex has moved by half of `reach` (m). By
/// then A' - A has changed by less than reach, and the edge of length l has turned by less than
/// asin(reach/l), its normal by less than sqrt(2 - 2 sqrt(1 - (reach/l)^2)): beside a long block,
/// that counts for far more than reach itself.
inline bool may_face(const BlockSet& b, const std::vector<double>& x, const std::vector<double>& y,
                     Id vertex, const EdgeFrame& e, double reach) {
  if (reach >= e.length) return true;
  const double part = reach / e.length;
  const double turn = std::sqrt(2.0 - 2.0 * std::sqrt(1.0 - part * part));
  return facing(b, x, y, vertex, e.normal(), (1.0 + entrance_slack) * reach, turn);
}

/// Of the two edges that meet at the vertex, the one that lies most against an edge of normal n.
inline Id facing_edge(const BlockSet& b, const std::vector<double>& x, const std::vector<double>& y,
                      Id vertex, Vec2 n) {
  const Id in = b.previous[vertex];
  const Vec2 a = at(x, y, vertex);
  const Vec2 n_out = outward_normal(unit(at(x, y, b.next[vertex]) - a));
  const Vec2 n_in = outward_normal(unit(a - at(x, y, in)));
  return dot(n_out, n) < dot(n_in, n) ? vertex : in;
}

}  // namespace edda
