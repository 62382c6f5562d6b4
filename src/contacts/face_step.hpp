// What a face is at a step, from its corners then and a step before: the formulas of the loops over
// all faces (base/vector_loop.hpp). They choose and never branch, or no processor would take
// several faces at a time.
#pragma once

#include <cmath>

#include "base/vector_loop.hpp"
#include "blocks/point_mass.hpp"
#include "contacts/face_set.hpp"

namespace edda {

inline constexpr double unlimited_shear = 1e300;  ///< N, of a bond

/// What a loop over the faces of a chunk reads and writes.
struct FaceView : FaceProperties<const double*> {
  const Id *edge, *edge_end, *facing, *facing_end;
  const double *turn_cosine, *turn_sine;
  const double *x, *y, *x1, *y1;
  double noise;
  const double *point_inverse, *edge_inverse;  // of dashpots
  double step;
  const double *limit_a, *limit_b;  ///< N, of shear: those of ShearLimits, if any
  FaceFields<double*> now;
  FaceFields<const double*> before;
  double* force;
};

/// What the points that are at the ends now have moved by in the last step, one against the other,
/// m: slip along the frame, rho_n - rho_{n-1} with rho_n = 0, and closure across the edge that the
/// corner there is pressed against.
struct EndMotion {
  FaceEnds slip, closure;
};
EDDA_INLINE EndMotion motion_of(const Face& face, FaceEnds offset, const FacePoints& then) {
  // The frame then: its own scale of length does not matter.
  const Vec2 t = frame_of(then, face.inverse_e, face.inverse_f), n = outward_normal(t);
  const Vec2 a = from_point_of_e(then, face.xi.a, face.eta.a);
  const Vec2 b = from_point_of_e(then, face.xi.b, face.eta.b);
  const FaceEnds slip{-dot(a, t), -dot(b, t)};
  return {slip,
          {face.closure.a - offset.a + dot(a, n) + face.slope.a * slip.a,
           face.closure.b - offset.b + dot(b, n) + face.slope.b * slip.b}};
}

/// Shear of one end under Coulomb's limit (N): T = -spring u.
struct Shear {
  double force, slip;
};
EDDA_INLINE Shear cut(double trial, double spring, double per_spring, double limit) {
  const double whole = -spring * trial;
  const double force = smaller(larger(whole, -limit), limit);
  return {force, force == whole ? trial : -force * per_spring};
}
EDDA_INLINE double inverse_of(double spring) {
  return 1.0 / (spring > 0.0 ? spring : 1.0);
}

/// What an end's shear spring has lost in the last step: in the leapfrog's terms T_n and T_{n-1}
/// each work over half of it, on the points at their ends, which are not quite the same.
struct SlipOfStep {
  double here;         ///< of the points at the end now, m
  double there;        ///< of those that were there at n - 1, m
  double force, slip;  ///< T and u at n - 1
  double kept;         ///< part of u that is left once the spring has grown
};
struct Lost {
  double friction, transfer;
};
/// (u_tr - u_n) (T_n + T_{n-1})/2 is Coulomb's, what else is missing is no physics. A face that has
/// opened lets go what it stored by sliding.
EDDA_INLINE Lost lost(const Shear& now, double trial, double spring, const SlipOfStep& s,
                      bool touches) {
  const double all = -0.5 * (now.force * (s.here - now.slip) + s.force * (s.slip + s.there));
  const double slid = 0.5 * spring * (trial - now.slip) * (now.slip + s.kept * s.slip);
  const double friction = larger(touches ? slid : all, 0.0);
  return {friction, all - friction};
}

/// The shear springs go with the overlap: what they gain in length is free of stress, what they
/// lose takes its part of the force along. Not for every breath: L must change by this part.
constexpr double worth = 1e-4;

/// What asks for a decision (see judge_face()).
EDDA_INLINE bool asks(const FaceView& c, bool on, FaceEnds drawn, bool stores, std::size_t k) {
  const bool born = on & (c.before.gate[k] == 0.0);
  const bool frees = on & (c.acts[k] == 0.0) & (larger(drawn.a, drawn.b) <= 0.0);
  const bool first = stores & (c.before.energy[k] == 0.0);
  return born | frees | first;
}
/// Of a face that stands in c.now.
EDDA_INLINE bool asks(const FaceView& c, std::size_t k) {
  const FaceFields<double*>& m = c.now;
  return asks(c, m.gate[k] > 0.0, {m.closure_a[k] - c.offset_a[k], m.closure_b[k] - c.offset_b[k]},
              m.energy[k] > 0.0, k);
}

/// Which ends are closed: 0 to 3.
EDDA_INLINE double ends_closed(double da, double db, double noise) {
  return (da > noise ? 1.0 : 0.0) + (db > noise ? 2.0 : 0.0);
}

struct Placed {
  CornerForces force;
  double asks, stirs;  ///< 1: yes
  double works;        ///< 1: carries, or did at the step before
  double depth;
  double rare;  ///< 1: not `plain`
};

/// One end of a face: its normal force, slip before Coulomb's limit, what its points have moved by
/// in the last step, across the face no more than since they touched.
struct EndOfFace {
  double normal, trial, closing, slipping, xi, eta;
};
/// What acts there besides the pressure.
struct EndActs {
  Shear shear;
  double damping, drag;  ///< of the dashpots across and along the face, N
};

/// Dashpots c = 2 zeta sqrt(p m), p the spring of the end and m the mass that it moves. The one
/// across lets no end pull that could not, and counts in Coulomb's limit; the one along keeps
/// within it. `held`: the limit does not go with the normal force (ShearLimits).
template <bool dashpots, bool held, bool plain>
EDDA_INLINE EndActs act(const FaceView& c, const Face& face, const EndOfFace& end, double spring,
                        double per_spring, double cohesion, bool touches, const double* limits,
                        std::size_t k) {
  const double friction = c.friction[k];
  const bool bonded = plain ? false : c.bonded[k] > 0.0;
  const auto limit_under = [&](double normal) {
    if constexpr (held) return limits[k];
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
    const bool pulls = plain ? false : c.pulls[k] > 0.0;
    const bool carries = end.normal != 0.0;
    const double normal = carries ? (pulls ? whole : pushing) : 0.0;
    const double limit = limit_under(normal);
    const Shear shear = cut(end.trial, spring, per_spring, limit);
    const double drag = -2.0 * c.shear_zeta[k] * std::sqrt(spring * mass) * end.slipping / c.step;
    const double within = larger(-limit - shear.force, smaller(limit - shear.force, drag));
    const bool holds = touches & (shear.slip == end.trial);
    return {shear, normal - end.normal, holds ? within : 0.0};
  }
}

template <bool dashpots, bool held, bool plain>
EDDA_INLINE Placed place(const FaceView& c, std::size_t k) {
  const FaceFields<double*>& m = c.now;
  const FaceFields<const double*>& old = c.before;
  const FacePoints at = face_points(c, c.x, c.y, k), then = face_points(c, c.x1, c.y1, k);
  const FacePair pair = face_pair(c, c.turn_cosine, c.turn_sine, k);
  const Opposition stands = opposition_of(at, pair);
  const Face face = face_between<plain>(at, pair, stands);
  const bool bonded = plain ? false : c.bonded[k] > 0.0;
  const bool touches = (face.energy > 0.0) | (bonded & (face.gate > 0.0));

  // overlap and springs
  const double length = larger(face.length, 0.0), length_1 = old.overlap[k];
  const bool same = std::abs(length - length_1) <= worth * length_1;
  const double overlap = same ? length_1 : length;
  const double kept = overlap > length_1 ? length_1 / (overlap > 0.0 ? overlap : 1.0) : 1.0;
  const double spring = touches ? 0.5 * c.shear_stiffness[k] * overlap * face.gate : 0.0;
  const double per_spring = inverse_of(spring);

  // slip, and Coulomb's limit at each end
  const EndMotion moved = motion_of(face, {c.offset_a[k], c.offset_b[k]}, then);
  const FaceEnds here = moved.slip;
  const double xi_a = old.xi_a[k], xi_b = old.xi_b[k], eta_a = old.eta_a[k], eta_b = old.eta_b[k];
  const FaceEnds there{dot(from_point_of_e(at, xi_a, eta_a), face.t),
                       dot(from_point_of_e(at, xi_b, eta_b), face.t)};
  const double slip_1a = old.slip_a[k], slip_1b = old.slip_b[k];
  const double trial_a = touches ? kept * slip_1a + here.a : 0.0;
  const double trial_b = touches ? kept * slip_1b + here.b : 0.0;
  const double cohesion = touches ? 0.5 * c.cohesion[k] * face.cohesive : 0.0;
  const double da = face.closure.a, db = face.closure.b;
  const bool pulls = plain ? false : c.pulls[k] > 0.0;
  const auto since_touch = [&](double closing, double d) {
    return pulls ? closing : smaller(closing, larger(d, 0.0));
  };
  const FaceEnds closing{since_touch(moved.closure.a, da), since_touch(moved.closure.b, db)};
  const EndOfFace end_a{face.normal.a, trial_a, closing.a, here.a, face.xi.a, face.eta.a};
  const EndOfFace end_b{face.normal.b, trial_b, closing.b, here.b, face.xi.b, face.eta.b};
  const EndActs acts_a = act<dashpots, held, plain>(c, face, end_a, spring, per_spring, cohesion,
                                                    touches, c.limit_a, k);
  const EndActs acts_b = act<dashpots, held, plain>(c, face, end_b, spring, per_spring, cohesion,
                                                    touches, c.limit_b, k);
  const Shear a = acts_a.shear, b = acts_b.shear;
  const Lost lost_a =
      lost(a, trial_a, spring, {here.a, there.a, old.shear_a[k], slip_1a, kept}, touches);
  const Lost lost_b =
      lost(b, trial_b, spring, {here.b, there.b, old.shear_b[k], slip_1b, kept}, touches);

  const double closed = touches ? ends_closed(da, db, c.noise) : 0.0;
  const double closed_1 =
      old.energy[k] > 0.0 ? ends_closed(old.closure_a[k], old.closure_b[k], c.noise) : 0.0;
  const double switched = closed != closed_1 ? 1.0 : 0.0;
  const bool stirs = (old.energy[k] > 0.0) & ((switched > 0.0) | (old.switched[k] > 0.0));

  m.closure_a[k] = da;
  m.closure_b[k] = db;
  m.energy[k] = face.energy;
  m.normal_a[k] = face.normal.a;
  m.normal_b[k] = face.normal.b;
  m.shear_a[k] = a.force;
  m.shear_b[k] = b.force;
  m.slip_a[k] = touches ? a.slip : 0.0;
  m.slip_b[k] = touches ? b.slip : 0.0;
  m.trial_a[k] = trial_a;
  m.trial_b[k] = trial_b;
  m.spring[k] = spring;
  m.length[k] = length;
  m.cohesive[k] = face.cohesive;
  m.overlap[k] = touches ? overlap : length;
  m.gate[k] = face.gate;
  m.xi_a[k] = face.xi.a;
  m.xi_b[k] = face.xi.b;
  m.eta_a[k] = face.eta.a;
  m.eta_b[k] = face.eta.b;
  m.switched[k] = switched;
  m.friction_work[k] = lost_a.friction + lost_b.friction;
  // D_n works over (x_{n+1} - x_{n-1})/2: half of it in the step behind, half in the next one.
  const auto taken = [&](double a_across, double b_across, double a_along, double b_along) {
    return 0.5 * (a_across * moved.closure.a + b_across * moved.closure.b - a_along * here.a -
                  b_along * here.b);
  };
  if constexpr (dashpots) {
    m.damping_a[k] = acts_a.damping;
    m.damping_b[k] = acts_b.damping;
    m.drag_a[k] = acts_a.drag;
    m.drag_b[k] = acts_b.drag;
    m.damping_work[k] = taken(acts_a.damping, acts_b.damping, acts_a.drag, acts_b.drag);
    m.damping_due[k] = taken(old.damping_a[k], old.damping_b[k], old.drag_a[k], old.drag_b[k]);
  }
  FaceEnds bounds;
  double given = 0.0;
  if constexpr (!plain) {
    bounds = held_at_bounds(face, pair);
    const auto along = [&](double part, Vec2 first, Vec2 second) {
      return dot(part * first + (1.0 - part) * second, face.t);
    };
    given = bounds.a * along(face.of_first.a, at.p1 - then.p1, at.q2 - then.q2) +
            bounds.b * along(face.of_first.b, at.p2 - then.p2, at.q1 - then.q1);
  }
  m.transfer[k] = lost_a.transfer + lost_b.transfer - given;

  Placed placed;
  FrameForces on = face.pressure;
  add_ends(on, face, {acts_a.damping, acts_b.damping},
           {a.force + acts_a.drag, b.force + acts_b.drag});
  if constexpr (!plain) push_bounds(on, face.of_first, bounds);
  placed.force = on_corners(on, at, face);
  const bool is_rare = (c.bonded[k] > 0.0) | !is_plain(stands, pair);
  placed.rare = is_rare ? 1.0 : 0.0;
  const FaceEnds drawn{da - c.offset_a[k], db - c.offset_b[k]};
  placed.asks = asks(c, face.gate > 0.0, drawn, face.energy > 0.0, k) ? 1.0 : 0.0;
  placed.stirs = stirs ? 1.0 : 0.0;
  const bool works = touches | (old.energy[k] > 0.0) | (old.spring[k] > 0.0);
  placed.works = works ? 1.0 : 0.0;
  placed.depth = touches ? larger(da - c.offset_a[k], db - c.offset_b[k]) : 0.0;
  return placed;
}

/// A face that has carried nothing for two steps. Where it still does not, all that changes is
/// where its edges stand, to the bit as place() says; whether that is not so, or a decision is
/// asked for.
EDDA_INLINE bool wakes(const FaceView& c, std::size_t k) {
  const FacePair pair = face_pair(c, c.turn_cosine, c.turn_sine, k);
  const Opposition o = opposition_of(face_points(c, c.x, c.y, k), pair);
  const double drawn_a = o.apart_0 + o.steeper * o.ma, drawn_b = o.apart_0 + o.steeper * o.mb;
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
  return (on & !open) | asks(c, on, surfaces, false, k);
}

}  // namespace edda
