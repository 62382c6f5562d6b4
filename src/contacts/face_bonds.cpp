#include "contacts/face_bonds.hpp"

#include <algorithm>
#include <cmath>

#include "contacts/evaluate_face.hpp"
#include "contacts/face_energy.hpp"
#include "contacts/face_reading.hpp"
#include "contacts/find_faces.hpp"
#include "contacts/joint_strength.hpp"
#include "contacts/strength.hpp"

namespace edda {
namespace {

BondFailure failure_now(const FaceSet& c, const BlockSet& b, const FaceFields& now, std::size_t k) {
  return failure_of({c.bonded(k), c.carries_tension(k), c.glued(k), c.friction[k], c.cohesion[k],
                     c.tension[k], c.bond_strength, drawn_gap * smaller_size(c, b, k)},
                    {{now.closure_a, now.closure_b},
                     {now.normal_a, now.normal_b},
                     now.shear_a + now.shear_b,
                     now.spring,
                     now.length,
                     now.cohesive},
                    c.noise);
}

}  // namespace

bool touch_as_drawn(const FaceSet& c, const BlockSet& b, const Pose& pose, const Face& face,
                    std::size_t k, double gap) {
  const FacePoints at = face_points(c, pose.x, pose.y, k);
  const double cosine = -dot(at.p2 - at.p1, at.q2 - at.q1) * c.inverse_e[k] * c.inverse_f[k];
  const double size = smaller_size(c, b, k);
  return face.length > touching_gap * size && cosine >= lies_along &&
         std::abs(std::max(face.closure.a, face.closure.b)) <= gap * size;
}

namespace {

/// Lets a bonded joint be closed without stress where drawing has left a gap or an overlap. It is
/// one from the beginning, so that its first step decides nothing of it (decide_activity()).
void fit(FaceSet& c, FaceStates& states, const BlockSet& b, const Face& face, std::size_t k) {
  const double most = drawn_gap * smaller_size(c, b, k);
  const auto correction = [&](double closure) {
    const double off = std::abs(closure);
    return off > most || off <= c.noise ? 0.0 : -closure;
  };
  c.locked_closure_a[k] += correction(face.closure.a);
  c.locked_closure_b[k] += correction(face.closure.b);
  states.before[k].gate = face.gate;
}

}  // namespace

void bond_faces(FaceSet& c, FaceStates& states, const BlockSet& b, const Pose& pose,
                const LawTable& laws, const std::vector<std::uint8_t>* of_blocks) {
  bool changes = false;
  for (std::size_t k = 0; k < c.size(); ++k) {
    const Id e = c.edge[k], f = c.facing[k];
    if (of_blocks != nullptr && (*of_blocks)[b.vertex_block[e]] == 0 &&
        (*of_blocks)[b.vertex_block[f]] == 0)
      continue;
    const std::uint16_t drawn = law_between(laws, b, e, f, true);
    const Law& law = laws.rows[drawn];
    const bool weakens = law.type == LawType::slip_weakening, has_bond = may_weaken(law);
    const bool other = drawn != c.law[k];
    if (!has_bond && !other) continue;
    Face face = face_at(c, b, pose.x, pose.y, k);
    if (!touch_as_drawn(c, b, pose, face, k, drawn_gap)) continue;
    if (other) {
      c.law[k] = drawn;
      set_residual_strength(c, laws, k);
      c.set(FaceFlag::carries_tension, k, false);
      changes = true;
    }
    if (!has_bond) continue;
    fit(c, states, b, face, k);
    face = face_at(c, b, pose.x, pose.y, k);
    const bool flush =
        std::min(face.closure.a, face.closure.b) >= -touching_gap * smaller_size(c, b, k);
    c.set(FaceFlag::acts, k);
    c.set(FaceFlag::leans, k);
    set_bond(c, laws, weakens ? BondState::unbonded : BondState::intact, 0.0, k);
    c.set(FaceFlag::glued, k, law.glued);
    c.set(FaceFlag::carries_tension, k, flush && (law.glued || law.peak_tension > 0.0));
  }
  if (changes) complete_faces(c, b, laws);
}

bool bond_fails(const FaceSet& c, const BlockSet& b, const FaceFields& now, std::size_t k) {
  return failure_now(c, b, now, k).any();
}

void break_bond(FaceSet& c, const BlockSet& b, const LawTable& laws, const FaceFields& now,
                std::size_t k) {
  // A flexural crack (mode I), from one end while the other is pressed, keeps its shear strength.
  const bool cracks = c.bonded(k) && c.carries_tension(k) &&
                      std::max(now.closure_a, now.closure_b) > 0.0 &&
                      !failure_now(c, b, now, k).sheared;
  const bool breaks = c.bonded(k) && !cracks;
  if (breaks) set_residual_strength(c, laws, k);
  if (cracks) set_bond(c, laws, BondState::cracked, c.slip_so_far[k], k);
  c.mark_failure(k, breaks);
  // The face releases altogether if its tension exceeds the residual tensile strength, too.
  if (failure_now(c, b, now, k).torn) c.set(FaceFlag::carries_tension, k, false);
  c.set(FaceFlag::opened, k);
}

void account_failure_energy(FaceSet& c, double lost, std::size_t k) {
  c.fracture_work[k] += std::max(lost, 0.0);
  c.transfer[k] += std::min(lost, 0.0);
}

void glue_faces(FaceSet& c, const FaceStates& states, bool also_later) {
  c.gluing = also_later;
  for (std::size_t k = 0; k < c.size(); ++k) {
    const FaceFields& m = states.now[k];
    const FaceEnds drawn{m.closure_a - c.locked_closure_a[k], m.closure_b - c.locked_closure_b[k]};
    if (!c.glued(k) && meets_within(FaceRow{c, k, m, {}, false, false}, c.noise) &&
        lies_flush_as_drawn(drawn, m.length))
      c.set(FaceFlag::glued_by_stage, k);
  }
}

bool glue_if_whole(FaceSet& c, FaceEnds closure, std::size_t k) {
  if (std::min(closure.a, closure.b) < 0.0) return false;
  c.set(FaceFlag::glued_by_stage, k);
  return true;
}

void unglue_faces(FaceSet& c, const BlockSet& b, const Pose& pose) {
  c.gluing = false;
  for (std::size_t k = 0; k < c.size(); ++k) {
    if (!c.is(FaceFlag::glued_by_stage, k)) continue;
    const double stored = normal_energy(c, b, pose, k);
    c.set(FaceFlag::glued_by_stage, k, false);
    account_failure_energy(c, stored - normal_energy(c, b, pose, k), k);
    c.mark_failure(k, false);
  }
}

void set_face_dashpots(FaceSet& c, const LawTable& laws, double damping) {
  // Dashpots that are removed have yet to do their work of the current step.
  c.dashpots = damping > 0.0 || laws.any_dashpots || c.dashpots;
  for (std::size_t r = 0; r < laws.rows.size(); ++r) {
    const Law& law = laws.rows[r];
    c.of_laws[r].zeta = laws.damping_of(law, damping);
    c.of_laws[r].shear_zeta = law.dashpots ? law.shear_damping : 0.0;
    c.of_laws[r].rebound = law.dashpots ? law.rebound : 0.0;
  }
}

}  // namespace edda
