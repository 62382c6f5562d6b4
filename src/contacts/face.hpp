// The contact of two blocks: a face, an edge of one against an opposed edge of another (Goodman's
// joint element, Goodman, Taylor & Brekke 1968, with large displacements). docs/contacts.md.
//
// Notation. Edge e = p1p2 of the one block and edge f = q1q2 of the other, both interiors on the
// left.
//   E = p2 - p1, F = q2 - q1, over their lengths at the start; frame t = (E - F)/|E - F|, between
//   the two edges, n = (t.y, -t.x), out of the first block.
//   s, y: coordinates along t and n from p1. Overlap [sa, sb], length L = sb - sa; at each of its
//   ends one corner bounds it. Where two corners pass each other within r, about half of the
//   closure, the bound goes over from the one to the other smoothly: min(s, s') - (r - |s -
//   s'|)^2/(4 r). The ends lie over the parts xi of e (from p1 to p2) and eta of f (from q2 to q1).
//   Closures da and db there (m, > 0: pressed together), linear in between.
// Stored energy  U = w W k L phi(da, db),  phi = phi_exact + b (phi_ends - phi_exact):
//   phi_exact = 1/(2 L) Int max(d, 0)^2 ds        the joint's own law;
//   phi_ends  = (max(da, 0)^2 + max(db, 0)^2)/4   the integral taken at the ends: a corner that
//                                                 leans on an edge keeps its whole spring;
//   b  share of a leaning corner: 1 where it lies flat, 0 where its other edge lies flat;
//   w  fades what is deeper than long, W what stands across.
// Forces are the exact gradient of U: they sum to zero and have no moment.
#pragma once

#include <cmath>

#include "base/vec2.hpp"
#include "base/vector_loop.hpp"

namespace edda {

/// Corners of the two edges, m.
struct FacePoints {
  Vec2 p1, p2, q1, q2;
};

/// A value at each end of the overlap.
struct FaceEnds {
  double a = 0.0, b = 0.0;
};

/// What a face keeps while its blocks move.
struct FacePair {
  double stiffness = 0.0;                   ///< k times the thickness, N/m per metre of overlap
  double ends = 0.0;                        ///< 1: the integral is taken at the ends; 0: exact
  double pulls = 0.0;                       ///< 1: bears tension
  double inverse_e = 0.0, inverse_f = 0.0;  ///< 1/l of the edges at the start, 1/m
  double gate_from = 0.0;   ///< cosine of the angle between the edges from which W > 0
  double gate_scale = 1.0;  ///< 1/(cosine from which W = 1, less gate_from)
  double passing = 1.0;     ///< m: corners nearer than this have one share between them
  FaceEnds offset;          ///< o, closure of the surfaces as drawn, m: initial stress, dilation
  Vec2 p1_turn, p2_turn, q1_turn, q2_turn;  ///< cosine and sine of the exterior angles
};

/// Forces on the corners, N.
struct CornerForces {
  Vec2 p1, p2, q1, q2;
};

/// A face as it stands.
struct Face {
  Vec2 t;
  double inverse_e = 0.0, inverse_f = 0.0;  ///< what turns t as e and f turn: 1/(l |E - F|), 1/m
  double length = 0.0;                      ///< L, m; <= 0: no overlap
  double cohesive = 0.0;                    ///< length along which cohesion acts, m
  FaceEnds closure;                         ///< d, m
  FaceEnds xi, eta;
  double gate = 0.0;        ///< w W
  double angle_gate = 0.0;  ///< W
  double share = 0.0;       ///< b
  double energy = 0.0;      ///< U, J
  FaceEnds normal;          ///< w W dU/dd of each end: the normal force there, N
  FaceEnds slope;           ///< of the edge that the corner at each end is pressed against
  FaceEnds along;           ///< dU/dsa and dU/dsb, N
  FaceEnds of_first;        ///< part by which each end follows the first block's corner
  CornerForces force;       ///< of the normal pressure
};

/// Of two material points, the one of f at eta from q2 and that of e at xi from p1: how far the
/// first lies from the second.
EDDA_INLINE Vec2 from_point_of_e(const FacePoints& p, double xi, double eta) {
  return eta * p.q1 + (1.0 - eta) * p.q2 - ((1.0 - xi) * p.p1 + xi * p.p2);
}

/// Unit tangent t of the frame, or zero where both edges run the same way; inverse_e, inverse_f as
/// in FacePair.
EDDA_INLINE Vec2 frame_of(const FacePoints& p, double inverse_e, double inverse_f) {
  const Vec2 g = inverse_e * (p.p2 - p.p1) - inverse_f * (p.q2 - p.q1);
  const double size = norm(g);
  return g / (size > 0.0 ? size : 1.0);
}

/// A choice that loops over several faces can make.
EDDA_INLINE Vec2 chosen(bool first, Vec2 a, Vec2 b) {
  return {first ? a.x : b.x, first ? a.y : b.y};
}

/// S(x) = x^2 (3 - 2 x) on [0, 1], 0 before and 1 beyond.
struct SmoothStep {
  double value, slope;
};
EDDA_INLINE SmoothStep smooth_step(double x) {
  const double u = smaller(larger(x, 0.0), 1.0);
  return {u * u * (3.0 - 2.0 * u), 6.0 * u * (1.0 - u)};
}

/// Closures deeper than this part of the overlap begin to fade, and are gone at four times that.
inline constexpr double aspect_from = 0.5, aspect_range = 1.5;
/// Part of the initial stress's closure that counts there.
inline constexpr double locked_part = 0.25;

/// Cosine of the angle between edges that lie along each other: 8 degrees. Cohesion needs surfaces
/// that do; a corner that leans on an edge has friction alone. It goes over up to 4
/// degrees.
inline constexpr double lies_along = 0.99, lies_flush = 0.9976;
EDDA_INLINE double flush_part(double cosine) {
  return smooth_step((cosine - lies_along) * (1.0 / (lies_flush - lies_along))).value;
}

/// What bounds an end of the overlap where two corners are x apart along the face and pass each
/// other within `reach` (m): how far it is drawn in, and by which part it follows the corner that
/// would not bound it alone. Without it the force along the face would jump by k d^2/2.
struct CornersPassing {
  double drawn_in, by_other;
  double by_reach;  ///< derivative of drawn_in
};
EDDA_INLINE CornersPassing corners_passing(double x, double reach) {
  const double near = larger(reach - std::abs(x), 0.0);
  const double part = near / (reach > 0.0 ? reach : 1.0);
  return {0.25 * near * part, 0.5 * part, 0.25 * part * (2.0 - part)};
}

/// Part by which each end follows the first block's corner.
EDDA_INLINE FaceEnds of_first(const CornersPassing& a, const CornersPassing& b, bool a_by_first,
                              bool b_by_first) {
  return {a_by_first ? 1.0 - a.by_other : a.by_other, b_by_first ? 1.0 - b.by_other : b.by_other};
}

/// That reach, of the closures at both ends, (da^2 + db^2)^(1/2)/3, towards a furthest one: edges
/// may be shorter than what an initial stress locks in. The closure of corners that pass each other
/// is taken halfway between the two, or it would go on at another rate where one takes over.
inline constexpr double furthest_reach = 0.5;  ///< of FacePair::passing
struct PassingReach {
  double reach, by_a, by_b;
};
EDDA_INLINE PassingReach passing_reach(double da, double db, double furthest) {
  const double both = std::sqrt(da * da + db * db), part = 1.0 / 3.0;
  const double u = smaller(0.5 * part * both / furthest, 1.0);
  const double slope = part * (1.0 - u) / (both > 0.0 ? both : 1.0);
  return {furthest * u * (2.0 - u), slope * da, slope * db};
}

/// phi and its derivatives by da and db.
struct ClosurePotential {
  double value, by_a, by_b;
};

/// 1/(2 L) Int max(d, 0)^2 ds: (da^2 + da db + db^2)/6 where both ends are closed; else, of the
/// closed end d, d^3/(6 |da - db|).
EDDA_INLINE ClosurePotential exact_potential(double da, double db, bool pulls) {
  const double pa = larger(da, 0.0), pb = larger(db, 0.0);
  const bool whole = pulls | ((da >= 0.0) & (db >= 0.0));
  const double closed = pa + pb, difference = std::abs(da - db);
  const double part = closed / (difference > 0.0 ? difference : 1.0);
  const double far = closed * part * part / 6.0;  // by the open end
  const double near = closed * part / 2.0 - far;  // by the closed end
  return {whole ? (da * da + da * db + db * db) / 6.0 : closed * closed * part / 6.0,
          whole ? (2.0 * da + db) / 6.0 : (pa > 0.0 ? near : far),
          whole ? (da + 2.0 * db) / 6.0 : (pb > 0.0 ? near : far)};
}

EDDA_INLINE ClosurePotential potential_at_ends(double da, double db, bool pulls) {
  const double pa = pulls ? da : larger(da, 0.0), pb = pulls ? db : larger(db, 0.0);
  return {(pa * pa + pb * pb) / 4.0, pa / 2.0, pb / 2.0};
}

/// Part of a leaning corner, sin^2(eps - theta)/(sin^2 theta + sin^2(eps - theta)): its two edges
/// make theta and eps - theta with the edge that it leans on, so that their parts sum to one.
/// c and s: cosine and sine of theta >= 0, both times the same length. With its derivatives.
struct CornerShare {
  double value, by_c, by_s;
};
EDDA_INLINE CornerShare corner_share(Vec2 turn, double c, double s) {
  const double x = larger(turn.y * c - turn.x * s, 0.0);
  const double a = x * x, b = s * s, sum = a + b;
  const double inverse = 1.0 / (sum > 0.0 ? sum : 1.0), twice = 2.0 * inverse * inverse;
  return {a * inverse, twice * b * x * turn.y, -twice * (b * x * turn.x + a * s)};
}

/// Adds -e at the part xi of the first edge, and f at the part eta of the second.
EDDA_INLINE void add_pressures(CornerForces& on, double xi, double eta, Vec2 e, Vec2 f) {
  on.p1 -= (1.0 - xi) * e;
  on.p2 -= xi * e;
  on.q1 += eta * f;
  on.q2 += (1.0 - eta) * f;
}
EDDA_INLINE void add_at(CornerForces& on, double xi, double eta, Vec2 f) {
  add_pressures(on, xi, eta, f, f);
}

/// Adds forces along t on what bounds the ends.
EDDA_INLINE void push_bounds(CornerForces& on, FaceEnds of_first, Vec2 t, FaceEnds f) {
  on.p1 += of_first.a * f.a * t;
  on.q2 += (1.0 - of_first.a) * f.a * t;
  on.p2 += of_first.b * f.b * t;
  on.q1 += (1.0 - of_first.b) * f.b * t;
}

/// The frame goes with both edges: their couples, which leave no moment.
EDDA_INLINE void add_couple_of_frame(CornerForces& on, const FacePoints& at, const Face& face) {
  const Vec2 p = at.p1;
  const double moment = cross(at.p2 - p, on.p2) + cross(at.q1 - p, on.q1) + cross(at.q2 - p, on.q2);
  const Vec2 e = (moment * face.inverse_e) * perp(face.t);
  const Vec2 f = (moment * face.inverse_f) * perp(face.t);
  on.p1 += e;
  on.p2 -= e;
  on.q1 -= f;
  on.q2 += f;
}

/// Where two edges stand to each other.
struct Opposition {
  double tx, ty;            ///< t
  double base;              ///< |E - F|
  double s2, r1, r2;        ///< s of p2, q1 and q2
  double per_e, per_f;      ///< 1/s2 and 1/(r1 - r2)
  double slope_e, slope_f;  ///< dy/ds
  double apart_0, steeper;  ///< closure as drawn: apart_0 + steeper s
  double ma, mb;            ///< s of the corners that bound the overlap
  double cosine;            ///< of theta, but for the stretch of the edges
};
EDDA_INLINE Opposition opposition_of(const FacePoints& at, const FacePair& pair) {
  const Vec2 e = at.p2 - at.p1, f = at.q2 - at.q1;
  const Vec2 g = pair.inverse_e * e - pair.inverse_f * f;
  const double apart = norm(g), base = apart > 0.0 ? apart : 1.0;
  const Vec2 t = g / base, n = outward_normal(t);
  const Vec2 to_q1 = at.q1 - at.p1, to_q2 = at.q2 - at.p1;
  const double s2 = dot(e, t), y2 = dot(e, n);
  const double r1 = dot(to_q1, t), z1 = dot(to_q1, n), r2 = dot(to_q2, t), z2 = dot(to_q2, n);
  const bool opposed = (s2 > 0.0) & (r1 > r2);
  const double per_e = 1.0 / (opposed ? s2 : 1.0), per_f = 1.0 / (opposed ? r1 - r2 : 1.0);
  const double slope_e = y2 * per_e, slope_f = (z1 - z2) * per_f;
  const double apart_0 = -(z2 - slope_f * r2),
               cosine = -dot(e, f) * (pair.inverse_e * pair.inverse_f);
  return {t.x,
          t.y,
          base,
          s2,
          r1,
          r2,
          per_e,
          per_f,
          slope_e,
          slope_f,
          apart_0,
          slope_e - slope_f,
          larger(r2, 0.0),
          smaller(s2, r1),
          cosine};
}

/// What w goes by: closures at the ends as the edges are drawn, and a part of what is locked in.
/// So a face that comes to be begins with nothing.
EDDA_INLINE FaceEnds gated_closure(double drawn_a, double drawn_b, const FacePair& pair) {
  return {drawn_a + smaller(locked_part * pair.offset.a, pair.passing),
          drawn_b + smaller(locked_part * pair.offset.b, pair.passing)};
}

EDDA_INLINE Face face_between(const FacePoints& at, const FacePair& pair) {
  Face face;
  const Opposition o = opposition_of(at, pair);
  const Vec2 e = at.p2 - at.p1, f = at.q2 - at.q1, t{o.tx, o.ty}, n = outward_normal(t);
  const double s2 = o.s2, r1 = o.r1, r2 = o.r2, per_e = o.per_e, per_f = o.per_f, ma = o.ma,
               mb = o.mb, slope_e = o.slope_e, slope_f = o.slope_f, apart_0 = o.apart_0,
               steeper = o.steeper, cosine = o.cosine;
  const double c = -dot(e, f), s = cross(f, e);      // of theta, times both lengths
  const bool a_by_p = r2 <= 0.0, b_by_p = s2 <= r1;  // p1 and p2 bound the overlap
  const bool opposed = (s2 > 0.0) & (r1 > r2);
  const double furthest = furthest_reach * pair.passing;
  const CornersPassing near_a = corners_passing(-r2, furthest),
                       near_b = corners_passing(s2 - r1, furthest);
  const double beyond = 0.25 * furthest;
  const double la = ma + near_a.drawn_in - beyond, lb = mb - near_b.drawn_in + beyond;
  const double corner_a = apart_0 + steeper * la + pair.offset.a;
  const double corner_b = apart_0 + steeper * lb + pair.offset.b;
  const bool pulls = pair.pulls != 0.0;
  const PassingReach wide = passing_reach(pulls ? corner_a : larger(corner_a, 0.0),
                                          pulls ? corner_b : larger(corner_b, 0.0), furthest);
  const CornersPassing pass_a = corners_passing(-r2, wide.reach),
                       pass_b = corners_passing(s2 - r1, wide.reach);
  const double sa = ma + pass_a.drawn_in, sb = mb - pass_b.drawn_in;
  face.t = t;
  face.inverse_e = pair.inverse_e / o.base;
  face.inverse_f = pair.inverse_f / o.base;
  face.length = sb - sa;
  face.xi = {sa * per_e, sb * per_e};
  face.eta = {(sa - r2) * per_f, (sb - r2) * per_f};
  const double drawn_a = apart_0 + steeper * sa, drawn_b = apart_0 + steeper * sb;
  const double da = drawn_a + pair.offset.a, db = drawn_b + pair.offset.b;
  face.closure = {da, db};

  // W, of the angle theta between the edges
  const double inverse_lengths = pair.inverse_e * pair.inverse_f;
  const SmoothStep by_angle = smooth_step((cosine - pair.gate_from) * pair.gate_scale);
  const bool on = (face.length > 0.0) & (cosine > pair.gate_from) & opposed;

  // w
  const bool deep_b = db >= da;
  const FaceEnds gated = gated_closure(drawn_a, drawn_b, pair);
  const double deepest = larger(gated.a, gated.b);
  const bool gated_deep_b = gated.b >= gated.a;
  const bool fades = (deepest > 0.0) & !pulls;
  const double per_deepest = 1.0 / (fades ? deepest : 1.0);
  const SmoothStep by_aspect =
      smooth_step(fades ? (face.length * per_deepest - aspect_from) / aspect_range : 1.0);
  const double aspect_slope = by_aspect.slope / aspect_range * per_deepest;  // dw/dL

  // b, of the corner that bounds the deeper end; one that is about to pass it counts, too
  const Vec2 a_turn = chosen(a_by_p, pair.p1_turn, pair.q2_turn),
             a_other = chosen(a_by_p, pair.q2_turn, pair.p1_turn);
  const Vec2 b_turn = chosen(b_by_p, pair.p2_turn, pair.q1_turn),
             b_other = chosen(b_by_p, pair.q1_turn, pair.p2_turn);
  const double tilt = std::abs(s);
  const CornerShare own = corner_share(chosen(deep_b, b_turn, a_turn), c, tilt);
  const CornerShare other = corner_share(chosen(deep_b, b_other, a_other), c, tilt);
  const double past = deep_b ? s2 - r1 : -r2;  // of the first block's corner beyond the second's
  const SmoothStep passing = smooth_step(1.0 - std::abs(past) / pair.passing);
  const bool more = other.value > own.value;
  const double mixed = more ? passing.value : 0.0;
  const double share = pair.ends * (own.value + mixed * (other.value - own.value));
  const double share_by_c = pair.ends * (own.by_c + mixed * (other.by_c - own.by_c));
  const double share_by_tilt = pair.ends * (own.by_s + mixed * (other.by_s - own.by_s));
  const double share_by_past =
      pair.ends * (more ? (other.value - own.value) * passing.slope / pair.passing : 0.0);

  const ClosurePotential exact = exact_potential(da, db, pulls),
                         ends = potential_at_ends(da, db, pulls);
  const double gain = ends.value - exact.value;
  const double exists = on ? 1.0 : 0.0;
  const double gate = exists * by_aspect.value * by_angle.value;
  const double whole = exists * pair.stiffness * face.length;
  const double phi = exact.value + share * gain;
  face.gate = gate;
  face.angle_gate = exists * by_angle.value;
  face.cohesive = gate * larger(face.length, 0.0) * flush_part(cosine);
  face.share = share;
  face.energy = gate * whole * phi;
  face.normal = {gate * whole * (exact.by_a + share * (ends.by_a - exact.by_a)),
                 gate * whole * (exact.by_b + share * (ends.by_b - exact.by_b))};

  // dU/dL, dU/dd, dU/dc, dU/ds and dU/d(past)
  const double stored = whole * phi, angle_gate = face.angle_gate;
  const double by_length = gate * pair.stiffness * phi + angle_gate * stored * aspect_slope;
  const double by_deepest = -angle_gate * stored * aspect_slope * face.length * per_deepest;
  const double by_a = face.normal.a + (gated_deep_b ? 0.0 : by_deepest);
  const double by_b = face.normal.b + (gated_deep_b ? by_deepest : 0.0);
  const double by_share = gate * whole * gain;
  const double by_c =
      by_aspect.value * stored * by_angle.slope * pair.gate_scale * inverse_lengths +
      by_share * share_by_c;
  const double by_s = by_share * (s < 0.0 ? -share_by_tilt : share_by_tilt);
  const double by_past = by_share * (past < 0.0 ? share_by_past : -share_by_past);

  // dU/dsa and dU/dsb, and dU/dd of the corners that the reach goes by
  const double by_sa = by_a * steeper - by_length, by_sb = by_b * steeper + by_length;
  const double by_reach = by_sa * pass_a.by_reach - by_sb * pass_b.by_reach;
  const double by_corner_a = by_reach * wide.by_a, by_corner_b = by_reach * wide.by_b;

  CornerForces& force = face.force;
  face.slope = {a_by_p ? slope_f : slope_e, b_by_p ? slope_f : slope_e};
  add_pressures(force, la * per_e, (la - r2) * per_f, by_corner_a * (n - slope_e * t),
                by_corner_a * (n - slope_f * t));
  add_pressures(force, lb * per_e, (lb - r2) * per_f, by_corner_b * (n - slope_e * t),
                by_corner_b * (n - slope_f * t));
  push_bounds(force, of_first(near_a, near_b, a_by_p, b_by_p), t,
              {-steeper * by_corner_a, -steeper * by_corner_b});
  add_pressures(force, face.xi.a, face.eta.a, by_a * (n - slope_e * t), by_a * (n - slope_f * t));
  add_pressures(force, face.xi.b, face.eta.b, by_b * (n - slope_e * t), by_b * (n - slope_f * t));
  face.along = {by_sa, by_sb};
  face.of_first = of_first(pass_a, pass_b, a_by_p, b_by_p);
  push_bounds(force, face.of_first, t, {-by_sa, -by_sb});
  const Vec2 beside = by_past * t;  // past = (p2 - q1).t or (p1 - q2).t
  force.p2 -= (deep_b ? 1.0 : 0.0) * beside;
  force.q1 += (deep_b ? 1.0 : 0.0) * beside;
  force.p1 -= (deep_b ? 0.0 : 1.0) * beside;
  force.q2 += (deep_b ? 0.0 : 1.0) * beside;
  add_couple_of_frame(force, at, face);
  const Vec2 turn_e = by_c * f - by_s * perp(f), turn_f = by_c * e + by_s * perp(e);
  force.p2 += turn_e;
  force.p1 -= turn_e;
  force.q2 += turn_f;
  force.q1 -= turn_f;
  return face;
}

/// Along the face an initial stress does nothing at the start, though the closure that it locks in
/// stores energy by the length of the overlap: the forces on what bounds the ends (N, along t) that
/// take so much away from those of the gradient, k o^2/2, or all that there is.
EDDA_INLINE FaceEnds held_at_bounds(const Face& face, const FacePair& pair) {
  const double half = 0.5 * face.gate * pair.stiffness;
  const FaceEnds locked{half * pair.offset.a * pair.offset.a, half * pair.offset.b * pair.offset.b};
  return {-smaller(locked.a, larger(-face.along.a, 0.0)),
          smaller(locked.b, larger(face.along.b, 0.0))};
}

/// What acts at the ends beside the pressure, N: T along t on the second edge, against it on the
/// first, N across the edge that the corner there is pressed against, and forces along t on what
/// bounds the ends.
EDDA_INLINE CornerForces end_forces(const FacePoints& at, const Face& face, FaceEnds normal,
                                    FaceEnds shear, FaceEnds bounds = {}) {
  const Vec2 t = face.t, n = outward_normal(t);
  CornerForces force;
  add_at(force, face.xi.a, face.eta.a, normal.a * (n - face.slope.a * t) + shear.a * t);
  add_at(force, face.xi.b, face.eta.b, normal.b * (n - face.slope.b * t) + shear.b * t);
  push_bounds(force, face.of_first, face.t, bounds);
  add_couple_of_frame(force, at, face);
  return force;
}

}  // namespace edda
