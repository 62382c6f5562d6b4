// Geometry of a face: the frame of its two edges, and the ends of its overlap (theory, sections 4.1
// and 4.5). contacts/face.hpp has the notation.
#pragma once

#include "blocks/block_set.hpp"
#include "contacts/face_parts.hpp"

namespace edda {

/// Corners of the two edges, m.
struct FacePoints {
  Vec2 p1, p2, q1, q2;
};

/// Properties of a face that do not change with the positions of its blocks.
struct FacePair {
  double stiffness = 0.0;        ///< k times the thickness, N/m per metre of overlap
  double ends = 0.0;             ///< 1: phi_ends with the weight b; 0: phi_exact alone (b = 0)
  double carries_tension = 0.0;  ///< 1: carries tension
  double inverse_e = 0.0, inverse_f = 0.0;  ///< 1/l of the edges at the start, 1/m
  double length_ratio = 0.0;                ///< l of f over l of e at the start
  double gate_from = 0.0;   ///< cosine of the angle between the edges from which W > 0
  double gate_scale = 1.0;  ///< 1/(cosine from which W = 1, less gate_from)
  double passing = 1.0;     ///< m: corners nearer than this share one corner weight b
  FaceEnds offset;          ///< o, locked closure of initial stress and dilation, m
  Vec2 turn_p1, turn_p2, turn_q1,
      turn_q2;  ///< cosine and sine of the exterior angles of the corners
};

/// Relative tolerance of the overlap: edges whose overlap is shorter than this part of
/// FacePair::passing form no contact. It suppresses chatter by round-off where four corners
/// coincide, as at every crossing of two joint sets, between those that lie across from each other.
/// An overlap of that length could carry 1.5e-10 of what the shorter edge could, and mostly
/// nothing, since the aspect gate allows it closures of twice its length at most.
inline constexpr double least_overlap = 1e-9;
/// Whether the overlap between these coordinates along t exists.
EDDA_INLINE bool overlaps(double from, double to, const FacePair& pair) {
  return to - from > least_overlap * pair.passing;
}

/// Vector from the material point at the fraction xi of e (from p1) to that at the fraction eta of
/// f (from q2).
EDDA_INLINE Vec2 from_point_of_e(const FacePoints& p, double xi, double eta) {
  return eta * p.q1 + (1.0 - eta) * p.q2 - ((1.0 - xi) * p.p1 + xi * p.p2);
}

/// Frame of two edges.
struct EdgeFrame {
  Vec2 t;           ///< unit tangent, or zero where E = F
  double per_base;  ///< 1/|E - F|
};
/// inverse_e, inverse_f as in FacePair; a common factor of both changes per_base alone.
EDDA_INLINE EdgeFrame edge_frame(const FacePoints& p, double inverse_e, double inverse_f) {
  const Vec2 g = inverse_e * (p.p2 - p.p1) - inverse_f * (p.q2 - p.q1);
  const double apart = norm(g), per_base = 1.0 / (apart > 0.0 ? apart : 1.0);
  return {per_base * g, per_base};
}

EDDA_INLINE Vec2 frame_of(const FacePoints& p, double inverse_e, double inverse_f) {
  return edge_frame(p, inverse_e, inverse_f).t;
}

/// Coordinates of the corners along t and n from p1: s and y of p2, q1 and q2, m.
struct EdgeCoordinates {
  double s2, y2, r1, z1, r2, z2;
};
/// Distance along t, and along n, from the material point at the fraction xi of e (from p1) to that
/// at the fraction eta of f (from q2), m.
EDDA_INLINE double along_t(const EdgeCoordinates& c, double xi, double eta) {
  return eta * c.r1 + (1.0 - eta) * c.r2 - xi * c.s2;
}
EDDA_INLINE double along_n(const EdgeCoordinates& c, double xi, double eta) {
  return eta * c.z1 + (1.0 - eta) * c.z2 - xi * c.y2;
}
EDDA_INLINE EdgeCoordinates coordinates_in(const EdgeFrame& frame, const FacePoints& p) {
  const Vec2 e = p.p2 - p.p1, to_q1 = p.q1 - p.p1, to_q2 = p.q2 - p.p1;
  const Vec2 t = frame.t, n = outward_normal(t);
  return {dot(e, t), dot(e, n), dot(to_q1, t), dot(to_q1, n), dot(to_q2, t), dot(to_q2, n)};
}
EDDA_INLINE EdgeCoordinates coordinates_of(const FacePoints& p, double inverse_e,
                                           double inverse_f) {
  return coordinates_in(edge_frame(p, inverse_e, inverse_f), p);
}

/// Geometry of two edges in their frame.
struct EdgeGeometry {
  double tx, ty;                       ///< t
  double per_base;                     ///< 1/|E - F|
  double s2, y2, r1, z1, r2, z2;       ///< as in EdgeCoordinates
  double per_e, per_f;                 ///< 1/s2 and 1/(r1 - r2)
  double slope_e, slope_f;             ///< dy/ds of the edges
  double closure_at_0, closure_slope;  ///< drawn closure: closure_at_0 + closure_slope s
  double ma, mb;                       ///< s of the corners that bound the overlap
  double cosine;                       ///< of theta, times the stretch of both edges
  double length_cosine, length_sine;   ///< of theta, times the lengths of both edges

  EdgeCoordinates corners() const { return {s2, y2, r1, z1, r2, z2}; }
};
/// What follows from the rest of the geometry.
EDDA_INLINE void complete(EdgeGeometry& o, const FacePair& pair) {
  o.closure_slope = o.slope_e - o.slope_f;
  o.ma = positive_part(o.r2);
  o.mb = smaller(o.s2, o.r1);
  o.cosine = o.length_cosine * (pair.inverse_e * pair.inverse_f);
}
EDDA_INLINE EdgeGeometry geometry_of_edges(const FacePoints& at, const FacePair& pair) {
  const Vec2 e = at.p2 - at.p1, f = at.q2 - at.q1;
  const EdgeFrame frame = edge_frame(at, pair.inverse_e, pair.inverse_f);
  const auto [s2, y2, r1, z1, r2, z2] = coordinates_in(frame, at);
  const bool opposed = (s2 > 0.0) & (r1 > r2);
  const double across_e = opposed ? s2 : 1.0, across_f = opposed ? r1 - r2 : 1.0;
  const double per_both = 1.0 / (across_e * across_f);
  const double per_e = across_f * per_both, per_f = across_e * per_both;
  const double slope_e = y2 * per_e, slope_f = (z1 - z2) * per_f;
  EdgeGeometry o;
  o.tx = frame.t.x;
  o.ty = frame.t.y;
  o.per_base = frame.per_base;
  o.s2 = s2;
  o.y2 = y2;
  o.r1 = r1;
  o.z1 = z1;
  o.r2 = r2;
  o.z2 = z2;
  o.per_e = per_e;
  o.per_f = per_f;
  o.slope_e = slope_e;
  o.slope_f = slope_f;
  o.closure_at_0 = -(z2 - slope_f * r2);
  o.length_cosine = -dot(e, f);
  o.length_sine = cross(f, e);
  complete(o, pair);
  return o;
}

template <Formulas use>
EDDA_INLINE bool carries_tension(const FacePair& pair) {
  if constexpr (use != Formulas::all) return false;
  return pair.carries_tension != 0.0;
}

/// Dead band of the closed length, as a part of FacePair::passing, for edges that open from a
/// shared corner on. Blocks that share a corner, as at every crossing of joints, are in contact
/// there by round-off alone, and would open and close in every step.
inline constexpr double least_closed = 1e-11;
/// Closures at the ends: the drawn and the locked ones.
EDDA_INLINE FaceEnds closed_by(FaceEnds drawn, const EdgeGeometry& o, const FacePair& pair) {
  const double rounding = least_closed * std::abs(o.closure_slope) * pair.passing;
  return {drawn.a + pair.offset.a - rounding, drawn.b + pair.offset.b - rounding};
}

/// Closures at the ends that the aspect gate compares with the overlap: the drawn ones and a
/// quarter of the locked ones, so that a face that comes into being begins without force.
EDDA_INLINE FaceEnds gated_closure(double drawn_a, double drawn_b, const FacePair& pair) {
  return {drawn_a + smaller(locked_part * pair.offset.a, pair.passing),
          drawn_b + smaller(locked_part * pair.offset.b, pair.passing)};
}

/// Distance along t of two corners that may pass each other, m: of p1 and q2, or of p2 and q1.
EDDA_INLINE double nearest_corners(const EdgeGeometry& o) {
  return smaller(std::abs(o.r2), std::abs(o.s2 - o.r1));
}

/// Whether the aspect gate of a face without tension is certainly 0: no corners pass each other, so
/// that the overlap is from ma to mb, and it is shorter than aspect_from times `deepest`, the
/// larger of gated_closure().
EDDA_INLINE bool is_faded(const EdgeGeometry& o, double deepest, const FacePair& pair) {
  constexpr double surely = 0.999;
  return (o.mb - o.ma < surely * aspect_from * deepest) & (nearest_corners(o) >= pair.passing);
}

/// Whether the short formulas suffice: the face carries no tension, and either no corners pass each
/// other and W = w = 1, or there is no overlap. drawn: the drawn closures at the ends of the
/// overlap, which count where no corners pass each other.
EDDA_INLINE bool is_plain(const EdgeGeometry& o, FaceEnds drawn, const FacePair& pair) {
  const double along = (o.cosine - pair.gate_from) * pair.gate_scale, length = o.mb - o.ma;
  const bool absent = !overlaps(o.ma, o.mb, pair) | (along <= 0.0) | (o.s2 <= 0.0) | (o.r1 <= o.r2);
  const bool apart = nearest_corners(o) >= pair.passing;
  const FaceEnds gated = gated_closure(drawn.a, drawn.b, pair);
  constexpr double shallow = 1.001 * (aspect_from + aspect_range);
  const bool rigid = apart & (along >= 1.0) & (length >= shallow * larger(gated.a, gated.b));
  return (pair.carries_tension == 0.0) & (absent | rigid);
}
EDDA_INLINE bool is_plain(const EdgeGeometry& o, const FacePair& pair) {
  return is_plain(
      o, {o.closure_at_0 + o.closure_slope * o.ma, o.closure_at_0 + o.closure_slope * o.mb}, pair);
}

/// The ends of the overlap, as coordinates along t from p1, m.
struct OverlapEnds {
  double sa = 0.0, sb = 0.0;
  bool exists = false;                  ///< the edges are opposed and overlap
  bool a_by_p = false, b_by_p = false;  ///< p1 bounds end a, p2 end b
  double la = 0.0, lb = 0.0;            ///< where the closures are taken on which r depends
  double per_passing = 0.0;             ///< 1/m
  CornersPassing near_a{}, near_b{};    ///< corners that pass each other, for la and lb
  CornersPassing pass_a{}, pass_b{};    ///< corners within r of each other, for sa and sb
  PassingReach reach{};
};

/// The overlap of two edges.
template <Formulas use>
EDDA_INLINE OverlapEnds overlap_of(const EdgeGeometry& o, const FacePair& pair) {
  OverlapEnds v;
  v.a_by_p = o.r2 <= 0.0;
  v.b_by_p = o.s2 <= o.r1;
  v.sa = v.la = o.ma;
  v.sb = v.lb = o.mb;
  const bool opposed = (o.s2 > 0.0) & (o.r1 > o.r2) & (o.cosine > pair.gate_from);
  v.exists = overlaps(o.ma, o.mb, pair) & opposed;
  if constexpr (use != Formulas::plain) {
    const bool carries = carries_tension<use>(pair);
    const double furthest = furthest_reach * pair.passing, per_furthest = 1.0 / furthest;
    v.per_passing = furthest_reach * per_furthest;
    v.near_a = corners_passing(-o.r2, furthest, per_furthest);
    v.near_b = corners_passing(o.s2 - o.r1, furthest, per_furthest);
    const double beyond = 0.25 * furthest;
    v.la = o.ma + v.near_a.inward - beyond;
    v.lb = o.mb - v.near_b.inward + beyond;
    const double corner_a = o.closure_at_0 + o.closure_slope * v.la + pair.offset.a;
    const double corner_b = o.closure_at_0 + o.closure_slope * v.lb + pair.offset.b;
    v.reach = passing_reach(carries ? corner_a : positive_part(corner_a),
                            carries ? corner_b : positive_part(corner_b), furthest, per_furthest);
    const double per_reach = 1.0 / (v.reach.reach > 0.0 ? v.reach.reach : 1.0);
    v.pass_a = corners_passing(-o.r2, v.reach.reach, per_reach);
    v.pass_b = corners_passing(o.s2 - o.r1, v.reach.reach, per_reach);
    const double from = o.ma + v.pass_a.inward, to = o.mb - v.pass_b.inward;
    v.exists = overlaps(from, to, pair) & opposed;
    v.sa = v.exists ? from : o.ma;
    v.sb = v.exists ? to : o.mb;
  }
  return v;
}

}  // namespace edda
