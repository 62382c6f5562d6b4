#include "contacts/face_stiffness.hpp"

#include <algorithm>
#include <cmath>

#include "blocks/masses.hpp"
#include "contacts/evaluate_face.hpp"

namespace edda {
namespace {

/// Second derivatives of phi_exact: (2 1; 1 2)/6 where both ends are closed; else, with r = d/(d -
/// d') of the closed end's closure d and the open end's d' < 0: r - r^2 + r^3/3, r^2/2 - r^3/3 and
/// r^3/3.
EndStiffness of_exact_potential(double da, double db, bool carries_tension) {
  if (carries_tension || (da >= 0.0 && db >= 0.0)) return {1.0 / 3.0, 1.0 / 6.0, 1.0 / 3.0};
  const double closed = std::max(da, db);
  if (closed <= 0.0) return {};
  const double r = closed / std::abs(da - db), r2 = r * r, r3 = r2 * r / 3.0;
  const double near = r - r2 + r3, across = 0.5 * r2 - r3, far = r3;
  return da > db ? EndStiffness{near, across, far} : EndStiffness{far, across, near};
}

EndStiffness of_potential_at_ends(double da, double db, bool carries_tension) {
  return {carries_tension || da >= 0.0 ? 0.5 : 0.0, 0.0, carries_tension || db >= 0.0 ? 0.5 : 0.0};
}

double dashpot(const FaceSet& c, const Masses& m, double spring, double zeta, double xi, double eta,
               std::size_t k) {
  const double inverse =
      inverse_mass_at(inverse_mass_of_edge(m, c.edge[k], c.edge_end[k]), xi) +
      inverse_mass_at(inverse_mass_of_edge(m, c.facing[k], c.facing_end[k]), 1.0 - eta);
  return inverse > 0.0 ? 2.0 * zeta * std::sqrt(spring / inverse) : 0.0;
}

}  // namespace

EndStiffness end_stiffness(const Face& face, const FacePair& pair, double near) {
  const double da = face.closure.a + near, db = face.closure.b + near;
  const bool carries_tension = pair.carries_tension != 0.0;
  const EndStiffness exact = of_exact_potential(da, db, carries_tension);
  const EndStiffness ends = of_potential_at_ends(da, db, carries_tension);
  const double whole = face.gate * pair.stiffness * std::max(face.length, 0.0);
  const auto mixed = [&](double x, double y) { return whole * (x + face.share * (y - x)); };
  return {mixed(exact.aa, ends.aa), mixed(exact.ab, ends.ab), mixed(exact.bb, ends.bb)};
}

FaceStiffness face_stiffness(const FaceSet& c, const FaceScene& scene, double step,
                             const EndStates& taken, std::size_t k) {
  const BlockSet& b = scene.blocks;
  const Pose& pose = scene.pose;
  FaceStiffness s;
  const FacePoints at = face_points(c, pose.x, pose.y, k);
  const FacePair pair = face_pair(c, b, k);
  const Face face = face_between(at, pair);
  if (!(face.gate > 0.0) || !(pair.stiffness > 0.0)) return s;
  s.normal = end_stiffness(face, pair, taken.near);
  const double largest = std::max(face.closure.a, face.closure.b) + taken.near;
  const bool touches = largest >= 0.0 || c.bonded(k) || c.carries_tension(k);
  const double spring = touches ? 0.5 * c.shear_stiffness[k] * face.length * face.gate : 0.0;
  s.shear_a = taken.a_slides ? 0.0 : spring;
  s.shear_b = taken.b_slides ? 0.0 : spring;
  if (c.dashpots) {
    const FacesOfLaw& law = c.of_law(k);
    const double across = 0.5 * pair.stiffness * face.length * face.gate;
    const auto damping = [&](double p, double zeta, double xi, double eta) {
      return dashpot(c, scene.masses, p, zeta, xi, eta, k) / step;
    };
    if (s.normal.aa > 0.0) s.normal.aa += damping(across, law.zeta, face.xi.a, face.eta.a);
    if (s.normal.bb > 0.0) s.normal.bb += damping(across, law.zeta, face.xi.b, face.eta.b);
    if (s.shear_a > 0.0) s.shear_a += damping(spring, law.shear_zeta, face.xi.a, face.eta.a);
    if (s.shear_b > 0.0) s.shear_b += damping(spring, law.shear_zeta, face.xi.b, face.eta.b);
  }
  s.normal_a = end_forces(at, face, {1.0, 0.0}, {});
  s.normal_b = end_forces(at, face, {0.0, 1.0}, {});
  s.along_a = end_forces(at, face, {}, {1.0, 0.0});
  s.along_b = end_forces(at, face, {}, {0.0, 1.0});
  return s;
}

}  // namespace edda
