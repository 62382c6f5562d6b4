#include "contacts/joint_laws.hpp"

#include <algorithm>
#include <cmath>

#include "contacts/evaluate_face.hpp"
#include "contacts/joint_strength.hpp"
#include "contacts/strength.hpp"

namespace edda {
namespace {

constexpr double dilation_gap = 1e-4;  // of the smaller block: at a larger gap dilation stops

/// m: the state of face k at n, as everywhere below.
StrengthInForce strength_at(const FaceSet& c, const LawTable& laws, const FaceFields& m,
                            std::size_t k) {
  return strength_of(laws, c.law[k], c.bond(k),
                     {c.slip_so_far[k], m.length, m.normal_a + m.normal_b});
}

/// Finds what follows from the corners at n.
void complete(const FaceSet& c, const BlockSet& b, const Pose& pose, FaceAtN& at_n, std::size_t k) {
  if (at_n.complete) return;
  take_element(at_n.state, face_at(c, b, pose.x1, pose.y1, k));
  at_n.complete = true;
}

void open_by(FaceSet& c, std::size_t k, double rise) {
  c.locked_closure_a[k] += rise;
  c.locked_closure_b[k] += rise;
  c.dilation_left[k] -= rise;
}

/// Part of a further slip of the joint in which it dilates, m.
double dilating_part(const FaceSet& c, const Law& law, std::size_t k, double slip) {
  const double left =
      law.slip_distance > 0.0 ? std::max(law.slip_distance - c.slip_so_far[k], 0.0) : slip;
  return law.type == LawType::barton_bandis ? slip : std::min(slip, left);
}

/// Adds a slip of the joint to its accumulated slip and to its outstanding dilation.
void take_slip(FaceSet& c, const LawTable& laws, const FaceFields& m, std::size_t k, double slip) {
  if (slip == 0.0) return;
  const double part = dilating_part(c, laws.rows[c.law[k]], k, slip);
  c.dilation_left[k] += strength_at(c, laws, m, k).dilation * part;
  c.slip_so_far[k] += slip;
}

/// Plastic slip of a face between n and n + 1, m, and the work of friction on it, J.
struct Sliding {
  double slip = 0.0, friction = 0.0;
};
/// As a step will find it, with the normal forces `normal` at n + 1. moved: the ends
/// along the joint.
Sliding sliding_under(const FaceSet& c, const FaceFields& m, FaceEnds moved, FaceEnds normal,
                      std::size_t k) {
  Sliding both;
  const double spring = m.spring, cohesion = 0.5 * c.cohesion[k] * m.cohesive;
  if (!(spring > 0.0) || c.bonded(k)) return both;
  const auto add = [&](double slip, double more, double pressed) {
    const double limit = coulomb_limit(cohesion, c.friction[k], pressed) / spring;
    const double trial = slip + more, cut = std::max(std::abs(trial) - limit, 0.0);
    both.slip += 0.5 * cut;
    both.friction += 0.5 * spring * cut * (limit + (trial < 0.0 ? -slip : slip));
  };
  add(m.slip_a, moved.a, normal.a);
  add(m.slip_b, moved.b, normal.b);
  return both;
}

/// What an opening r of the face between n and n + 1 brings with it.
struct Lift {
  double due;       ///< m, opening that the slip of the step asks for, with what is outstanding
  double normal;    ///< N, N_n + N_{n+1}
  double friction;  ///< J, of the step
};

/// Opens the face by its outstanding dilation and by that of the slip between n and n + 1, at most
/// by what the friction of this step can supply, and that of all steps up to n. An opening r takes
/// r (N_n + N_{n+1})/2.
void lift(FaceSet& c, const BlockSet& b, const Pose& pose, const LawTable& laws, FaceAtN& at_n,
          std::size_t k) {
  const FaceFields& m = at_n.state;
  if (!(c.friction_work[k] > 0.0)) return;
  if (c.cohesion[k] > 0.0) complete(c, b, pose, at_n, k);
  const Face closed = face_at(c, b, pose.x, pose.y, k);
  const FaceEnds moved =
      slip_of(c, closed, face_points(c, pose.x, pose.y, k), face_points(c, pose.x1, pose.y1, k), k);
  const Sliding in_place = sliding_under(c, m, moved, closed.normal, k);
  if (!(in_place.friction > 0.0)) return;
  complete(c, b, pose, at_n, k);
  const Law& law = laws.rows[c.law[k]];
  const double outstanding = c.dilation_left[k], dilation = strength_at(c, laws, m, k).dilation;
  const double most = outstanding + dilation * dilating_part(c, law, k, in_place.slip);
  if (!(most > 0.0)) return;
  const auto after = [&](double rise) -> Lift {
    const FaceEnds next = face_at(c, b, pose.x, pose.y, k, -rise).normal;
    const Sliding sliding = sliding_under(c, m, moved, next, k);
    return {outstanding + dilation * dilating_part(c, law, k, sliding.slip),
            m.normal_a + m.normal_b + next.a + next.b, sliding.friction};
  };
  const auto affords = [&](double rise, const Lift& l) {
    return 0.5 * rise * l.normal <= std::min(l.friction, c.friction_work[k]);
  };
  // The dilation due falls as the opening grows, since more of the slip becomes elastic: the
  // opening that equals it, by linear interpolation.
  double rise = most * most / (2.0 * most - std::min(after(most).due, most));
  Lift done = after(rise);
  if (!affords(rise, done)) {
    double low = 0.0, high = rise;
    constexpr int halvings = 12;
    for (int n = 0; n < halvings; ++n) {
      const double middle = 0.5 * (low + high);
      (affords(middle, after(middle)) ? low : high) = middle;
    }
    rise = low;
    done = after(rise);
  }
  c.risen[k] = rise;
  c.dilation_work[k] = 0.5 * rise * done.normal;
  c.friction_work[k] -= c.dilation_work[k];
  open_by(c, k, rise);
}

/// A joint that has opened by less than dilation_gap continues to dilate as it slips, since its
/// asperities still face each other; the dilation does not exceed the gap, so it does not close the
/// joint.
void take_slip_while_open(FaceSet& c, const BlockSet& b, const Pose& pose, const LawTable& laws,
                          const FaceFields& m, std::size_t k) {
  const Face face = face_at(c, b, pose.x, pose.y, k);
  const FaceEnds slip =
      slip_of(c, face, face_points(c, pose.x, pose.y, k), face_points(c, pose.x1, pose.y1, k), k);
  take_slip(c, laws, m, k, 0.5 * std::abs(slip.a + slip.b));
  const double gap = -std::max(face.closure.a, face.closure.b);
  const double rise = std::clamp(gap, 0.0, std::max(c.dilation_left[k], 0.0));
  open_by(c, k, rise);
}

}  // namespace

void update_joint_law(FaceSet& c, const BlockSet& b, const Pose& pose, const LawTable& laws,
                      FaceAtN& at_n, std::size_t k) {
  const Law& law = laws.rows[c.law[k]];
  const FaceFields& m = at_n.state;
  if (m.energy > 0.0 || c.carries_tension(k)) {
    if (law.type == LawType::barton_bandis) complete(c, b, pose, at_n, k);
    const double cut = std::abs(m.trial_a - m.slip_a) + std::abs(m.trial_b - m.slip_b);
    take_slip(c, laws, m, k, c.bonded(k) ? 0.0 : 0.5 * cut);
    put_in_force(c, strength_at(c, laws, m, k), k);
    if (dilates(law) && m.energy > 0.0) lift(c, b, pose, laws, at_n, k);
    return;
  }
  const bool may_dilate = dilates(law) && c.is(FaceFlag::opened, k) && m.gate > 0.0;
  const bool may_part = law.type == LawType::slip_weakening && c.slip_so_far[k] < law.slip_distance;
  if (!may_dilate && !may_part) return;
  complete(c, b, pose, at_n, k);
  const double closure = std::max(m.closure_a, m.closure_b), size = smaller_size(c, b, k);
  if (may_dilate && -closure < dilation_gap * size) {
    take_slip_while_open(c, b, pose, laws, m, k);
  } else if (may_part && closure < -drawn_gap * size) {
    c.slip_so_far[k] = first_slip(law);
  }
}

}  // namespace edda
