#include "contacts/face_bonds.hpp"

#include <algorithm>
#include <cmath>

#include "contacts/face_energy.hpp"
#include "contacts/face_reading.hpp"
#include "contacts/find_faces.hpp"
#include "contacts/joint_laws.hpp"
#include "contacts/place_faces.hpp"

namespace edda {
namespace {

/// Gap within which blocks touch, of the smaller block's size.
constexpr double touch = 1e-6;

/// Glues face k for a while. Only where both ends lie against each other does it pull: a corner
/// that leans holds along the edge alone.
void lend_glue(FaceSet& c, std::size_t k) {
  constexpr double flush = 1e-3;  // of the overlap
  const double least =
      std::min(c.now.closure_a[k] - c.offset_a[k], c.now.closure_b[k] - c.offset_b[k]);
  c.lent[k] = 1.0 + c.bonded[k] + 2.0 * c.pulls[k];
  c.glued[k] = c.bonded[k] = 1.0;
  if (least > -flush * c.now.length[k]) c.pulls[k] = 1.0;
}

}  // namespace

bool touch_as_drawn(const FaceSet& c, const BlockSet& b, const Pose& pose, const Face& face,
                    std::size_t k) {
  const FacePoints at = face_points(c, pose.x, pose.y, k);
  const double cosine = -dot(at.p2 - at.p1, at.q2 - at.q1) * c.inverse_e[k] * c.inverse_f[k];
  const double near = touch * smaller_size(c, b, k);
  return face.length > near && cosine >= lies_along &&
         std::abs(std::max(face.closure.a, face.closure.b)) <= near;
}

void take_residual(FaceSet& c, const LawTable& laws, std::size_t k) {
  const Law& law = laws.rows[c.law[k]];
  c.friction[k] = law.residual_friction;
  c.cohesion[k] = law.residual_cohesion * laws.thickness;
  c.tension[k] = law.residual_tension * laws.thickness;
  c.pulls[k] = law.residual_tension > 0.0 ? 1.0 : 0.0;
  c.slid[k] = first_slip(law);
}

void bond_faces(FaceSet& c, const BlockSet& b, const Pose& pose, const LawTable& laws) {
  bool changes = false;
  for (std::size_t k = 0; k < c.size(); ++k) {
    const Id e = c.edge[k], f = c.facing[k];
    const std::uint16_t drawn =
        laws.resolve(b.edge_joint[e], b.edge_joint[f], b.material[b.vertex_block[e]],
                     b.material[b.vertex_block[f]]);
    const Law& law = laws.rows[drawn];
    const bool weakens = law.type == LawType::slip_weakening;
    const bool has_bond = weakens || law.glued || law.peak_cohesion > 0.0 ||
                          law.peak_tension > 0.0 || law.peak_friction > law.residual_friction;
    const bool other = drawn != c.law[k];
    if (!has_bond && !other) continue;
    const Face face = face_at(c, b, pose.x, pose.y, k);
    if (!touch_as_drawn(c, b, pose, face, k)) continue;
    if (other) {
      c.law[k] = drawn;
      take_residual(c, laws, k);
      c.pulls[k] = 0.0;
      changes = true;
    }
    if (!has_bond) continue;
    const bool flush = std::min(face.closure.a, face.closure.b) >= -touch * smaller_size(c, b, k);
    c.acts[k] = c.leans[k] = 1.0;
    if (weakens) c.slid[k] = 0.0;
    c.bonded[k] = weakens ? 0.0 : 1.0;
    c.glued[k] = law.glued ? 1.0 : 0.0;
    c.pulls[k] = flush && (law.glued || law.peak_tension > 0.0) ? 1.0 : 0.0;
    c.friction[k] = law.peak_friction;
    c.cohesion[k] = law.peak_cohesion * laws.thickness;
    c.tension[k] = law.peak_tension * laws.thickness;
  }
  if (changes) complete_faces(c, b, laws);
  note_bonds(c);
}

bool gives_way(const FaceSet& c, const BlockSet& b, std::size_t k) {
  if (c.glued[k] > 0.0) return false;
  const FaceMemory& m = c.now;
  const double least = std::min(m.closure_a[k], m.closure_b[k]);
  const double largest = std::max(m.closure_a[k], m.closure_b[k]);
  if (c.pulls[k] > 0.0 && -c.stiffness[k] * least > c.tension[k]) return true;
  if (c.bonded[k] == 0.0) return false;
  if (c.pulls[k] == 0.0 && largest < -touch * smaller_size(c, b, k)) return true;
  const double shear = std::abs(m.shear_a[k] + m.shear_b[k]);
  const double rounding = 2.0 * m.spring[k] * c.noise;
  return shear >
         rounding + c.cohesion[k] * m.cohesive[k] + c.friction[k] * (m.normal_a[k] + m.normal_b[k]);
}

void break_bond(FaceSet& c, const LawTable& laws, std::size_t k) {
  const bool was_bonded = c.bonded[k] > 0.0;
  c.bonded[k] = 0.0;
  if (was_bonded) take_residual(c, laws, k);
  c.tear(k, was_bonded ? bond_breaks : 1.0);
  // Torn by more than what is left, too.
  const double least = std::min(c.now.closure_a[k], c.now.closure_b[k]);
  if (-c.stiffness[k] * least > c.tension[k]) c.pulls[k] = 0.0;
  c.opened[k] = 1.0;
}

void take_lost_energy(FaceSet& c, double lost, std::size_t k) {
  c.fracture_work[k] += std::max(lost, 0.0);
  c.transfer[k] += std::min(lost, 0.0);
}

void glue_faces(FaceSet& c) {
  c.gluing = true;
  for (std::size_t k = 0; k < c.size(); ++k) {
    if (meets(c, k) && c.glued[k] == 0.0) lend_glue(c, k);
  }
  note_bonds(c);
}

void glue_pressed(FaceSet& c) {
  bool any = false;
  for (std::size_t k = 0; k < c.size(); ++k) {
    if (c.glued[k] > 0.0 || c.before.energy[k] == 0.0 || c.now.energy[k] == 0.0) continue;
    lend_glue(c, k);
    any = true;
  }
  if (any) note_bonds(c);
}

void unglue_faces(FaceSet& c, const BlockSet& b, const Pose& pose) {
  c.gluing = false;
  for (std::size_t k = 0; k < c.size(); ++k) {
    if (c.lent[k] == 0.0) continue;
    const double had = c.lent[k] - 1.0, stored = normal_energy(c, b, pose, k);
    c.glued[k] = 0.0;
    c.pulls[k] = had >= 2.0 ? 1.0 : 0.0;
    c.bonded[k] = had == 1.0 || had == 3.0 ? 1.0 : 0.0;
    c.lent[k] = 0.0;
    take_lost_energy(c, stored - normal_energy(c, b, pose, k), k);
    c.tear(k, 1.0);
  }
  note_bonds(c);
}

void set_face_dashpots(FaceSet& c, const LawTable& laws, double damping) {
  // Those that are taken away have still to do their work of the step in hand.
  c.dashpots = damping > 0.0 || laws.any_dashpots || c.dashpots;
  for (auto* column : {&c.before.damping_a, &c.before.damping_b, &c.before.drag_a, &c.before.drag_b,
                       &c.before.damping_work, &c.before.damping_due}) {
    if (!c.dashpots) column->fill(0.0);
  }
  for (std::size_t k = 0; k < c.size(); ++k) {
    const Law& law = laws.rows[c.law[k]];
    c.zeta[k] = laws.damping_of(law, damping);
    c.shear_zeta[k] = law.dashpots ? law.shear_damping : 0.0;
  }
}

void note_bonds(FaceSet& c) {
  c.bonds.assign(c.chunks(), 0);
  for (std::size_t k = 0; k < c.size(); ++k) {
    if (c.bonded[k] > 0.0 || c.pulls[k] > 0.0) c.bonds[k / FaceSet::chunk] = 1;
  }
}

}  // namespace edda
