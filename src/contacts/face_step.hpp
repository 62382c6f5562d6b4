// One step of a face: normal and shear forces, slip, work and dashpots, from the positions of its
// corners at n and n - 1 and its state at n - 1. Theory, sections 4.3 (shear and Coulomb's limit),
// 9.6 (dashpots) and 10.1 (work); notation: contacts/face.hpp. These are the formulas of the loops
// over all faces (base/vector_loop.hpp): they select and never branch, so that a processor can
// compute several faces at a time. Where the numbers of a face are kept is up to the caller.
#pragma once

#include <cmath>

#include "base/vector_loop.hpp"
#include "contacts/face.hpp"
#include "contacts/face_inputs.hpp"
#include "contacts/joint_strength.hpp"

namespace edda {

inline constexpr double unlimited_shear =
    1e300;  ///< N, limit of a bonded face: it fails as a whole

/// Relative displacement, in the last step, of the two material points that lie at each end now, m,
/// on which the forces at the ends do their work (add_ends()): slip along the edge on which a
/// corner presses (theory, section 4.3), and closing normal to it.
struct EndMotion {
  FaceEnds slip, closure;
};
/// now, then: the corners at n and n - 1, each in the frame of its step; z1 of `then` does not
/// count, since it follows from the frame: (z2 - z1)/lf = y2/le. What has moved is taken as the
/// difference of these coordinates, so that a face at rest has not moved by as much as a rounding
/// error, which would add up over many steps. length_ratio: FacePair.
EDDA_INLINE EndMotion motion_of(const Face& face, const EdgeCoordinates& now,
                                const EdgeCoordinates& then, double length_ratio) {
  const double y2 = now.y2 - then.y2, z2 = now.z2 - then.z2;
  const EdgeCoordinates moved{now.s2 - then.s2, y2, now.r1 - then.r1, z2 - length_ratio * y2,
                              now.r2 - then.r2, z2};
  const FaceEnds along{along_t(moved, face.xi.a, face.eta.a),
                       along_t(moved, face.xi.b, face.eta.b)},
      across{along_n(moved, face.xi.a, face.eta.a), along_n(moved, face.xi.b, face.eta.b)};
  return {{along.a + face.slope * across.a, along.b + face.slope * across.b},
          {face.slope * along.a - across.a, face.slope * along.b - across.b}};
}

/// Shear force T = -spring u of one end, N, and its elastic slip u, m.
struct Shear {
  double force, slip;
};
/// Cuts the trial force to Coulomb's limit (N), and the trial slip with it (return mapping; theory,
/// section 4.3). with_work: what the work of the step needs is computed, too; without it the slip
/// is not cut.
template <bool with_work>
EDDA_INLINE Shear cut(double trial, double spring, double per_spring, double limit) {
  const double whole = -spring * trial;
  const double force = smaller(larger(whole, -limit), limit);
  if constexpr (!with_work) return {force, trial};
  return {force, force == whole ? trial : -force * per_spring};
}
EDDA_INLINE double inverse_of(double spring) {
  return 1.0 / (spring > 0.0 ? spring : 1.0);
}

/// Energy that an end's shear spring has lost, J.
struct Lost {
  double friction, transfer;
};
/// An end's shear spring at n - 1.
struct SpringBefore {
  double spring, slip;  ///< N/m, m
  double kept;          ///< fraction of the slip that remains (ShearSprings)
};
/// In the leapfrog's terms T_n and T_{n-1} each do work over half of the step; `here`: its slip, m.
/// What the spring has lost is therefore -[T_n (here - u_n) + T_{n-1} (u_{n-1} + here)]/2, zero
/// where it sticks and does not change. Where it slides, its force is Coulomb's limit whatever it
/// remembers, and all of that is friction: with an unchanged spring (u_tr - u_n) spring (u_n +
/// u_{n-1})/2 (theory, section 4.3). So is all that it had stored where the face has opened. What
/// it loses otherwise, or gains, is `transfer`.
EDDA_INLINE Lost lost(const Shear& now, double trial, double spring, const SpringBefore& old,
                      double here, bool touches) {
  const double plastic = trial - now.slip;
  const double by_plastic = 0.5 * plastic * (spring * now.slip + old.spring * old.slip);
  const double by_change =
      0.5 * old.slip *
      ((old.spring - old.kept * spring) * now.slip + old.spring * (1.0 - old.kept) * old.slip);
  const double all =
      touches ? by_plastic + by_change : 0.5 * old.spring * old.slip * (old.slip + here);
  const bool dissipates = (plastic != 0.0) | !touches;
  const double friction = dissipates ? positive_part(all) : 0.0;
  return {friction, all - friction};
}

/// The shear springs follow the overlap where it has changed by more than this fraction of itself:
/// the length that it gains is free of stress, the length that it loses takes its part of the force
/// with it.
constexpr double least_length_change = 1e-4;

/// Whether a face is open that does not act, so that it may act from now on.
EDDA_INLINE bool may_begin_to_act(const FaceInputs& in, FaceEnds drawn) {
  return (in.pair.stiffness == 0.0) & (larger(drawn.a, drawn.b) <= 0.0);
}

/// Whether decide_activity() must be called for the face: it has come into being, or it does not
/// act and is open now, or it stores energy for the first time. `on`: it exists; `drawn`: its drawn
/// closures; `stores`: it stores energy.
EDDA_INLINE bool needs_decision(const FaceInputs& in, bool on, FaceEnds drawn, bool stores) {
  const bool begins = on & !in.before.on;
  const bool frees = on & may_begin_to_act(in, drawn);
  const bool first = stores & !in.before.stored;
  return begins | frees | first;
}

/// Forces at one end besides the pressure.
struct EndActs {
  double force, slip;             ///< as in Shear
  double damping, shear_damping;  ///< of the dashpots across and along the face, N
};

/// Roots sqrt(p m) of the dashpots across both ends, kg/s, with the spring p of the end, N/m, and
/// the mass m that it moves; and the factor from there to those along the face.
struct DashpotRoots {
  double a = 0.0, b = 0.0, along_per_across = 0.0, spring = 0.0;
};
EDDA_INLINE DashpotRoots dashpot_roots(const FaceInputs& in, const Face& face, double spring) {
  const auto inverse_mass = [&](double xi, double eta) {
    return inverse_mass_at(in.mass_e, xi) + inverse_mass_at(in.mass_f, 1.0 - eta);
  };
  const double inverse_a = inverse_mass(face.xi.a, face.eta.a),
               inverse_b = inverse_mass(face.xi.b, face.eta.b);
  const bool moves = (inverse_a > 0.0) & (inverse_b > 0.0);
  const double across = 0.5 * in.pair.stiffness * positive_part(face.length) * face.gate;
  const double per_both = moves ? 1.0 / (inverse_a * inverse_b) : 0.0;
  return {std::sqrt(across * inverse_b * per_both), std::sqrt(across * inverse_a * per_both),
          std::sqrt(spring / (across > 0.0 ? across : 1.0)), across};
}

/// Speed at which an end that is closed now has closed, m/s: the largest rate of closing since
/// then, `rate` now. It decays over about a hundred radians of the vibration of the end (`radians`
/// in the step); afterwards the dashpot is the linear one again.
EDDA_INLINE double strike_speed(bool closed, double before, double rate, double radians) {
  constexpr double fades = 0.01;
  return closed ? larger(rate, before * positive_part(1.0 - fades * radians)) : 0.0;
}

/// Coefficient of the dashpot across one end, N s/m: `linear`, or where it has a `rebound` that
/// times the normal force over the speed at which the end closed, and `linear` at most. A block
/// then keeps a part of its velocity that follows from `rebound` alone, whatever its mass,
/// stiffness and shape and however many ends it strikes: each has N (1 + rebound v/strike) (theory,
/// section 9.7).
EDDA_INLINE double dashpot_of(double rebound, double linear, const EndOfFace& end) {
  const double scaled = rebound * positive_part(end.normal);
  const bool follows = (rebound > 0.0) & (scaled < linear * end.strike);
  return follows ? scaled / (follows ? end.strike : 1.0) : linear;
}

/// Shear force under Coulomb's limit, |T| <= c L/2 + N tan(phi), and dashpots c = 2 zeta sqrt(p m)
/// with the spring p of the end and the mass m that it moves (theory, sections 4.3 and 9.6). The
/// force of the dashpot across the joint counts in Coulomb's limit and cannot make the end pull
/// unless the face carries tension; that of the dashpot along the joint stays within what the limit
/// leaves, and acts where the end sticks. `limits_given`: the limit is given and does not follow
/// from the normal force.
template <bool dashpots, bool limits_given, Formulas use, bool with_work>
EDDA_INLINE EndActs act(const FaceInputs& in, const EndOfFace& end, double spring,
                        double per_spring, const DashpotRoots& roots, double root, double cohesion,
                        bool touches, double given) {
  const bool bonded = use == Formulas::all ? in.strength.bonded : false;
  const auto limit_under = [&](double normal) {
    if constexpr (limits_given) return given;
    return bonded ? unlimited_shear : coulomb_limit(cohesion, in.strength.friction, normal);
  };
  if constexpr (!dashpots) {
    const Shear shear = cut<with_work>(end.trial, spring, per_spring, limit_under(end.normal));
    return {shear.force, shear.slip, 0.0, 0.0};
  } else {
    const double linear = 2.0 * in.strength.zeta * root;
    const double whole =
        end.normal + dashpot_of(in.strength.rebound, linear, end) * end.closing * in.per_step;
    const double pushing = positive_part(whole);
    const bool tension = carries_tension<use>(in.pair);
    const bool carries = end.normal != 0.0;
    const double normal = carries ? (tension ? whole : pushing) : 0.0;
    const double limit = limit_under(normal);
    const Shear shear = cut<with_work>(end.trial, spring, per_spring, limit);
    const double along =
        -2.0 * in.strength.shear_zeta * roots.along_per_across * root * end.slipping * in.per_step;
    const double within = larger(-limit - shear.force, smaller(limit - shear.force, along));
    const bool holds = touches & (shear.slip == end.trial);
    return {shear.force, shear.slip, normal - end.normal, holds ? within : 0.0};
  }
}

/// The shear springs of a face at a step, which follow its overlap (see `least_length_change`).
struct ShearSprings {
  double overlap;  ///< length that the two springs represent, m
  double kept;     ///< fraction of the elastic slip that remains: new length is free of stress
  double spring, per_spring;  ///< of each end, N/m, and its inverse
  bool change;                ///< the overlap that they represent has changed
};
/// Without with_work `kept` is 1 and there is no `per_spring`.
template <bool with_work>
EDDA_INLINE ShearSprings shear_springs(const FaceInputs& in, const Face& face, bool touches) {
  const double length = positive_part(face.length), length_1 = in.before.overlap;
  const bool carried = in.before.spring > 0.0;
  const bool same = std::abs(length - length_1) <= least_length_change * length_1;
  const double overlap = (carried & same) ? length_1 : length;
  const double spring = touches ? 0.5 * in.strength.shear_stiffness * overlap * face.gate : 0.0;
  const bool change = carried & !same;
  if constexpr (!with_work) return {overlap, 1.0, spring, 0.0, change};
  const double longest = larger(overlap, length_1);
  const double kept = carried ? length_1 / (longest > 0.0 ? longest : 1.0) : 1.0;
  return {overlap, kept, spring, inverse_of(spring), change};
}

/// Both ends of a face in a step, before Coulomb's limit.
struct EndsOfFace {
  EndOfFace a, b;
};
template <Formulas use>
EDDA_INLINE EndsOfFace ends_of(const FaceInputs& in, const Face& face, const EndMotion& moved,
                               double kept, bool touches) {
  const FaceEnds here = moved.slip;
  const double trial_a = touches ? kept * in.before.slip_a + here.a : 0.0;
  const double trial_b = touches ? kept * in.before.slip_b + here.b : 0.0;
  const bool tension = carries_tension<use>(in.pair);
  const auto since_touch = [&](double closing, double d) {
    return tension ? closing : smaller(closing, positive_part(d));
  };
  const FaceEnds closing{since_touch(moved.closure.a, face.closure.a),
                         since_touch(moved.closure.b, face.closure.b)};
  return {{face.normal.a, trial_a, closing.a, here.a, face.xi.a, face.eta.a, 0.0},
          {face.normal.b, trial_b, closing.b, here.b, face.xi.b, face.eta.b, 0.0}};
}

/// strike_speed() of both ends.
EDDA_INLINE FaceEnds strikes_of(const FaceInputs& in, const Face& face, const EndMotion& moved,
                                const DashpotRoots& roots, bool touches) {
  const auto strike = [&](double d, double before, double closing, double root, double normal) {
    // With the stiffness N/d of the pressure as it is, below that of the whole end.
    const double whole = d * roots.spring;
    const double part = smaller(positive_part(normal) / (whole > 0.0 ? whole : 1.0), 1.0);
    const double turns = roots.spring * std::sqrt(part) / ((root > 0.0 ? root : 1.0) * in.per_step);
    const bool asks = in.strength.rebound > 0.0;
    return strike_speed(asks & touches & (d > in.noise), before, closing * in.per_step, turns);
  };
  return {strike(face.closure.a, in.before.strike.a, moved.closure.a, roots.a, face.normal.a),
          strike(face.closure.b, in.before.strike.b, moved.closure.b, roots.b, face.normal.b)};
}

/// An end that gapes beside one that is pressed has a part of its pressure, and strikes with it.
EDDA_INLINE void give_strikes(FaceEnds strike, EndsOfFace& end) {
  end.a.strike = strike.a > 0.0 ? strike.a : strike.b;
  end.b.strike = strike.b > 0.0 ? strike.b : strike.a;
}

/// Work of the forces of locked_closure_forces() in the step, J.
EDDA_INLINE double work_of_bounds(const Face& face, FaceEnds bounds, const FacePoints& at,
                                  const FacePoints& then) {
  const auto along = [&](double part, Vec2 first, Vec2 second) {
    return dot(part * first + (1.0 - part) * second, face.t);
  };
  return bounds.a * along(face.of_first.a, at.p1 - then.p1, at.q2 - then.q2) +
         bounds.b * along(face.of_first.b, at.p2 - then.p2, at.q1 - then.q1);
}

/// A face at n: forces, state, and the work of the step.
struct FaceStep {
  double overlap, spring;  ///< of the shear springs: length of both, m; stiffness of each, N/m
  FaceEnds trial, slip;    ///< elastic slip before and after Coulomb's limit, m
  FaceEnds shear;          ///< T, N
  FaceEnds damping, shear_damping;  ///< forces of the dashpots across and along the face, N
  FaceEnds strike;                  ///< strike_speed() of the ends, m/s
  bool touches;                     ///< carries force, or is bonded
  bool closed_a, closed_b;          ///< its ends are closed
  bool switched;                    ///< one of them opens or closes in this step
  bool needs_work;  ///< an end slides, or the springs change or open, or the face has a locked
                    ///< closure
  double friction, transfer;         ///< as in FaceFields, J
  double damping_work, damping_due;  ///< as in FaceFields, J
  bool decides;                      ///< needs_decision()
  bool may_act;                      ///< may_begin_to_act()
  bool rare;                         ///< it is bonded, or is_plain() does not hold
  double depth;                      ///< larger drawn closure, m; 0: it carries nothing
  CornerForces force;
};

/// Work of dashpot forces in the step, J; half of it is done in this step and half in the next one,
/// since D_n does its work over (x_{n+1} - x_{n-1})/2.
EDDA_INLINE double half_work(FaceEnds across, FaceEnds along, const EndMotion& moved) {
  return 0.5 * (across.a * moved.closure.a + across.b * moved.closure.b - along.a * moved.slip.a -
                along.b * moved.slip.b);
}

/// Forces of a face on its corners, N: its pressure, shear and dashpots; with_work: also those on
/// the corners that bound the overlap (locked_closure_forces()).
template <bool dashpots, bool with_work>
EDDA_INLINE CornerForces force_of(const Face& face, const EdgeGeometry& stands, FaceEnds shear,
                                  FaceEnds damping, FaceEnds shear_damping, FaceEnds bounds) {
  FrameForces on = face.pressure;
  if constexpr (dashpots) {
    add_ends(on, face, damping, {shear.a + shear_damping.a, shear.b + shear_damping.b});
  } else {
    add_shear(on, face, shear);
  }
  if constexpr (with_work) push_bounds(on, face.of_first, bounds);
  return on_corners(on, stands.corners(), face);
}

/// What has changed in the step (FaceStep).
EDDA_INLINE void mark_changes(FaceStep& s, const FaceInputs& in, const EdgeGeometry& stands,
                              const Face& face) {
  const FaceBefore& old = in.before;
  s.closed_a = s.touches & (face.closure.a > in.noise);
  s.closed_b = s.touches & (face.closure.b > in.noise);
  s.switched =
      (s.closed_a != (old.stored & old.closed_a)) | (s.closed_b != (old.stored & old.closed_b));
  s.may_act = may_begin_to_act(in, face.drawn);
  s.decides = needs_decision(in, face.gate > 0.0, face.drawn, face.energy > 0.0);
  s.rare = in.strength.bonded | !is_plain(stands, face.drawn, in.pair);
  s.depth = s.touches ? larger(face.drawn.a, face.drawn.b) : 0.0;
}

/// Contact update of a face at step n for its edge geometry and its element there. dashpots: some
/// face of the model has dashpots; limits_given: as in act(); with_work: with the work terms of the
/// step; without them the update is exact only where there is no `needs_work` (elastic stick).
template <bool dashpots, bool limits_given, Formulas use, bool with_work = true>
EDDA_INLINE FaceStep step_of_face(const FaceInputs& in, const EdgeGeometry& stands,
                                  const Face& face) {
  const FacePair& pair = in.pair;
  const FaceBefore& old = in.before;
  FaceStep s;
  const bool bonded = use == Formulas::all ? in.strength.bonded : false;
  s.touches = (face.energy > 0.0) | (bonded & (face.gate > 0.0));
  const ShearSprings springs = shear_springs<with_work>(in, face, s.touches);
  const double spring = springs.spring, per_spring = springs.per_spring;
  const EndMotion moved = motion_of(face, stands.corners(), old.corners, pair.length_ratio);
  EndsOfFace end = ends_of<use>(in, face, moved, springs.kept, s.touches);
  DashpotRoots roots;
  if constexpr (dashpots) {
    roots = dashpot_roots(in, face, spring);
    s.strike = strikes_of(in, face, moved, roots, s.touches);
    give_strikes(s.strike, end);
  }
  const double cohesion = s.touches ? 0.5 * in.strength.cohesion * face.cohesive : 0.0;
  const EndActs a = act<dashpots, limits_given, use, with_work>(
      in, end.a, spring, per_spring, roots, roots.a, cohesion, s.touches, in.limits.a);
  const EndActs b = act<dashpots, limits_given, use, with_work>(
      in, end.b, spring, per_spring, roots, roots.b, cohesion, s.touches, in.limits.b);
  s.overlap = springs.overlap;
  s.spring = spring;
  s.trial = {end.a.trial, end.b.trial};
  s.slip = {s.touches ? a.slip : 0.0, s.touches ? b.slip : 0.0};
  s.shear = {a.force, b.force};
  s.damping = {a.damping, b.damping};
  s.shear_damping = {a.shear_damping, b.shear_damping};
  const bool slides = (s.shear.a != -spring * s.trial.a) | (s.shear.b != -spring * s.trial.b);
  const bool stressed = (pair.offset.a != 0.0) | (pair.offset.b != 0.0);
  s.needs_work = (spring != old.spring) | (s.touches & (slides | springs.change | stressed));
  s.friction = s.transfer = s.damping_work = s.damping_due = 0.0;
  FaceEnds bounds;
  if constexpr (with_work) bounds = locked_closure_forces(face, pair);
  if constexpr (with_work) {
    const Lost lost_a = lost({a.force, a.slip}, end.a.trial, spring,
                             {old.spring, old.slip_a, springs.kept}, moved.slip.a, s.touches);
    const Lost lost_b = lost({b.force, b.slip}, end.b.trial, spring,
                             {old.spring, old.slip_b, springs.kept}, moved.slip.b, s.touches);
    s.friction = lost_a.friction + lost_b.friction;
    s.transfer = lost_a.transfer + lost_b.transfer - work_of_bounds(face, bounds, in.at, in.then);
  }
  if constexpr (dashpots) {
    s.damping_work = half_work(s.damping, s.shear_damping, moved);
    s.damping_due = half_work(old.damping, old.shear_damping, moved);
  }
  s.force =
      force_of<dashpots, with_work>(face, stands, s.shear, s.damping, s.shear_damping, bounds);
  mark_changes(s, in, stands, face);
  return s;
}

/// A face that has carried nothing for two steps, at n.
struct OpenFace {
  FaceEnds closure;  ///< in here for g++ 12, which does not vectorise the loop without it
  double gate;       ///< as Face::gate, with the same bits
  bool may_close;    ///< it may be closed, or decide_activity() must be called
};
EDDA_INLINE OpenFace test_open_face(const FaceInputs& in, const EdgeGeometry& o) {
  const FacePair& pair = in.pair;
  OpenFace s;
  const double drawn_a = o.closure_at_0 + o.closure_slope * o.ma,
               drawn_b = o.closure_at_0 + o.closure_slope * o.mb;
  s.closure = closed_by({drawn_a, drawn_b}, o, pair);
  const double gate = smooth_step((o.cosine - pair.gate_from) * pair.gate_scale).value;
  const FaceEnds gated = gated_closure(drawn_a, drawn_b, pair);
  const double deepest = larger(gated.a, gated.b);
  const bool overlap = overlaps(o.ma, o.mb, pair), faded = is_faded(o, deepest, pair);
  const bool on = overlap & !faded & (o.cosine > pair.gate_from) & (o.s2 > 0.0) & (o.r1 > o.r2);
  s.gate = on ? gate : 0.0;
  const bool open = larger(larger(s.closure.a, s.closure.b), deepest) <= 0.0;
  s.may_close = (on & !open) | needs_decision(in, on, {drawn_a, drawn_b}, false);
  return s;
}
EDDA_INLINE OpenFace test_open_face(const FaceInputs& in) {
  return test_open_face(in, geometry_of_edges(in.at, in.pair));
}

}  // namespace edda
