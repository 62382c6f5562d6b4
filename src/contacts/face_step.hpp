// One step of a face: normal and shear forces, slip, work and dashpots, from the positions of its
// corners at n and n - 1 and its state at n - 1. Theory, sections 4.3 (shear and Coulomb's limit),
// 9.6 (dashpots) and 10.1 (work); notation: contacts/face.hpp. These are the formulas of the loops
// over all faces (base/vector_loop.hpp): they select and never branch, so that a processor can
// compute several faces at a time.
#pragma once

#include <cmath>

#include "base/vector_loop.hpp"
#include "blocks/masses.hpp"
#include "contacts/face_set.hpp"

namespace edda {

inline constexpr double unlimited_shear =
    1e300;  ///< N, limit of a bonded face: it fails as a whole

/// What a loop over the faces of a chunk reads and writes. x, y: positions at n; x1, y1: at n - 1.
struct FaceView : FaceProperties<const double*> {
  const Id *edge, *edge_end, *facing, *facing_end;
  const double *exterior_cosine, *exterior_sine;
  const double *x, *y, *x1, *y1;
  double noise;
  const double *point_inverse, *edge_inverse;  // inverse masses, 1/kg, for dashpots
  double step;                                 ///< from n - 1 to n, s
  const double *limit_a, *limit_b;             ///< N: those of ShearLimits, or null
  FaceFields<double*> now;
  FaceFields<const double*> before;
  double* force;
};

/// Relative displacement, in the last step, of the two material points that lie at each end now, m:
/// slip along the frame (theory, section 4.3), and closing normal to the edge on which the corner
/// there presses.
struct EndMotion {
  FaceEnds slip, closure;
};
EDDA_INLINE EndMotion motion_of(const Face& face, FaceEnds offset, const FacePoints& then) {
  // The frame at n - 1. That inverse_e and inverse_f have a common factor here does not matter.
  const Vec2 t = frame_of(then, face.inverse_e, face.inverse_f), n = outward_normal(t);
  const Vec2 a = from_point_of_e(then, face.xi.a, face.eta.a);
  const Vec2 b = from_point_of_e(then, face.xi.b, face.eta.b);
  const FaceEnds slip{-dot(a, t), -dot(b, t)};
  return {slip,
          {face.closure.a - offset.a + dot(a, n) + face.slope.a * slip.a,
           face.closure.b - offset.b + dot(b, n) + face.slope.b * slip.b}};
}

/// Shear force T = -spring u of one end, N, and its elastic slip u, m.
struct Shear {
  double force, slip;
};
/// Cuts the trial force to Coulomb's limit (N), and the trial slip with it (return mapping; theory,
/// section 4.3).
EDDA_INLINE Shear cut(double trial, double spring, double per_spring, double limit) {
  const double whole = -spring * trial;
  const double force = smaller(larger(whole, -limit), limit);
  return {force, force == whole ? trial : -force * per_spring};
}
EDDA_INLINE double inverse_of(double spring) {
  return 1.0 / (spring > 0.0 ? spring : 1.0);
}

/// Slip and shear of one end in the last step, for its energy balance. In the leapfrog's terms T_n
/// and T_{n-1} each do work over half of the step, on the material points at the end at n and at
/// n - 1, which are not quite the same.
struct SlipOfStep {
  double here;         ///< slip of the points at the end at n, m
  double there;        ///< slip of those that were there at n - 1, m
  double force, slip;  ///< T and u at n - 1
  double kept;         ///< fraction of u that remains when the overlap has grown (ShearSprings)
};
/// Energy that an end's shear spring has lost, J.
struct Lost {
  double friction, transfer;
};
/// The plastic slip u_tr - u_n dissipates spring (u_tr - u_n) (u_n + u_{n-1})/2 by friction
/// (theory, section 4.3); the rest of what is missing is `transfer`. Where the face has opened, all
/// that its spring had stored counts as friction.
EDDA_INLINE Lost lost(const Shear& now, double trial, double spring, const SlipOfStep& s,
                      bool touches) {
  const double all = -0.5 * (now.force * (s.here - now.slip) + s.force * (s.slip + s.there));
  const double slip_so_far = 0.5 * spring * (trial - now.slip) * (now.slip + s.kept * s.slip);
  const double friction = larger(touches ? slip_so_far : all, 0.0);
  return {friction, all - friction};
}

/// The shear springs follow the overlap where it has changed by more than this fraction of itself:
/// the length that it gains is free of stress, the length that it loses takes its part of the force
/// with it.
constexpr double least_length_change = 1e-4;

/// Whether decide_activity() must be called for the face: it has come into being, or it does not
/// act and is open now, or it stores energy for the first time. `on`: it exists; `drawn`: its drawn
/// closures; `stores`: it stores energy.
EDDA_INLINE bool needs_decision(const FaceView& c, bool on, FaceEnds drawn, bool stores,
                                std::size_t k) {
  const bool begins = on & (c.before.gate[k] == 0.0);
  const bool frees = on & (c.acts[k] == 0.0) & (larger(drawn.a, drawn.b) <= 0.0);
  const bool first = stores & (c.before.energy[k] == 0.0);
  return begins | frees | first;
}
/// The same, for the state in c.now.
EDDA_INLINE bool needs_decision(const FaceView& c, std::size_t k) {
  const FaceFields<double*>& m = c.now;
  return needs_decision(
      c, m.gate[k] > 0.0,
      {m.closure_a[k] - c.locked_closure_a[k], m.closure_b[k] - c.locked_closure_b[k]},
      m.energy[k] > 0.0, k);
}

/// Which ends are closed: 0 none, 1 end a, 2 end b, 3 both.
EDDA_INLINE double ends_closed(double da, double db, double noise) {
  return (da > noise ? 1.0 : 0.0) + (db > noise ? 2.0 : 0.0);
}

/// Forces of one face at step n, and what its chunk records of it.
struct FaceResult {
  CornerForces force;
  double needs_decision, switching;  ///< 1: yes; switching: see switches()
  double works;                      ///< 1: carries load, or did so at the step before
  double depth;                      ///< larger drawn closure, m; 0: carries nothing
  double rare;                       ///< 1: bonded, or is_plain() does not hold
};

/// One end of a face: its normal force, its elastic slip before Coulomb's limit, and the motion of
/// its points in the last step (EndMotion); of the closing only what came after they touched.
struct EndOfFace {
  double normal, trial, closing, slipping, xi, eta;
};
/// Forces at one end besides the pressure.
struct EndActs {
  Shear shear;
  double damping, shear_damping;  ///< of the dashpots across and along the face, N
};

/// Shear force under Coulomb's limit, |T| <= c L/2 + N tan(phi), and dashpots c = 2 zeta sqrt(p m)
/// with the spring p of the end and the mass m that it moves (theory, sections 4.3 and 9.6). The
/// force of the dashpot across the joint counts in Coulomb's limit and cannot make the end pull
/// unless the face carries tension; that of the dashpot along the joint stays within what the limit
/// leaves, and acts where the end sticks. `limits_given`: the limits are given (ShearLimits) and do
/// not follow from the normal force.
template <bool dashpots, bool limits_given, bool plain>
EDDA_INLINE EndActs act(const FaceView& c, const Face& face, const EndOfFace& end, double spring,
                        double per_spring, double cohesion, bool touches, const double* limits,
                        std::size_t k) {
  const double friction = c.friction[k];
  const bool bonded = plain ? false : c.bonded[k] > 0.0;
  const auto limit_under = [&](double normal) {
    if constexpr (limits_given) return limits[k];
    return bonded ? unlimited_shear : larger(cohesion + friction * normal, 0.0);
  };
  if constexpr (!dashpots) {
    return {cut(end.trial, spring, per_spring, limit_under(end.normal)), 0.0, 0.0};
  } else {
    const double inverse = inverse_mass_on_edge(c, c.edge[k], c.edge_end[k], end.xi) +
                           inverse_mass_on_edge(c, c.facing[k], c.facing_end[k], 1.0 - end.eta);
    const double mass = 1.0 / (inverse > 0.0 ? inverse : 1.0);
    const double across = 0.5 * c.stiffness[k] * c.acts[k] * larger(face.length, 0.0) * face.gate;
    const double whole =
        end.normal + 2.0 * c.zeta[k] * std::sqrt(across * mass) * end.closing / c.step;
    const double pushing = larger(whole, 0.0);
    const bool carries_tension = plain ? false : c.carries_tension[k] > 0.0;
    const bool carries = end.normal != 0.0;
    const double normal = carries ? (carries_tension ? whole : pushing) : 0.0;
    const double limit = limit_under(normal);
    const Shear shear = cut(end.trial, spring, per_spring, limit);
    const double along = -2.0 * c.shear_zeta[k] * std::sqrt(spring * mass) * end.slipping / c.step;
    const double within = larger(-limit - shear.force, smaller(limit - shear.force, along));
    const bool holds = touches & (shear.slip == end.trial);
    return {shear, normal - end.normal, holds ? within : 0.0};
  }
}

/// The shear springs of a face at a step, which follow its overlap (see `least_length_change`).
struct ShearSprings {
  double overlap;  ///< length that the two springs represent, m
  double kept;     ///< fraction of the elastic slip that remains: new length is free of stress
  double spring, per_spring;  ///< of each end, N/m, and its inverse
};
EDDA_INLINE ShearSprings shear_springs(const FaceView& c, const Face& face, bool touches,
                                       std::size_t k) {
  const double length = larger(face.length, 0.0), length_1 = c.before.overlap[k];
  const bool same = std::abs(length - length_1) <= least_length_change * length_1;
  const double overlap = same ? length_1 : length;
  const double kept = overlap > length_1 ? length_1 / (overlap > 0.0 ? overlap : 1.0) : 1.0;
  const double spring = touches ? 0.5 * c.shear_stiffness[k] * overlap * face.gate : 0.0;
  return {overlap, kept, spring, inverse_of(spring)};
}

/// Both ends of a face in a step, before Coulomb's limit.
struct EndsOfFace {
  EndOfFace a, b;
};
template <bool plain>
EDDA_INLINE EndsOfFace ends_of(const FaceView& c, const Face& face, const EndMotion& moved,
                               double kept, bool touches, std::size_t k) {
  const FaceFields<const double*>& old = c.before;
  const FaceEnds here = moved.slip;
  const double slip_1a = old.slip_a[k], slip_1b = old.slip_b[k];
  const double trial_a = touches ? kept * slip_1a + here.a : 0.0;
  const double trial_b = touches ? kept * slip_1b + here.b : 0.0;
  const bool carries_tension = plain ? false : c.carries_tension[k] > 0.0;
  const auto since_touch = [&](double closing, double d) {
    return carries_tension ? closing : smaller(closing, larger(d, 0.0));
  };
  const FaceEnds closing{since_touch(moved.closure.a, face.closure.a),
                         since_touch(moved.closure.b, face.closure.b)};
  return {{face.normal.a, trial_a, closing.a, here.a, face.xi.a, face.eta.a},
          {face.normal.b, trial_b, closing.b, here.b, face.xi.b, face.eta.b}};
}

/// Energy that the shear springs of both ends have lost in the step.
struct LostAtEnds {
  Lost a, b;
};
EDDA_INLINE LostAtEnds lost_at_ends(const FaceView& c, const FacePoints& at, const Face& face,
                                    const EndsOfFace& end, const Shear& a, const Shear& b,
                                    const ShearSprings& springs, bool touches, std::size_t k) {
  const FaceFields<const double*>& old = c.before;
  const double xi_a = old.xi_a[k], xi_b = old.xi_b[k], eta_a = old.eta_a[k], eta_b = old.eta_b[k];
  const FaceEnds there{dot(from_point_of_e(at, xi_a, eta_a), face.t),
                       dot(from_point_of_e(at, xi_b, eta_b), face.t)};
  const double spring = springs.spring, kept = springs.kept;
  return {lost(a, end.a.trial, spring,
               {end.a.slipping, there.a, old.shear_a[k], old.slip_a[k], kept}, touches),
          lost(b, end.b.trial, spring,
               {end.b.slipping, there.b, old.shear_b[k], old.slip_b[k], kept}, touches)};
}

/// Writes the state of the face at n.
EDDA_INLINE void write_face(const FaceView& c, const Face& face, const ShearSprings& springs,
                            const EndsOfFace& end, const Shear& a, const Shear& b, bool touches,
                            std::size_t k) {
  const FaceFields<double*>& m = c.now;
  const double length = larger(face.length, 0.0);
  m.closure_a[k] = face.closure.a;
  m.closure_b[k] = face.closure.b;
  m.energy[k] = face.energy;
  m.normal_a[k] = face.normal.a;
  m.normal_b[k] = face.normal.b;
  m.shear_a[k] = a.force;
  m.shear_b[k] = b.force;
  m.slip_a[k] = touches ? a.slip : 0.0;
  m.slip_b[k] = touches ? b.slip : 0.0;
  m.trial_a[k] = end.a.trial;
  m.trial_b[k] = end.b.trial;
  m.spring[k] = springs.spring;
  m.length[k] = length;
  m.cohesive[k] = face.cohesive;
  m.overlap[k] = touches ? springs.overlap : length;
  m.gate[k] = face.gate;
  m.xi_a[k] = face.xi.a;
  m.xi_b[k] = face.xi.b;
  m.eta_a[k] = face.eta.a;
  m.eta_b[k] = face.eta.b;
}

/// Writes forces and work of the dashpots: a force D_n does its work over (x_{n+1} - x_{n-1})/2,
/// half of it in the last step and half in the next one.
EDDA_INLINE void write_dashpots(const FaceView& c, const EndMotion& moved, const EndActs& a,
                                const EndActs& b, std::size_t k) {
  const FaceFields<double*>& m = c.now;
  const FaceFields<const double*>& old = c.before;
  const FaceEnds here = moved.slip;
  const auto taken = [&](double a_across, double b_across, double a_along, double b_along) {
    return 0.5 * (a_across * moved.closure.a + b_across * moved.closure.b - a_along * here.a -
                  b_along * here.b);
  };
  m.damping_a[k] = a.damping;
  m.damping_b[k] = b.damping;
  m.shear_damping_a[k] = a.shear_damping;
  m.shear_damping_b[k] = b.shear_damping;
  m.damping_work[k] = taken(a.damping, b.damping, a.shear_damping, b.shear_damping);
  m.damping_due[k] =
      taken(old.damping_a[k], old.damping_b[k], old.shear_damping_a[k], old.shear_damping_b[k]);
}

/// Work of the forces of ends_at_bounds() in the step, J.
EDDA_INLINE double work_of_bounds(const Face& face, FaceEnds bounds, const FacePoints& at,
                                  const FacePoints& then) {
  const auto along = [&](double part, Vec2 first, Vec2 second) {
    return dot(part * first + (1.0 - part) * second, face.t);
  };
  return bounds.a * along(face.of_first.a, at.p1 - then.p1, at.q2 - then.q2) +
         bounds.b * along(face.of_first.b, at.p2 - then.p2, at.q1 - then.q1);
}

/// Whether the face may need an activation factor (theory, section 6.2): it stored energy at n - 1,
/// and one of its ends opens or closes in this step or did so in the one before. Writes whether one
/// does in this step.
EDDA_INLINE bool switches(const FaceView& c, const Face& face, bool touches, std::size_t k) {
  const FaceFields<const double*>& old = c.before;
  const double closed = touches ? ends_closed(face.closure.a, face.closure.b, c.noise) : 0.0;
  const double closed_1 =
      old.energy[k] > 0.0 ? ends_closed(old.closure_a[k], old.closure_b[k], c.noise) : 0.0;
  const double switched = closed != closed_1 ? 1.0 : 0.0;
  c.now.switched[k] = switched;
  return (old.energy[k] > 0.0) & ((switched > 0.0) | (old.switched[k] > 0.0));
}

/// Evaluates face k at step n and writes its state. dashpots: some face of the model has dashpots;
/// limits_given: as in act(); plain: by the short formulas (is_plain()).
template <bool dashpots, bool limits_given, bool plain>
EDDA_INLINE FaceResult evaluate_one(const FaceView& c, std::size_t k) {
  const FaceFields<const double*>& old = c.before;
  const FacePoints at = face_points(c, c.x, c.y, k), then = face_points(c, c.x1, c.y1, k);
  const FacePair pair = face_pair(c, c.exterior_cosine, c.exterior_sine, k);
  const EdgeGeometry stands = geometry_of_edges(at, pair);
  const Face face = face_between<plain>(at, pair, stands);
  const bool bonded = plain ? false : c.bonded[k] > 0.0;
  const bool touches = (face.energy > 0.0) | (bonded & (face.gate > 0.0));

  const ShearSprings springs = shear_springs(c, face, touches, k);
  const EndMotion moved = motion_of(face, {c.locked_closure_a[k], c.locked_closure_b[k]}, then);
  const EndsOfFace end = ends_of<plain>(c, face, moved, springs.kept, touches, k);
  const double cohesion = touches ? 0.5 * c.cohesion[k] * face.cohesive : 0.0;
  const EndActs acts_a = act<dashpots, limits_given, plain>(
      c, face, end.a, springs.spring, springs.per_spring, cohesion, touches, c.limit_a, k);
  const EndActs acts_b = act<dashpots, limits_given, plain>(
      c, face, end.b, springs.spring, springs.per_spring, cohesion, touches, c.limit_b, k);
  const Shear a = acts_a.shear, b = acts_b.shear;
  const LostAtEnds losses = lost_at_ends(c, at, face, end, a, b, springs, touches, k);
  const bool switching = switches(c, face, touches, k);
  write_face(c, face, springs, end, a, b, touches, k);
  if constexpr (dashpots) write_dashpots(c, moved, acts_a, acts_b, k);
  c.now.friction_work[k] = losses.a.friction + losses.b.friction;
  FaceEnds bounds;
  double given = 0.0;
  if constexpr (!plain) {
    bounds = ends_at_bounds(face, pair);
    given = work_of_bounds(face, bounds, at, then);
  }
  c.now.transfer[k] = losses.a.transfer + losses.b.transfer - given;

  FrameForces on = face.pressure;
  add_ends(on, face, {acts_a.damping, acts_b.damping},
           {a.force + acts_a.shear_damping, b.force + acts_b.shear_damping});
  if constexpr (!plain) push_bounds(on, face.of_first, bounds);
  FaceResult result;
  result.force = on_corners(on, at, face);
  const bool is_rare = (c.bonded[k] > 0.0) | !is_plain(stands, pair);
  result.rare = is_rare ? 1.0 : 0.0;
  const FaceEnds drawn{face.closure.a - c.locked_closure_a[k],
                       face.closure.b - c.locked_closure_b[k]};
  result.needs_decision =
      needs_decision(c, face.gate > 0.0, drawn, face.energy > 0.0, k) ? 1.0 : 0.0;
  result.switching = switching ? 1.0 : 0.0;
  const bool works = touches | (old.energy[k] > 0.0) | (old.spring[k] > 0.0);
  result.works = works ? 1.0 : 0.0;
  result.depth = touches ? larger(drawn.a, drawn.b) : 0.0;
  return result;
}

/// For a face that has carried nothing for two steps: updates its geometry, with the same bits as
/// evaluate_one() would. Returns whether this is not enough, because the face may be closed or
/// because decide_activity() must be called.
EDDA_INLINE bool may_close(const FaceView& c, std::size_t k) {
  const FacePair pair = face_pair(c, c.exterior_cosine, c.exterior_sine, k);
  const EdgeGeometry o = geometry_of_edges(face_points(c, c.x, c.y, k), pair);
  const double drawn_a = o.closure_at_0 + o.closure_slope * o.ma,
               drawn_b = o.closure_at_0 + o.closure_slope * o.mb;
  const double da = drawn_a + pair.offset.a, db = drawn_b + pair.offset.b;
  const double gate = smooth_step((o.cosine - pair.gate_from) * pair.gate_scale).value;
  const double overlap = o.mb - o.ma, length = larger(overlap, 0.0);
  const bool on = (overlap > 0.0) & (o.cosine > pair.gate_from) & (o.s2 > 0.0) & (o.r1 > o.r2);
  const double lives = on ? gate : 0.0;
  const FaceEnds gated = gated_closure(drawn_a, drawn_b, pair);
  const bool open = larger(larger(da, db), larger(gated.a, gated.b)) <= 0.0;
  const FaceEnds surfaces{da - pair.offset.a, db - pair.offset.b};
  const FaceFields<double*>& m = c.now;
  m.closure_a[k] = da;
  m.closure_b[k] = db;
  m.length[k] = m.overlap[k] = length;
  m.gate[k] = lives;
  m.cohesive[k] = lives * length * flush_part(o.cosine);
  m.xi_a[k] = o.ma * o.per_e;
  m.xi_b[k] = o.mb * o.per_e;
  m.eta_a[k] = (o.ma - o.r2) * o.per_f;
  m.eta_b[k] = (o.mb - o.r2) * o.per_f;
  return (on & !open) | needs_decision(c, on, surfaces, false, k);
}

}  // namespace edda
