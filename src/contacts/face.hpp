// The contact of two blocks: a face, an edge of one against an opposed edge of another. It is the
// joint element of Goodman, Taylor and Brekke (1968), extended to large displacements. Theory,
// sections 4.1 to 4.6 (docs/theory.md); docs/contacts.md has the element in full.
//
// Notation. Edge e = p1p2 of the first block and edge f = q1q2 of the second; both blocks lie on
// the left of their edges.
//   E = p2 - p1 and F = q2 - q1, over their lengths at the start. Frame t = (E - F)/|E - F|, which
//   lies between the two edges, and n = (t.y, -t.x), which points out of the first block.
//   s, y: coordinates along t and n from p1. theta: angle between the edges, 0 where they are
//   antiparallel. Overlap [sa, sb] of length L = sb - sa; each of its ends is bounded by a corner.
//   Where two corners at s and s' pass each other within r, about (da^2 + db^2)^(1/2)/3, the bound
//   passes from one to the other smoothly: sb = min(s, s') - (r - |s - s'|)^2/(4 r), and sa is the
//   maximum plus the same. The ends lie at the fractions xi of e (from p1 to p2) and eta of f (from
//   q2 to q1). The closures there are da and db (m, > 0: pressed together), linear in between;
//   each is the drawn closure plus the locked closure o (FacePair::offset).
// Stored energy  U = w W k L phi(da, db),  phi = phi_exact + b (phi_ends - phi_exact):
//   phi_exact = 1/(2 L) Int max(d, 0)^2 ds        the law of a joint with a measured stiffness;
//   phi_ends  = (max(da, 0)^2 + max(db, 0)^2)/4   the integral taken at the ends (trapezoidal
//                                                 rule): a corner that leans on an edge has its
//                                                 whole spring;
//   b  corner weight, 0 for a measured stiffness; for a penalty it is 1 where the edge of a leaning
//      corner lies flat, and 0 where the corner's other edge lies flat;
//   w  aspect gate, which fades faces whose closure is large against L;
//   W  angle gate, which fades faces whose edges are at a large angle to each other.
// The formulas of phi are those of a face without tension; one that carries tension has no max.
// Forces are the exact negative gradient of U: they sum to zero and have no moment.
#pragma once

#include "contacts/face_frame.hpp"

namespace edda {

/// Forces on the corners, N.
struct CornerForces {
  Vec2 p1, p2, q1, q2;
};
/// Writes them as eight numbers, x and y of each corner.
EDDA_INLINE void put(double* to, const CornerForces& f) {
  to[0] = f.p1.x;
  to[1] = f.p1.y;
  to[2] = f.p2.x;
  to[3] = f.p2.y;
  to[4] = f.q1.x;
  to[5] = f.q1.y;
  to[6] = f.q2.x;
  to[7] = f.q2.y;
}

/// Components of the forces on the corners along t and n, N.
struct FrameForces {
  double p1t = 0.0, p1n = 0.0, p2t = 0.0, p2n = 0.0, q1t = 0.0, q1n = 0.0, q2t = 0.0, q2n = 0.0;
};

/// Geometry, energy and normal forces of a face at given positions of its corners.
struct Face {
  Vec2 t;
  double inverse_e = 0.0,
         inverse_f = 0.0;   ///< rotation of t per motion of a corner of e (of f) along n, 1/m
  double length = 0.0;      ///< L, m; it exists where overlaps() says so
  double cohesive = 0.0;    ///< length on which cohesion acts, m: w W L times flush_part()
  FaceEnds drawn;           ///< drawn closures at the ends, m
  FaceEnds closure;         ///< da and db, m
  FaceEnds xi, eta;         ///< positions of the ends along e and f, as fractions
  double gate = 0.0;        ///< w W
  double angle_gate = 0.0;  ///< W
  double share = 0.0;       ///< b
  double energy = 0.0;      ///< U, J
  FaceEnds normal;          ///< w W k L dphi/dd of each end: the normal force there, N
  double slope = 0.0;       ///< dy/ds of the edge on which a corner of the other presses
  FaceEnds along;           ///< dU/dsa and dU/dsb at fixed edges and fixed r, N
  FaceEnds of_first;        ///< weight with which each end follows the corner of e
  FrameForces pressure;     ///< forces of the normal pressure without the couples of on_corners()
  CornerForces force;       ///< forces of the normal pressure, couples included
};

/// Navier's tensile stress of the outer fibre, -N/L + 6 |M|/L^2 with M = (Na - Nb) L/2, times L, N:
/// with stresses linear along the bond, by whichever rule the element integrates them.
EDDA_INLINE double outer_tension(FaceEnds normal) {
  return 2.0 * larger(normal.a, normal.b) - 4.0 * smaller(normal.a, normal.b);
}

/// Adds the force with the components t and n at the fraction eta of f, and its reaction at the
/// fraction xi of e.
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

/// Adds the forces f along t on the corners that bound the ends. of_first: parts of f.a and f.b
/// that act on p1 and p2; the rest acts on q2 and q1.
EDDA_INLINE void push_bounds(FrameForces& on, FaceEnds of_first, FaceEnds f) {
  on.p1t += of_first.a * f.a;
  on.q2t += (1.0 - of_first.a) * f.a;
  on.p2t += of_first.b * f.b;
  on.q1t += (1.0 - of_first.b) * f.b;
}

/// Forces on the corners in x and y. `on` are those at a fixed direction of the frame, and have a
/// moment. The frame rotates with both edges; the gradient of U therefore has a couple on each
/// edge, too, and with these couples no moment remains. c: the corners in the frame.
EDDA_INLINE CornerForces on_corners(const FrameForces& on, const EdgeCoordinates& c,
                                    const Face& face) {
  // Of the force that turns t towards n.
  const double moment = c.s2 * on.p2n - c.y2 * on.p2t + (c.r1 * on.q1n - c.z1 * on.q1t) +
                        (c.r2 * on.q2n - c.z2 * on.q2t);
  const double e = moment * face.inverse_e, f = moment * face.inverse_f;
  const Vec2 t = face.t, n = outward_normal(t);
  return {on.p1t * t + (on.p1n + e) * n, on.p2t * t + (on.p2n - e) * n,
          on.q1t * t + (on.q1n - f) * n, on.q2t * t + (on.q2n + f) * n};
}

/// Aspect gate w with its derivatives.
struct AspectGate {
  SmoothStep part{1.0, 0.0};  ///< w, and its derivative with respect to the argument of S
  double by_length = 0.0;     ///< dw/dL, 1/m
  double per_deepest = 0.0;   ///< 1/d*, the inverse of the larger closure (gated_closure()), 1/m
  bool deep_b = false;        ///< the larger closure is that of end b
};
template <Formulas use>
EDDA_INLINE AspectGate aspect_gate(FaceEnds drawn, double length, const FacePair& pair) {
  AspectGate w;
  if constexpr (use != Formulas::plain) {
    const FaceEnds gated = gated_closure(drawn.a, drawn.b, pair);
    const double deepest = larger(gated.a, gated.b);
    w.deep_b = gated.b >= gated.a;
    const bool fades = (deepest > 0.0) & !carries_tension<use>(pair);
    w.per_deepest = 1.0 / (fades ? deepest : 1.0);
    w.part =
        smooth_step(fades ? (length * w.per_deepest - aspect_from) * (1.0 / aspect_range) : 1.0);
  }
  w.by_length = w.part.slope * (1.0 / aspect_range) * w.per_deepest;
  return w;
}

/// Cosine and sine of the angle theta between the edges, times the lengths of both.
struct EdgeAngle {
  double cosine, sine;
};

/// Corner weight b of the face: that of the corner which bounds the end of larger closure, with its
/// derivatives. Another corner near that one counts in it, too, so that b does not jump as they
/// pass each other.
struct EndWeight {
  double value, by_c, by_tilt;  ///< b, and its derivatives with respect to the cosine and to the
                                ///< absolute value of the sine of EdgeAngle
  double by_past = 0.0;         ///< with respect to -|past|, 1/m
  double past;                  ///< m: distance of the two corners at that end along t, signed
};
template <Formulas use>
EDDA_INLINE EndWeight end_weight(const EdgeGeometry& o, const OverlapEnds& v, const FacePair& pair,
                                 FaceEnds closure, EdgeAngle angle) {
  const bool deep_b = closure.b >= closure.a;
  const double c = angle.cosine, tilt = std::abs(angle.sine);
  const bool by_p = (deep_b & v.b_by_p) | (!deep_b & v.a_by_p);
  const Vec2 turn_p = either(deep_b, pair.turn_p2, pair.turn_p1),
             turn_q = either(deep_b, pair.turn_q1, pair.turn_q2);
  CornerWeight mean = corner_weight(either(by_p, turn_p, turn_q), c, tilt);
  const double past = deep_b ? o.s2 - o.r1 : -o.r2;
  double by_passing = 0.0;
  if constexpr (use != Formulas::plain) {
    const CornerWeight other = corner_weight(either(by_p, turn_q, turn_p), c, tilt);
    const SmoothStep passing = smooth_step(1.0 - std::abs(past) * v.per_passing);
    const bool more = other.value > mean.value;
    const double mixed = more ? passing.value : 0.0;
    by_passing = more ? (other.value - mean.value) * passing.slope * v.per_passing : 0.0;
    mean.by_c += mixed * (other.by_c - mean.by_c);
    mean.by_s += mixed * (other.by_s - mean.by_s);
    mean.value += mixed * (other.value - mean.value);
  }
  return {pair.ends * mean.value, pair.ends * mean.by_c, pair.ends * mean.by_s,
          pair.ends * by_passing, past};
}

/// Derivatives of U with respect to L, to the closures da and db, to the cosine and the sine of
/// EdgeAngle, and to EndWeight::past.
struct EnergySlopes {
  double by_length, by_a, by_b, by_c, by_s, by_past;
};
/// U = w W k L phi and the normal forces of a face with known overlap and closures (theory 4.2).
template <Formulas use>
EDDA_INLINE EnergySlopes store_energy(Face& face, const EdgeGeometry& o, const OverlapEnds& v,
                                      const FacePair& pair, const AspectGate& w, EdgeAngle angle) {
  const bool carries = carries_tension<use>(pair);
  const double da = face.closure.a, db = face.closure.b;
  const SmoothStep by_aspect = w.part;
  const double along = (o.cosine - pair.gate_from) * pair.gate_scale;
  SmoothStep by_angle{at_most_one(positive_part(along)), 0.0};
  if constexpr (use != Formulas::plain) by_angle = smooth_step(along);
  const EndWeight share = end_weight<use>(o, v, pair, face.closure, angle);
  const ClosurePotential exact = exact_potential(da, db, carries),
                         ends = potential_at_ends(da, db, carries);
  const double gain = ends.value - exact.value;
  const double exists = v.exists ? 1.0 : 0.0;
  const double gate = exists * by_aspect.value * by_angle.value;
  const double whole = exists * pair.stiffness * face.length;
  const double phi = exact.value + share.value * gain;
  face.gate = gate;
  face.angle_gate = exists * by_angle.value;
  face.cohesive = gate * positive_part(face.length) * flush_part(o.cosine);
  face.share = share.value;
  face.energy = gate * whole * phi;
  face.normal = {gate * whole * (exact.by_a + share.value * (ends.by_a - exact.by_a)),
                 gate * whole * (exact.by_b + share.value * (ends.by_b - exact.by_b))};

  const double stored = whole * phi, angle_gate = face.angle_gate;
  const double by_share = gate * whole * gain;
  EnergySlopes u{gate * pair.stiffness * phi,
                 face.normal.a,
                 face.normal.b,
                 by_share * share.by_c,
                 by_share * (angle.sine < 0.0 ? -share.by_tilt : share.by_tilt),
                 0.0};
  if constexpr (use != Formulas::plain) {
    u.by_length += angle_gate * stored * w.by_length;
    const double by_deepest = -angle_gate * stored * w.by_length * face.length * w.per_deepest;
    u.by_a += w.deep_b ? 0.0 : by_deepest;
    u.by_b += w.deep_b ? by_deepest : 0.0;
    const double inverse_lengths = pair.inverse_e * pair.inverse_f;
    u.by_c += by_aspect.value * stored * by_angle.slope * pair.gate_scale * inverse_lengths;
    u.by_past = by_share * (share.past < 0.0 ? share.by_past : -share.by_past);
  }
  return u;
}

/// The part of the forces that follows from the derivatives with respect to L and to the closures:
/// forces normal to either edge at sa and sb, and at la and lb, where the closures are taken on
/// which r depends; and forces along t on the corners that bound these places.
template <Formulas use>
EDDA_INLINE void press(Face& face, const EdgeGeometry& o, const OverlapEnds& v,
                       const EnergySlopes& u) {
  const double by_sa = u.by_a * o.closure_slope - u.by_length,
               by_sb = u.by_b * o.closure_slope + u.by_length;
  double by_corner_a = 0.0, by_corner_b = 0.0;
  double pressed = u.by_a + u.by_b, weighted = u.by_a * v.sa + u.by_b * v.sb;
  if constexpr (use != Formulas::plain) {
    const double by_reach = by_sa * v.pass_a.by_reach - by_sb * v.pass_b.by_reach;
    by_corner_a = by_reach * v.reach.by_a;
    by_corner_b = by_reach * v.reach.by_b;
    pressed += by_corner_a + by_corner_b;
    weighted += by_corner_a * v.la + by_corner_b * v.lb;
  }
  const double on_p2 = weighted * o.per_e, on_q1 = (weighted - pressed * o.r2) * o.per_f;
  const double on_p1 = pressed - on_p2, on_q2 = pressed - on_q1;
  FrameForces& on = face.pressure;
  on = {o.slope_e * on_p1,  -on_p1, o.slope_e * on_p2,  -on_p2,
        -o.slope_f * on_q1, on_q1,  -o.slope_f * on_q2, on_q2};
  face.along = {by_sa, by_sb};
  face.of_first = {v.a_by_p ? 1.0 : 0.0, v.b_by_p ? 1.0 : 0.0};
  if constexpr (use != Formulas::plain) {
    push_bounds(on, of_first(v.near_a, v.near_b, v.a_by_p, v.b_by_p),
                {-o.closure_slope * by_corner_a, -o.closure_slope * by_corner_b});
    face.of_first = of_first(v.pass_a, v.pass_b, v.a_by_p, v.b_by_p);
  }
  push_bounds(on, face.of_first, {-by_sa, -by_sb});
  // Of the corner at the end of larger drawn closure; where the edges are parallel both slopes are
  // 0, and nothing jumps as the other end becomes the deeper one.
  const bool deep_b = o.closure_slope >= 0.0;
  const double by_first = deep_b ? face.of_first.b : face.of_first.a;
  face.slope = by_first * o.slope_f + (1.0 - by_first) * o.slope_e;
}

/// The part that follows from the derivatives with respect to the cosine and the sine of EdgeAngle:
/// couples on the edges e = p2 - p1 and f = q2 - q1, with the force by_c f + by_s perp(f) on p2 and
/// by_c e - by_s perp(e) on q2 and the opposite forces on p1 and q1, perp(v) = (v.y, -v.x).
EDDA_INLINE void rotate_edges(FrameForces& on, const EdgeGeometry& o, double by_c, double by_s) {
  const double ey = o.y2, fs = o.r2 - o.r1, fy = o.z2 - o.z1;
  const double turn_et = by_c * fs - by_s * fy, turn_en = by_c * fy + by_s * fs;
  const double turn_ft = by_c * o.s2 + by_s * ey, turn_fn = by_c * ey - by_s * o.s2;
  on.p1t -= turn_et;
  on.p1n -= turn_en;
  on.p2t += turn_et;
  on.p2n += turn_en;
  on.q1t -= turn_ft;
  on.q1n -= turn_fn;
  on.q2t += turn_ft;
  on.q2n += turn_fn;
}

/// The part that follows from the derivative with respect to EndWeight::past, the distance along t
/// of the two corners at the end of larger closure: (p2 - q1).t at end b, (p1 - q2).t at end a.
EDDA_INLINE void push_past(FrameForces& on, double by_past, bool deep_b) {
  const double past_b = deep_b ? by_past : 0.0, past_a = by_past - past_b;
  on.p2t -= past_b;
  on.q1t += past_b;
  on.p1t -= past_a;
  on.q2t += past_a;
}

/// The face of two edges.
template <Formulas use>
EDDA_INLINE Face face_between(const EdgeGeometry& o, const OverlapEnds& v, const FacePair& pair) {
  Face face;
  const EdgeAngle angle{o.length_cosine, o.length_sine};
  face.t = {o.tx, o.ty};
  face.inverse_e = pair.inverse_e * o.per_base;
  face.inverse_f = pair.inverse_f * o.per_base;
  face.length = v.sb - v.sa;
  face.xi = {v.sa * o.per_e, v.sb * o.per_e};
  face.eta = {(v.sa - o.r2) * o.per_f, (v.sb - o.r2) * o.per_f};
  face.drawn = {o.closure_at_0 + o.closure_slope * v.sa, o.closure_at_0 + o.closure_slope * v.sb};
  face.closure = closed_by(face.drawn, o, pair);
  const AspectGate w = aspect_gate<use>(face.drawn, face.length, pair);
  const EnergySlopes u = store_energy<use>(face, o, v, pair, w, angle);
  press<use>(face, o, v, u);
  if constexpr (use != Formulas::plain)
    push_past(face.pressure, u.by_past, face.closure.b >= face.closure.a);
  rotate_edges(face.pressure, o, u.by_c, u.by_s);
  face.force = on_corners(face.pressure, o.corners(), face);
  return face;
}

template <Formulas use = Formulas::all>
EDDA_INLINE Face face_between(const EdgeGeometry& o, const FacePair& pair) {
  return face_between<use>(o, overlap_of<use>(o, pair), pair);
}
template <Formulas use = Formulas::all>
EDDA_INLINE Face face_between(const FacePoints& at, const FacePair& pair) {
  return face_between<use>(geometry_of_edges(at, pair), pair);
}

/// Forces (N, along t) on the corners that bound the ends, where a closure o is locked in. The
/// energy of o grows with the length of the overlap, so the gradient pushes these corners by
/// k o^2/2 along the face, although the initial stress has no such force. The forces returned here
/// cancel that push, as far as there is one.
EDDA_INLINE FaceEnds locked_closure_forces(const Face& face, const FacePair& pair) {
  const double half = 0.5 * face.gate * pair.stiffness;
  const FaceEnds locked{half * pair.offset.a * pair.offset.a, half * pair.offset.b * pair.offset.b};
  return {-smaller(locked.a, positive_part(-face.along.a)),
          smaller(locked.b, positive_part(face.along.b))};
}

/// Adds the forces at the ends beside the pressure, N: T along the edge on which a corner presses,
/// T (t + slope n) on f and its reaction on e; N normal to it, N (n - slope t); and forces along t
/// on the corners that bound the ends.
EDDA_INLINE void add_ends(FrameForces& on, const Face& face, FaceEnds normal, FaceEnds shear,
                          FaceEnds bounds = {}) {
  const auto add = [&](double xi, double eta, double along, double across) {
    add_at(on, xi, eta, along - face.slope * across, across + face.slope * along);
  };
  add(face.xi.a, face.eta.a, shear.a, normal.a);
  add(face.xi.b, face.eta.b, shear.b, normal.b);
  push_bounds(on, face.of_first, bounds);
}
/// The same for the shear forces alone.
EDDA_INLINE void add_shear(FrameForces& on, const Face& face, FaceEnds shear) {
  const double whole = shear.a + shear.b;
  const double on_p2 = face.xi.a * shear.a + face.xi.b * shear.b;
  const double on_q1 = face.eta.a * shear.a + face.eta.b * shear.b;
  const double on_p1 = whole - on_p2, on_q2 = whole - on_q1;
  on.p1t -= on_p1;
  on.p2t -= on_p2;
  on.q1t += on_q1;
  on.q2t += on_q2;
  on.p1n -= face.slope * on_p1;
  on.p2n -= face.slope * on_p2;
  on.q1n += face.slope * on_q1;
  on.q2n += face.slope * on_q2;
}
EDDA_INLINE CornerForces end_forces(const FacePoints& at, const Face& face, FaceEnds normal,
                                    FaceEnds shear) {
  FrameForces on;
  add_ends(on, face, normal, shear);
  return on_corners(on, coordinates_in({face.t, 0.0}, at), face);
}

}  // namespace edda
