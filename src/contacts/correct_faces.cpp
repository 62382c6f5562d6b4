// Corrections of the last step of faces (evaluate_face.hpp).
#include <algorithm>
#include <cmath>

#include "base/parallel.hpp"
#include "contacts/evaluate_face.hpp"
#include "contacts/face_step.hpp"

namespace edda {

void correct_last_step(const FaceSet& c, FaceStates& states, const BlockSet& b, const Pose& pose,
                       const std::vector<double>& old_x1, const std::vector<double>& old_y1) {
  parallel_for(c.size(), [&](std::size_t k) {
    const FaceFields& n = states.now[k];
    FaceFields& m = states.before[k];
    const Face now = face_at(c, b, pose.x, pose.y, k), then = face_at(c, b, pose.x1, pose.y1, k);
    const auto slip_from = [&](const std::vector<double>& x1, const std::vector<double>& y1) {
      return slip_of(c, now, face_points(c, pose.x, pose.y, k), face_points(c, x1, y1, k), k);
    };
    const FaceEnds was = slip_from(old_x1, old_y1), is = slip_from(pose.x1, pose.y1);
    // Ends that stick keep their force; ends that slide slip at the new velocity. What carries
    // nothing at either step has no slip.
    const bool has_slip = n.spring > 0.0 || m.spring > 0.0;
    if (has_slip && n.slip_a == n.trial_a) m.slip_a += was.a - is.a;
    if (has_slip && n.slip_b == n.trial_b) m.slip_b += was.b - is.b;
    m.closure_a = then.closure.a;
    m.closure_b = then.closure.b;
    m.energy = then.energy;
    m.gate = std::max(m.gate, then.gate);
  });
}

CornerForces recompute_shear(FaceSet& c, FaceFields& m, const Face& face, const FacePoints& at,
                             const FacePoints& then, double alpha, std::size_t k) {
  const FaceEnds here = slip_of(c, face, at, then, k);
  const double spring = m.spring, cohesion = 0.5 * c.cohesion[k] * face.cohesive;
  const auto again = [&](double normal, double trial, double slipped, double& force, double& slip) {
    const double limit = coulomb_limit(cohesion, c.friction[k], normal);
    const Shear next =
        cut<true>(trial, spring, inverse_of(spring), c.bonded(k) ? unlimited_shear : limit);
    // As lost(), for a change of T_n alone: the work of T_{n-1} stays as it was, and kept u_{n-1}
    // is u_tr - slipped.
    const auto taken = [&](const Shear& s) {
      const double all = -0.5 * s.force * (slipped - s.slip);
      const double plastic_work = 0.5 * spring * (trial - s.slip) * (s.slip + trial - slipped);
      const double friction = std::max(plastic_work, 0.0);
      return Lost{friction, all - friction};
    };
    const Lost was = taken({force, slip}), is = taken(next);
    c.friction_work[k] += is.friction - was.friction;
    c.transfer[k] += is.transfer - was.transfer;
    force = next.force;
    slip = next.slip;
  };
  again(alpha * face.normal.a + m.damping_a, m.trial_a, here.a, m.shear_a, m.slip_a);
  again(alpha * face.normal.b + m.damping_b, m.trial_b, here.b, m.shear_b, m.slip_b);
  CornerForces force = end_forces(at, face, {}, {m.shear_a, m.shear_b});
  force.p1 += alpha * face.force.p1;
  force.p2 += alpha * face.force.p2;
  force.q1 += alpha * face.force.q1;
  force.q2 += alpha * face.force.q2;
  return force;
}

}  // namespace edda
