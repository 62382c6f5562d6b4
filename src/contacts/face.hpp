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

#include "blocks/block_set.hpp"
#include "contacts/face_parts.hpp"

namespace edda {

/// Corners of the two edges, m.
struct FacePoints {
  Vec2 p1, p2, q1, q2;
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
  Id p1 = 0, p2 = 0, q1 = 0, q2 = 0;                          ///< the corners
  const double *turn_cosine = nullptr, *turn_sine = nullptr;  ///< of exterior angles, by corner

  Vec2 turn(Id corner) const { return {turn_cosine[corner], turn_sine[corner]}; }
};

/// Forces on the corners, N.
struct CornerForces {
  Vec2 p1, p2, q1, q2;
};

/// Forces on the corners along t and n, N.
struct FrameForces {
  double p1t = 0.0, p1n = 0.0, p2t = 0.0, p2n = 0.0, q1t = 0.0, q1n = 0.0, q2t = 0.0, q2n = 0.0;
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
  FrameForces pressure;     ///< forces of the normal pressure, but for the couples of the frame
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

/// Adds (t, n) at the part eta of the second edge, and its opposite at the part xi of the first.
EDDA_INLINE void add_at(FrameForces& on, double xi, double eta, double t, double n) {
  on.p1t -= (1.0 - xi) * t;
  on.p1n -= (1.0 - xi) * n;
  on.p2t -= xi * t;
  on.p2n -= xi * n;
  on.q1t += eta * t;
  on.q1n += eta * n;
  on.q2t += (1.0 - eta) * t;
  on.q2n += (1.0 - eta) * n;
}

/// Adds forces along t on what bounds the ends.
EDDA_INLINE void push_bounds(FrameForces& on, FaceEnds of_first, FaceEnds f) {
  on.p1t += of_first.a * f.a;
  on.q2t += (1.0 - of_first.a) * f.a;
  on.p2t += of_first.b * f.b;
  on.q1t += (1.0 - of_first.b) * f.b;
}

/// Forces on the corners. The frame goes with both edges: their couples are added, which leave no
/// moment.
EDDA_INLINE CornerForces on_corners(const FrameForces& on, const FacePoints& at, const Face& face) {
  const Vec2 t = face.t, n = outward_normal(t);
  CornerForces force{on.p1t * t + on.p1n * n, on.p2t * t + on.p2n * n, on.q1t * t + on.q1n * n,
                     on.q2t * t + on.q2n * n};
  const Vec2 p = at.p1;
  const double moment =
      cross(at.p2 - p, force.p2) + cross(at.q1 - p, force.q1) + cross(at.q2 - p, force.q2);
  const Vec2 e = (moment * face.inverse_e) * n, f = (moment * face.inverse_f) * n;
  force.p1 -= e;
  force.p2 += e;
  force.q1 += f;
  force.q2 -= f;
  return force;
}

/// Where two edges stand to each other.
struct Opposition {
  double tx, ty;            ///< t
  double per_base;          ///< 1/|E - F|
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
  const double apart = norm(g), per_base = 1.0 / (apart > 0.0 ? apart : 1.0);
  const Vec2 t = per_base * g, n = outward_normal(t);
  const Vec2 to_q1 = at.q1 - at.p1, to_q2 = at.q2 - at.p1;
  const double s2 = dot(e, t), y2 = dot(e, n);
  const double r1 = dot(to_q1, t), z1 = dot(to_q1, n), r2 = dot(to_q2, t), z2 = dot(to_q2, n);
  const bool opposed = (s2 > 0.0) & (r1 > r2);
  const double across_e = opposed ? s2 : 1.0, across_f = opposed ? r1 - r2 : 1.0;
  const double per_both = 1.0 / (across_e * across_f);
  const double per_e = across_f * per_both, per_f = across_e * per_both;
  const double slope_e = y2 * per_e, slope_f = (z1 - z2) * per_f;
  const double apart_0 = -(z2 - slope_f * r2),
               cosine = -dot(e, f) * (pair.inverse_e * pair.inverse_f);
  return {t.x,
          t.y,
          per_base,
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

/// Whether what is rare in U does not matter: no corners pass each other, the edges lie along each
/// other (W = 1), nothing is deep (w = 1), nothing is locked in, no tension is borne; or there is
/// no overlap.
EDDA_INLINE bool is_plain(const Opposition& o, const FacePair& pair) {
  const double along = (o.cosine - pair.gate_from) * pair.gate_scale, length = o.mb - o.ma;
  const bool absent = (length <= 0.0) | (along <= 0.0) | (o.s2 <= 0.0) | (o.r1 <= o.r2);
  const double nearest = smaller(std::abs(o.r2), std::abs(o.s2 - o.r1));  // corner to corner
  const bool apart = nearest >= pair.passing;
  const double deepest = larger(o.apart_0 + o.steeper * o.ma, o.apart_0 + o.steeper * o.mb);
  constexpr double shallow = 1.001 * (aspect_from + aspect_range);
  const bool rigid = apart & (along >= 1.0) & (length >= shallow * deepest);
  const bool unstressed = (pair.pulls == 0.0) & (pair.offset.a == 0.0) & (pair.offset.b == 0.0);
  return unstressed & (absent | rigid);
}

/// plain: where is_plain() holds what it tells is left out, to the same bits.
template <bool plain = false>
EDDA_INLINE Face face_between(const FacePoints& at, const FacePair& pair, const Opposition& o) {
  Face face;
  const Vec2 e = at.p2 - at.p1, f = at.q2 - at.q1, t{o.tx, o.ty};
  const double s2 = o.s2, r1 = o.r1, r2 = o.r2, per_e = o.per_e, per_f = o.per_f, ma = o.ma,
               mb = o.mb, slope_e = o.slope_e, slope_f = o.slope_f, apart_0 = o.apart_0,
               steeper = o.steeper, cosine = o.cosine;
  const double c = -dot(e, f), s = cross(f, e);      // of theta, times both lengths
  const bool a_by_p = r2 <= 0.0, b_by_p = s2 <= r1;  // p1 and p2 bound the overlap
  const bool pulls = plain ? false : pair.pulls != 0.0;

  // Corners that pass each other
  double sa = ma, sb = mb, la = ma, lb = mb, per_passing = 0.0;
  const bool opposed = (s2 > 0.0) & (r1 > r2) & (cosine > pair.gate_from);
  bool lives = (mb > ma) & opposed;
  CornersPassing near_a, near_b, pass_a, pass_b;
  PassingReach wide;
  if constexpr (!plain) {
    const double furthest = furthest_reach * pair.passing, per_furthest = 1.0 / furthest;
    per_passing = furthest_reach * per_furthest;
    near_a = corners_passing(-r2, furthest, per_furthest);
    near_b = corners_passing(s2 - r1, furthest, per_furthest);
    const double beyond = 0.25 * furthest;
    la = ma + near_a.drawn_in - beyond;
    lb = mb - near_b.drawn_in + beyond;
    const double corner_a = apart_0 + steeper * la + pair.offset.a;
    const double corner_b = apart_0 + steeper * lb + pair.offset.b;
    wide = passing_reach(pulls ? corner_a : larger(corner_a, 0.0),
                         pulls ? corner_b : larger(corner_b, 0.0), furthest, per_furthest);
    const double per_reach = 1.0 / (wide.reach > 0.0 ? wide.reach : 1.0);
    pass_a = corners_passing(-r2, wide.reach, per_reach);
    pass_b = corners_passing(s2 - r1, wide.reach, per_reach);
    const double from = ma + pass_a.drawn_in, to = mb - pass_b.drawn_in;
    lives = (to > from) & opposed;
    sa = lives ? from : ma;
    sb = lives ? to : mb;
  }
  face.t = t;
  face.inverse_e = pair.inverse_e * o.per_base;
  face.inverse_f = pair.inverse_f * o.per_base;
  face.length = sb - sa;
  face.xi = {sa * per_e, sb * per_e};
  face.eta = {(sa - r2) * per_f, (sb - r2) * per_f};
  const double drawn_a = apart_0 + steeper * sa, drawn_b = apart_0 + steeper * sb;
  const double da = drawn_a + pair.offset.a, db = drawn_b + pair.offset.b;
  face.closure = {da, db};

  // W, of the angle theta between the edges
  const double inverse_lengths = pair.inverse_e * pair.inverse_f;
  const double along = (cosine - pair.gate_from) * pair.gate_scale;
  SmoothStep by_angle{smaller(larger(along, 0.0), 1.0), 0.0};
  if constexpr (!plain) by_angle = smooth_step(along);

  // w
  const bool deep_b = db >= da;
  SmoothStep by_aspect{1.0, 0.0};
  double per_deepest = 0.0;
  bool gated_deep_b = false;
  if constexpr (!plain) {
    const FaceEnds gated = gated_closure(drawn_a, drawn_b, pair);
    const double deepest = larger(gated.a, gated.b);
    gated_deep_b = gated.b >= gated.a;
    const bool fades = (deepest > 0.0) & !pulls;
    per_deepest = 1.0 / (fades ? deepest : 1.0);
    by_aspect =
        smooth_step(fades ? (face.length * per_deepest - aspect_from) * (1.0 / aspect_range) : 1.0);
  }
  const double aspect_slope = by_aspect.slope * (1.0 / aspect_range) * per_deepest;  // dw/dL

  // b, of the corner that bounds the deeper end; one that is about to pass it counts, too
  const Id at_a = a_by_p ? pair.p1 : pair.q2, at_b = b_by_p ? pair.p2 : pair.q1;
  const double tilt = std::abs(s);
  CornerShare mean = corner_share(pair.turn(deep_b ? at_b : at_a), c, tilt);
  const double past = deep_b ? s2 - r1 : -r2;  // of the first block's corner beyond the second's
  double by_passing = 0.0;
  if constexpr (!plain) {
    const Id past_a = a_by_p ? pair.q2 : pair.p1, past_b = b_by_p ? pair.q1 : pair.p2;
    const CornerShare other = corner_share(pair.turn(deep_b ? past_b : past_a), c, tilt);
    const SmoothStep passing = smooth_step(1.0 - std::abs(past) * per_passing);
    const bool more = other.value > mean.value;
    const double mixed = more ? passing.value : 0.0;
    by_passing = more ? (other.value - mean.value) * passing.slope * per_passing : 0.0;
    mean.by_c += mixed * (other.by_c - mean.by_c);
    mean.by_s += mixed * (other.by_s - mean.by_s);
    mean.value += mixed * (other.value - mean.value);
  }
  const double share = pair.ends * mean.value, share_by_c = pair.ends * mean.by_c,
               share_by_tilt = pair.ends * mean.by_s, share_by_past = pair.ends * by_passing;

  const ClosurePotential exact = exact_potential(da, db, pulls),
                         ends = potential_at_ends(da, db, pulls);
  const double gain = ends.value - exact.value;
  const double exists = lives ? 1.0 : 0.0;
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
  double by_length = gate * pair.stiffness * phi, by_a = face.normal.a, by_b = face.normal.b;
  const double by_share = gate * whole * gain;
  double by_c = by_share * share_by_c, by_past = 0.0;
  const double by_s = by_share * (s < 0.0 ? -share_by_tilt : share_by_tilt);
  if constexpr (!plain) {
    by_length += angle_gate * stored * aspect_slope;
    const double by_deepest = -angle_gate * stored * aspect_slope * face.length * per_deepest;
    by_a += gated_deep_b ? 0.0 : by_deepest;
    by_b += gated_deep_b ? by_deepest : 0.0;
    by_c += by_aspect.value * stored * by_angle.slope * pair.gate_scale * inverse_lengths;
    by_past = by_share * (past < 0.0 ? share_by_past : -share_by_past);
  }

  // dU/dsa and dU/dsb, and dU/dd of the corners that the reach goes by
  const double by_sa = by_a * steeper - by_length, by_sb = by_b * steeper + by_length;
  double by_corner_a = 0.0, by_corner_b = 0.0;

  // The pressures by_a and by_b at the ends and by_corner at the corners stand across either edge.
  face.slope = {a_by_p ? slope_f : slope_e, b_by_p ? slope_f : slope_e};
  double pressed = by_a + by_b, weighted = by_a * sa + by_b * sb;
  if constexpr (!plain) {
    const double by_reach = by_sa * pass_a.by_reach - by_sb * pass_b.by_reach;
    by_corner_a = by_reach * wide.by_a;
    by_corner_b = by_reach * wide.by_b;
    pressed += by_corner_a + by_corner_b;
    weighted += by_corner_a * la + by_corner_b * lb;
  }
  const double on_p2 = weighted * per_e, on_q1 = (weighted - pressed * r2) * per_f;
  const double on_p1 = pressed - on_p2, on_q2 = pressed - on_q1;
  FrameForces& on = face.pressure;
  on = {slope_e * on_p1,  -on_p1, slope_e * on_p2,  -on_p2,
        -slope_f * on_q1, on_q1,  -slope_f * on_q2, on_q2};
  face.along = {by_sa, by_sb};
  face.of_first = {a_by_p ? 1.0 : 0.0, b_by_p ? 1.0 : 0.0};
  if constexpr (!plain) {
    push_bounds(on, of_first(near_a, near_b, a_by_p, b_by_p),
                {-steeper * by_corner_a, -steeper * by_corner_b});
    face.of_first = of_first(pass_a, pass_b, a_by_p, b_by_p);
  }
  push_bounds(on, face.of_first, {-by_sa, -by_sb});
  if constexpr (!plain) {
    // past = (p2 - q1).t or (p1 - q2).t
    const double past_b = deep_b ? by_past : 0.0, past_a = by_past - past_b;
    on.p2t -= past_b;
    on.q1t += past_b;
    on.p1t -= past_a;
    on.q2t += past_a;
  }
  // theta: couples on the edges, by_c f - by_s perp(f) on e and by_c e + by_s perp(e) on f
  const double ey = slope_e * s2, fs = r2 - r1, fy = slope_f * fs;
  const double turn_et = by_c * fs - by_s * fy, turn_en = by_c * fy + by_s * fs;
  const double turn_ft = by_c * s2 + by_s * ey, turn_fn = by_c * ey - by_s * s2;
  on.p1t -= turn_et;
  on.p1n -= turn_en;
  on.p2t += turn_et;
  on.p2n += turn_en;
  on.q1t -= turn_ft;
  on.q1n -= turn_fn;
  on.q2t += turn_ft;
  on.q2n += turn_fn;
  face.force = on_corners(on, at, face);
  return face;
}

template <bool plain = false>
EDDA_INLINE Face face_between(const FacePoints& at, const FacePair& pair) {
  return face_between<plain>(at, pair, opposition_of(at, pair));
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
EDDA_INLINE void add_ends(FrameForces& on, const Face& face, FaceEnds normal, FaceEnds shear,
                          FaceEnds bounds = {}) {
  add_at(on, face.xi.a, face.eta.a, shear.a - face.slope.a * normal.a, normal.a);
  add_at(on, face.xi.b, face.eta.b, shear.b - face.slope.b * normal.b, normal.b);
  push_bounds(on, face.of_first, bounds);
}
EDDA_INLINE CornerForces end_forces(const FacePoints& at, const Face& face, FaceEnds normal,
                                    FaceEnds shear) {
  FrameForces on;
  add_ends(on, face, normal, shear);
  return on_corners(on, at, face);
}

}  // namespace edda
