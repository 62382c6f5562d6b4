#include "forces/contact_forces.hpp"

#include <algorithm>
#include <cmath>

#include "base/parallel.hpp"
#include "contacts/gap.hpp"
#include "contacts/stored_energy.hpp"
#include "contacts/switching.hpp"

namespace edda {
namespace {

namespace cs = contact_state;

double quadratic_form(const BlockSet& b, std::size_t i, double w0, double w1, double w2) {
  if (b.fixed[i]) return 0.0;
  if (b.mass_kind != MassKind::consistent) {
    return w0 * w0 / b.node_mass[0][i] + w1 * w1 / b.node_mass[1][i] + w2 * w2 / b.node_mass[2][i];
  }
  const auto& m = b.inverse_mass;
  return w0 * (m[0][i] * w0 + 2.0 * m[1][i] * w1 + 2.0 * m[2][i] * w2) +
         w1 * (m[3][i] * w1 + 2.0 * m[4][i] * w2) + w2 * m[5][i] * w2;
}

/// Shear by the return map; books the slip: p_t (s_tr - s)(s + s_{n-1})/2 (method.md section 4).
void return_map(ContactSet& c, std::size_t k) {
  const double trial = -c.ks[k] * c.slip_trial[k];
  if (c.is(k, cs::bonded)) {
    c.shear[k] = trial;
    return;
  }
  const double limit = c.shear_limit(k, c.normal[k]);
  const double kept = cut_shear(trial, limit);
  c.clear(k, cs::sliding);
  if (kept != trial) {
    c.set(k, cs::sliding | cs::slipped);
    const double s = -kept / c.ks[k], s_1 = -c.shear_1[k] / c.ks[k];
    c.anchor[k] = (c.foot[k] - s) / c.span[k];
    c.friction_work[k] += 0.5 * c.share[k] * c.ks[k] * (c.slip_trial[k] - s) * (s + s_1);
  }
  c.shear[k] = kept;
}

void let_go(ContactSet& c, std::size_t k) {
  c.clear(k, cs::closed | cs::bonded | cs::pulls | cs::sliding);
  c.set(k, cs::opened);
}

/// A contact whose tensile strength is spent opens; what it stores is fracture energy.
void tear(ContactSet& c, std::size_t k) {
  const double before = c.effective_1(k), now = c.effective(k), slip = -c.shear_1[k] / c.ks[k];
  const double normal = c.is(k, cs::pulls) || (before > 0.0 && now > 0.0) ? before * now : 0.0;
  const double stored = 0.5 * c.share[k] * (c.kn[k] * normal + c.ks[k] * slip * c.slip_trial[k]);
  c.fracture_work[k] += std::max(stored, 0.0);
  let_go(c, k);
  c.normal[k] = c.shear[k] = c.shear_1[k] = c.slip_trial[k] = c.dashpot[k] = 0.0;
  c.rest[k] = std::max(0.0, std::min(c.rest[k], c.depth[k]));
  c.fx[k] = c.fy[k] = c.gx[k] = c.gy[k] = 0.0;
}

void evaluate(ContactSet& c, const BlockSet& b, std::size_t k, double step, double damping) {
  if (!c.is(k, cs::closed)) {
    c.fx[k] = c.fy[k] = c.gx[k] = c.gy[k] = 0.0;
    return;
  }
  set_normal_force(c, b, k, step, damping);
  c.shear_1[k] = c.shear[k];
  c.slip_trial[k] = trial_slip(c, k);
  return_map(c, k);
  if (c.is(k, cs::pulls) && !c.is(k, cs::bonded) && c.normal[k] < -c.tension[k]) {
    tear(c, k);
    return;
  }
  set_contact_force(c, k, tangent_of(c, k), c.span[k], c.foot[k], c.depth[k]);
}

/// Whether the bonded contacts of one pair of edges fail together: |sum T| > c L + tan(phi) sum N,
/// or one of them tears. A joint without tensile strength tears where it gapes by more than 1e-6 of
/// the smaller block's size, the gap within which contacts are bonded in the first place: at rest N
/// is zero but for rounding, and rounding must not decide.
bool fails(const ContactSet& c, const BlockSet& b, const LawTable& laws, const Segment& segment) {
  double shear = 0.0, normal = 0.0, cohesion = 0.0, friction = 0.0;
  for (const Id k : segment.members) {
    if (laws.rows[c.law[k]].glued) return false;
    shear += c.share[k] * c.shear[k];
    normal += c.share[k] * c.normal[k];
    cohesion += c.share[k] * c.cohesion[k];
    friction = std::max(friction, c.friction[k]);
    if (c.share[k] == 0.0) continue;
    if (c.is(k, cs::pulls)) {
      if (c.normal[k] < -c.tension[k]) return true;
    } else {
      const double size = std::sqrt(std::min(b.area[c.block_i[k]], b.area[c.block_j[k]]));
      if (c.effective(k) < -1e-6 * size) return true;
    }
  }
  return std::abs(shear) > cohesion + friction * normal;
}

/// From the peak to the residual law. True if the contact lets go altogether.
bool take_residual_law(ContactSet& c, const LawTable& laws, Id k) {
  const Law& law = laws.rows[c.law[k]];
  const double strength = law.residual_tension * c.length[k] * laws.thickness;
  c.clear(k, cs::bonded);
  c.friction[k] = law.residual_friction;
  c.cohesion[k] = law.residual_cohesion * c.length[k] * laws.thickness;
  if (c.normal[k] < -strength || (c.effective(k) <= 0.0 && strength == 0.0)) return true;
  if (strength == 0.0) c.clear(k, cs::pulls);
  c.tension[k] = strength;
  return false;
}

/// From the peak to the residual law, at once.
void break_bond(ContactSet& c, const BlockSet& b, const LawTable& laws, Id k, double step,
                double damping) {
  if (take_residual_law(c, laws, k)) {
    tear(c, k);
    return;
  }
  // What the peak strength held is released by the return map; it is fracture energy, not friction.
  const double friction_before = c.friction_work[k];
  c.shear[k] = c.shear_1[k];
  evaluate(c, b, k, step, damping);
  c.fracture_work[k] += std::max(0.0, c.friction_work[k] - friction_before);
  c.friction_work[k] = friction_before;
}

/// Calls break_one(k) for every contact of the bonded segments that fail, and lets these go.
template <class Break>
void break_failed(ContactSet& c, const BlockSet& b, const LawTable& laws, Break break_one) {
  for (Segment& segment : c.segments) {
    if (!fails(c, b, laws, segment)) continue;
    for (const Id k : segment.members) break_one(k);
    segment.members.clear();
  }
  std::erase_if(c.segments, [](const Segment& s) { return s.members.empty(); });
}

}  // namespace

ContactForce contact_force(Vec2 t, double l, double foot, double depth, double anchor,
                           double normal, double shear) {
  const Vec2 n = outward_normal(t);
  const double xi = foot / l, lift = -depth / l;  // g/l
  const Vec2 f1 = normal * n + shear * t;
  const Vec2 f3 = -xi * normal * n - shear * (anchor * t - lift * n);
  return {f1, -(f1 + f3), f3};
}

double inverse_contact_mass(const BlockSet& b, const ContactSet& c, std::size_t k, double xi) {
  const Id v = c.vertex[k], p = c.edge[k], q = c.edge_end[k];
  auto foot = [&](std::size_t node) {
    return (1.0 - xi) * b.weight[node][p] + xi * b.weight[node][q];
  };
  return quadratic_form(b, c.block_i[k], b.weight[0][v], b.weight[1][v], b.weight[2][v]) +
         quadratic_form(b, c.block_j[k], foot(0), foot(1), foot(2));
}

double dashpot_coefficient(const ContactSet& c, const BlockSet& b, std::size_t k, double damping) {
  return 2.0 * damping * std::sqrt(c.kn[k] / inverse_contact_mass(b, c, k, c.foot[k] / c.span[k]));
}

void set_normal_force(ContactSet& c, const BlockSet& b, std::size_t k, double step,
                      double damping) {
  const bool pulls = c.is(k, cs::pulls);
  c.alpha[k] = 1.0;
  c.normal[k] = c.kn[k] * (pulls ? c.effective(k) : std::max(c.effective(k), 0.0));
  c.dashpot[k] = 0.0;
  if (damping > 0.0 && (pulls || c.effective(k) > 0.0)) {
    const double damped =
        c.normal[k] + dashpot_coefficient(c, b, k, damping) * (c.depth[k] - c.depth_1[k]) / step;
    const double total = pulls ? damped : std::max(0.0, damped);
    c.dashpot[k] = total - c.normal[k];
    c.normal[k] = total;
  }
}

void set_contact_force(ContactSet& c, std::size_t k, Vec2 t, double l, double foot, double depth) {
  const double w = c.share[k];
  const ContactForce f =
      contact_force(t, l, foot, depth, c.anchor[k], w * c.alpha[k] * c.normal[k], w * c.shear[k]);
  c.fx[k] = f.f1.x;
  c.fy[k] = f.f1.y;
  c.gx[k] = f.f2.x;
  c.gy[k] = f.f2.y;
}

void evaluate_contacts(ContactSet& c, const BlockSet& b, const LawTable& laws, double step,
                       double damping) {
  parallel_for(c.size(), [&](std::size_t k) { evaluate(c, b, k, step, damping); });
  break_failed(c, b, laws, [&](Id k) { break_bond(c, b, laws, k, step, damping); });
}

std::vector<Id> break_overloaded(ContactSet& c, const BlockSet& b, const LawTable& laws) {
  std::vector<Id> broken;
  break_failed(c, b, laws, [&](Id k) {
    if (take_residual_law(c, laws, k)) let_go(c, k);
    broken.push_back(k);
  });
  for (std::size_t k = 0; k < c.size(); ++k) {
    if (!c.is(k, cs::pulls) || c.is(k, cs::bonded) || !(c.normal[k] < -c.tension[k])) continue;
    let_go(c, static_cast<Id>(k));
    broken.push_back(static_cast<Id>(k));
  }
  return broken;
}

}  // namespace edda
