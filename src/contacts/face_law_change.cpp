#include "contacts/face_law_change.hpp"

#include <algorithm>
#include <cmath>

#include "contacts/evaluate_face.hpp"
#include "contacts/face_bonds.hpp"
#include "contacts/find_faces.hpp"
#include "contacts/strength.hpp"

namespace edda {
namespace {

/// What a face was before its law changed.
struct Before {
  std::size_t face;
  std::uint16_t law;
  double stiffness, shear_stiffness;
};

/// Whether the face has lost nothing of the strength of its law.
bool is_whole(const FaceSet& c, const Law& law, std::size_t k) {
  if (c.is(FaceFlag::opened, k) || c.is(FaceFlag::slipped, k)) return false;
  if (law.type == LawType::slip_weakening) return std::isfinite(c.slip_so_far[k]);
  return !may_weaken(law) || c.bond(k) == BondState::intact;
}

bool is_flush(const FaceSet& c, const BlockSet& b, const Face& face, std::size_t k) {
  return std::min(face.closure.a, face.closure.b) >= -touching_gap * smaller_size(c, b, k);
}

/// The strength of the new law, by what has become of the face so far.
void take_strength(FaceSet& c, const BlockSet& b, const Pose& pose, const LawTable& laws,
                   const Before& was, const Face& face) {
  const std::size_t k = was.face;
  const Law &from = laws.rows[was.law], &law = laws.rows[c.law[k]];
  const bool weakens = law.type == LawType::slip_weakening;
  const bool whole = is_whole(c, from, k) && may_weaken(law) &&
                     (c.bonded(k) || touch_as_drawn(c, b, pose, face, k, drawn_gap));
  const bool cracked = c.bond(k) == BondState::cracked && may_weaken(law) && !weakens;
  const double slip = std::isfinite(c.slip_so_far[k]) ? c.slip_so_far[k] : 0.0;
  const double started = whole || !weakens ? slip : first_slip(law);
  set_bond(c, laws,
           whole && !weakens ? BondState::intact
           : cracked         ? BondState::cracked
                             : BondState::unbonded,
           started, k);
  c.set(FaceFlag::glued, k, whole && law.glued);
  if (whole)
    c.set(FaceFlag::carries_tension, k,
          is_flush(c, b, face, k) && (law.glued || law.peak_tension > 0.0));
}

/// Lets the face carry what it has carried with its new stiffness.
void keep_forces(FaceSet& c, FaceStates& states, const BlockSet& b, const Pose& pose,
                 const Before& was, const Face& face) {
  const std::size_t k = was.face;
  const double softer = was.stiffness / c.stiffness[k];
  if (c.carries_tension(k) || std::max(face.closure.a, face.closure.b) > 0.0) {
    c.locked_closure_a[k] += (softer - 1.0) * face.closure.a;
    c.locked_closure_b[k] += (softer - 1.0) * face.closure.b;
  }
  take_element(states.now[k], face_at(c, b, pose.x, pose.y, k));
  take_element(states.before[k], face_at(c, b, pose.x1, pose.y1, k));
  const double softer_in_shear = was.shear_stiffness / c.shear_stiffness[k];
  for (FaceFields* of : {&states.now[k], &states.before[k]}) {
    for (double* slip : {&of->slip_a, &of->slip_b, &of->trial_a, &of->trial_b})
      *slip *= softer_in_shear;
    of->spring /= softer_in_shear;
  }
}

}  // namespace

void change_laws(FaceSet& c, FaceStates& states, const BlockSet& old, const BlockSet& b,
                 const Pose& pose, const LawTable& laws, const std::vector<std::uint8_t>& changed) {
  std::vector<Before> change;
  for (std::size_t k = 0; k < c.size(); ++k) {
    if (changed[c.edge[k]] == 0 && changed[c.facing[k]] == 0) continue;
    const bool drawn = c.law[k] == law_between(laws, old, c.edge[k], c.facing[k], true);
    const std::uint16_t law = law_between(laws, b, c.edge[k], c.facing[k], drawn);
    if (law == c.law[k]) continue;
    change.push_back({k, c.law[k], c.stiffness[k], c.shear_stiffness[k]});
    c.law[k] = law;
  }
  if (change.empty()) return;
  complete_faces(c, b, laws);
  for (const Before& was : change) {
    const Face face = face_at(c, b, pose.x, pose.y, was.face);
    take_strength(c, b, pose, laws, was, face);
    keep_forces(c, states, b, pose, was, face);
  }
}

namespace {

bool is_as_stiff(const Law& a, const Law& b) {
  return a.kn == b.kn && a.ks == b.ks;
}

}  // namespace

bool is_as_stiff(const LawTable& old, const LawTable& laws) {
  return std::equal(old.rows.begin(), old.rows.end(), laws.rows.begin(),
                    [](const Law& a, const Law& b) { return is_as_stiff(a, b); });
}

void follow_laws(FaceSet& c, FaceStates& states, const BlockSet& b, const Pose& pose,
                 const LawTable& old, const LawTable& laws) {
  std::vector<Before> change;
  for (std::size_t k = 0; k < c.size(); ++k) {
    const Law &was = old.rows[c.law[k]], &law = laws.rows[c.law[k]];
    if (!is_as_stiff(was, law))
      change.push_back({k, c.law[k], c.stiffness[k], c.shear_stiffness[k]});
    if (c.bond(k) == BondState::intact && was.peak_tension == 0.0 && law.peak_tension > 0.0 &&
        is_flush(c, b, face_at(c, b, pose.x, pose.y, k), k))
      c.set(FaceFlag::carries_tension, k);
  }
  if (change.empty()) return;
  complete_faces(c, b, laws);
  for (const Before& was : change)
    keep_forces(c, states, b, pose, was, face_at(c, b, pose.x, pose.y, was.face));
}

}  // namespace edda
