#include "contacts/face_softening.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "contacts/face_bonds.hpp"
#include "contacts/face_energy.hpp"
#include "contacts/strength.hpp"

namespace edda {
namespace {

/// A crack that neither is closed nor opens further carries this part of the strength of its end:
/// the face goes on storing energy, and its shear springs remain.
constexpr double least_pull = 1e-6;

/// What an end carries as its crack opens.
struct EndLaw {
  double parted;   ///< w, m
  double broken;   ///< m: opening from which D = 1
  double whole;    ///< w_c, m
  double left;     ///< (1 - D) T L/2 at w, N
  double falls;    ///< T L/(2 w_c), N/m
  double holding;  ///< least_pull of T L/2, N
};

/// The opening g at which the end carries what it can, m, where it would carry the normal force
/// `normal` (N) at the opening `gap` and `spring` (N/m) more for each metre of opening.
double opening_under(const EndLaw& e, double normal, double gap, double spring) {
  const double at_ease = gap - (normal + e.holding) / spring;
  if (at_ease <= 0.0) return 0.0;
  if (at_ease <= e.parted) return at_ease;
  const double pull = spring * (at_ease - e.parted) + e.holding;
  if (pull <= e.left) return e.parted;
  const double until = spring > e.falls ? e.parted + (pull - e.left) / (spring - e.falls)
                                        : std::numeric_limits<double>::infinity();
  return until < e.broken ? until : at_ease;
}
/// The same, unless it is there but for rounding.
double next_opening(const EndLaw& e, double normal, double gap, double spring) {
  constexpr double rounding = 1e-12;  // of w_c
  const double next = opening_under(e, normal, gap, spring);
  return std::abs(next - gap) <= rounding * e.whole ? gap : next;
}

/// Normal forces at the ends per closure of them: own that of the end itself, N/m.
struct EndSprings {
  double own, other;
};
EndSprings springs_of(const Face& face, const FacePair& pair) {
  const double whole = pair.stiffness * face.gate * face.length;
  return {whole * (2.0 + face.share) / 6.0, whole * (1.0 - face.share) / 6.0};
}

/// Openings of both ends at which each carries what it can, m.
FaceEnds openings_under(const std::array<EndLaw, 2>& law, FaceEnds normal, FaceEnds gap,
                        EndSprings spring) {
  const FaceEnds had = gap;
  constexpr int most = 60;
  for (int n = 0; n < most; ++n) {
    const FaceEnds last = gap;
    const auto under = [&](double at_first, double own, double other) {
      return at_first + spring.own * own + spring.other * other;
    };
    gap.a = next_opening(law[0], under(normal.a, gap.a - had.a, gap.b - had.b), gap.a, spring.own);
    gap.b = next_opening(law[1], under(normal.b, gap.b - had.b, gap.a - had.a), gap.b, spring.own);
    if (gap.a == last.a && gap.b == last.b) break;
  }
  return gap;
}

FaceEnds parted_of(const FaceSet& c, std::size_t k) {
  return {c.parted_a[k], c.parted_b[k]};
}

/// Sets the present opening of the crack.
void open_to(FaceSet& c, FaceEnds gap, std::size_t k) {
  c.locked_closure_a[k] += gap.a - c.gap_a[k];
  c.locked_closure_b[k] += gap.b - c.gap_b[k];
  c.gap_a[k] = gap.a;
  c.gap_b[k] = gap.b;
}

/// Opens the crack of the face at the positions of the scene.
void open_crack(FaceSet& c, const FaceScene& scene, std::size_t k) {
  const Law& law = scene.laws.rows[c.law[k]];
  const FaceEnds parted = parted_of(c, k), damage = damage_of(c, scene.laws, k);
  const double by_slip = std::min(c.slip_so_far[k] / law.crack_slip, 1.0);
  constexpr int most = 8;
  for (int n = 0; n < most; ++n) {
    const Face face = face_at(c, scene.blocks, scene.pose.x, scene.pose.y, k);
    if (!(face.gate > 0.0) || !(face.length > 0.0)) return;
    const double whole = 0.5 * scene.laws.thickness * law.peak_tension * face.length;
    const auto end = [&](double w, double d) {
      return EndLaw{w,
                    (1.0 - by_slip) * law.crack_opening,
                    law.crack_opening,
                    (1.0 - d) * whole,
                    whole / law.crack_opening,
                    least_pull * whole};
    };
    const FaceEnds had{c.gap_a[k], c.gap_b[k]};
    const FaceEnds gap =
        openings_under({end(parted.a, damage.a), end(parted.b, damage.b)}, face.normal, had,
                       springs_of(face, face_pair(c, scene.blocks, k)));
    if (gap.a == had.a && gap.b == had.b) break;
    open_to(c, gap, k);
  }
  c.parted_a[k] = std::max(parted.a, c.gap_a[k]);
  c.parted_b[k] = std::max(parted.b, c.gap_b[k]);
}

/// A face without any normal force would lose its shear springs: it is pressed by next to nothing.
void keep_in_touch(FaceSet& c, const FaceScene& scene, std::size_t k) {
  constexpr double part = 1e-9;  // of w_c
  if (face_at(c, scene.blocks, scene.pose.x, scene.pose.y, k).energy > 0.0) return;
  const double least = part * scene.laws.rows[c.law[k]].crack_opening;
  open_to(c, {c.gap_a[k] + least, c.gap_b[k] + least}, k);
}

/// The face has lost its strength, by tension or by shear, whichever has done more of it.
void break_face(FaceSet& c, const LawTable& laws, std::size_t k) {
  const Law& law = laws.rows[c.law[k]];
  const double opening = 0.5 * (c.parted_a[k] + c.parted_b[k]) / law.crack_opening;
  const bool sheared = c.slip_so_far[k] / law.crack_slip > opening;
  open_to(c, {}, k);
  set_residual_strength(c, laws, k);
  c.set(FaceFlag::softens, k, false);
  c.set(sheared ? FaceFlag::broken_in_shear : FaceFlag::broken_in_tension, k);
  c.mark_failure(k, true);
}

void put_in_force_as_left(FaceSet& c, const LawTable& laws, std::size_t k) {
  const StrengthInputs in{.slip = c.slip_so_far[k], .parted = parted_of(c, k)};
  put_in_force(c, strength_of(laws, c.law[k], c.bond(k), in), k);
}

}  // namespace

FaceEnds damage_of(const Law& law, FaceEnds parted, double slip) {
  const double by_slip = slip / law.crack_slip;
  return {std::min(parted.a / law.crack_opening + by_slip, 1.0),
          std::min(parted.b / law.crack_opening + by_slip, 1.0)};
}

FaceEnds damage_of(const FaceSet& c, const LawTable& laws, std::size_t k) {
  return damage_of(laws.rows[c.law[k]], parted_of(c, k), c.slip_so_far[k]);
}

bool may_soften(const FaceSet& c, const LawTable& laws, std::size_t k) {
  return laws.rows[c.law[k]].softens && c.is(FaceFlag::carries_tension, k) &&
         (c.is(FaceFlag::intact, k) || c.is(FaceFlag::softens, k));
}

void soften_face(FaceSet& c, const FaceScene& scene, std::size_t k) {
  if (c.glued(k)) return;
  if (c.is(FaceFlag::intact, k)) {
    c.set_bond(BondState::unbonded, k);
    c.set(FaceFlag::softens, k);
  }
  const double stored = normal_energy(c, scene.blocks, scene.pose, k);
  const FaceEnds parted = parted_of(c, k);
  open_crack(c, scene, k);
  const bool grows = c.parted_a[k] > parted.a || c.parted_b[k] > parted.b;
  const FaceEnds damage = damage_of(c, scene.laws, k);
  if (grows) c.set(FaceFlag::opened, k);
  if (damage.a >= 1.0 && damage.b >= 1.0) {
    break_face(c, scene.laws, k);
  } else {
    keep_in_touch(c, scene, k);
    put_in_force_as_left(c, scene.laws, k);
  }
  // A crack that closes and opens again spends nothing: what its springs take then they give back.
  const double lost = stored - normal_energy(c, scene.blocks, scene.pose, k);
  if (grows || !c.is(FaceFlag::softens, k)) {
    account_failure_energy(c, lost, k);
  } else {
    c.transfer[k] += lost;
  }
}

void soften_by_slip(FaceSet& c, const BlockSet& b, const Pose& pose, const LawTable& laws,
                    const FaceFields& m, std::size_t k) {
  const double cut = std::abs(m.trial_a - m.slip_a) + std::abs(m.trial_b - m.slip_b);
  if (cut == 0.0) return;
  const double cohesive = face_at(c, b, pose.x1, pose.y1, k).cohesive;
  const double by_cohesion = std::min(0.5 * c.cohesion[k] * cohesive * cut, m.friction_work);
  c.friction_work[k] -= by_cohesion;
  c.fracture_work[k] += by_cohesion;
  c.slip_so_far[k] += 0.5 * cut;
  put_in_force_as_left(c, laws, k);
}

}  // namespace edda
