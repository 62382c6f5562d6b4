#include "contacts/evaluate_face.hpp"

#include <algorithm>

#include "contacts/activity.hpp"
#include "contacts/face_bonds.hpp"
#include "contacts/face_energy.hpp"
#include "contacts/face_softening.hpp"
#include "contacts/face_step.hpp"

namespace edda {
namespace {

/// What the step of face k reads of its state m at n - 1.
template <bool dashpots>
FaceBefore face_before(const FaceSet& c, const Pose& pose, const FaceFields& m, std::size_t k) {
  return {m.slip_a,
          m.slip_b,
          m.overlap,
          m.spring,
          m.energy > 0.0,
          m.gate > 0.0,
          m.closure_a > c.noise,
          m.closure_b > c.noise,
          m.switched > 0.0,
          coordinates_at(c, pose.x1, pose.y1, k),
          dashpots ? FaceEnds{m.damping_a, m.damping_b} : FaceEnds{},
          dashpots ? FaceEnds{m.shear_damping_a, m.shear_damping_b} : FaceEnds{},
          dashpots ? FaceEnds{m.strike_a, m.strike_b} : FaceEnds{}};
}

template <bool dashpots>
FaceInputs inputs_of(const FaceSet& c, const FaceScene& scene, double step,
                     const FaceFields& before, std::size_t k) {
  const BlockSet& b = scene.blocks;
  const Pose& pose = scene.pose;
  const FacesOfLaw& law = c.of_law(k);
  const auto inverse_mass = [&](Id from, Id to) {
    return dashpots ? inverse_mass_of_edge(scene.masses, from, to) : EdgeInverseMass{};
  };
  return {face_pair(c, b, k),
          {c.shear_stiffness[k], c.friction[k], c.cohesion[k], c.bonded(k), law.zeta,
           law.shear_zeta, law.rebound},
          face_points(c, pose.x, pose.y, k),
          face_points(c, pose.x1, pose.y1, k),
          face_before<dashpots>(c, pose, before, k),
          inverse_mass(c.edge[k], c.edge_end[k]),
          inverse_mass(c.facing[k], c.facing_end[k]),
          1.0 / step,
          c.noise,
          {}};
}

FaceFields state_of(const Face& face, const FaceStep& s, bool dashpots) {
  FaceFields m{};
  take_element(m, face);
  m.shear_a = s.shear.a;
  m.shear_b = s.shear.b;
  m.slip_a = s.slip.a;
  m.slip_b = s.slip.b;
  m.trial_a = s.trial.a;
  m.trial_b = s.trial.b;
  m.spring = s.spring;
  m.overlap = s.overlap;
  m.switched = s.switched ? 1.0 : 0.0;
  m.friction_work = s.friction;
  m.transfer = s.transfer;
  if (!dashpots) return m;
  m.damping_a = s.damping.a;
  m.damping_b = s.damping.b;
  m.shear_damping_a = s.shear_damping.a;
  m.shear_damping_b = s.shear_damping.b;
  m.strike_a = s.strike.a;
  m.strike_b = s.strike.b;
  m.damping_work = s.damping_work;
  m.damping_due = s.damping_due;
  return m;
}

template <bool dashpots>
EvaluatedFace evaluate(const FaceSet& c, const FaceScene& scene, double step,
                       const FaceFields& before, std::size_t k) {
  const FaceInputs in = inputs_of<dashpots>(c, scene, step, before, k);
  const EdgeGeometry stands = geometry_of_edges(in.at, in.pair);
  const Face face = face_between(stands, in.pair);
  const FaceStep s = step_of_face<dashpots, false, Formulas::all>(in, stands, face);
  return {state_of(face, s, dashpots), s.force, s.decides};
}

}  // namespace

EvaluatedFace evaluate_face(const FaceSet& c, const FaceScene& scene, double step,
                            const FaceFields& before, std::size_t k) {
  return c.dashpots ? evaluate<true>(c, scene, step, before, k)
                    : evaluate<false>(c, scene, step, before, k);
}

void decide_face(FaceSet& c, const FaceScene& scene, double step, const FaceFields& before,
                 std::size_t k) {
  const BlockSet& b = scene.blocks;
  const Pose& pose = scene.pose;
  EvaluatedFace now = evaluate_face(c, scene, step, before, k);
  if (now.undecided && decide_activity(c, b, pose, {before.energy > 0.0, before.gate > 0.0}, k))
    now = evaluate_face(c, scene, step, before, k);
  if (!c.bonded(k) && !c.carries_tension(k)) return;
  const bool softens = c.is(FaceFlag::softens, k);
  if (!softens && !bond_fails(c, b, now.state, k)) return;
  if (may_soften(c, scene.laws, k)) return soften_face(c, scene, k);
  const double stored = normal_energy(c, b, pose, k);
  break_bond(c, b, scene.laws, now.state, k);
  account_failure_energy(c, stored - normal_energy(c, b, pose, k), k);
}

void count_failures(FaceSet& c) {
  c.for_failures([&](std::size_t k) {
    if (c.is(FaceFlag::bond_breaks, k)) {
      ++c.broken;
      if (c.is(FaceFlag::broken_in_tension, k)) ++c.cracks_tension;
      if (c.is(FaceFlag::broken_in_shear, k)) ++c.cracks_shear;
    }
    c.set(FaceFlag::fails, k, false);
    c.set(FaceFlag::bond_breaks, k, false);
  });
  std::fill(c.group_fails.begin(), c.group_fails.end(), std::uint8_t{0});
}

Face face_at(const FaceSet& c, const BlockSet& b, const std::vector<double>& x,
             const std::vector<double>& y, std::size_t k, double risen) {
  FacePair pair = face_pair(c, b, k);
  pair.offset = {pair.offset.a - risen, pair.offset.b - risen};
  return face_between(face_points(c, x, y, k), pair);
}

FaceEnds slip_of(const FaceSet& c, const Face& face, const FacePoints& at, const FacePoints& then,
                 std::size_t k) {
  const auto corners = [&](const FacePoints& p) {
    return coordinates_of(p, c.inverse_e[k], c.inverse_f[k]);
  };
  return motion_of(face, corners(at), corners(then), c.inverse_e[k] / c.inverse_f[k]).slip;
}

}  // namespace edda
