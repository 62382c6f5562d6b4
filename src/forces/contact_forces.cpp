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
  const double limit = c.cohesion[k] + std::max(c.normal[k], 0.0) * c.friction[k];
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

void evaluate(ContactSet& c, const BlockSet& b, std::size_t k, double step, double damping) {
  if (!c.is(k, cs::closed)) {
    c.fx[k] = c.fy[k] = c.gx[k] = c.gy[k] = 0.0;
    return;
  }
  c.alpha[k] = 1.0;
  c.normal[k] = c.kn[k] * c.effective(k);
  c.dashpot[k] = 0.0;
  if (damping > 0.0) {
    const double coefficient =
        2.0 * damping * std::sqrt(c.kn[k] / inverse_contact_mass(b, c, k, c.foot[k] / c.span[k]));
    const double damped = c.normal[k] + coefficient * (c.depth[k] - c.depth_1[k]) / step;
    const double total = c.is(k, cs::bonded) ? damped : std::max(0.0, damped);
    c.dashpot[k] = total - c.normal[k];
    c.normal[k] = total;
  }
  c.shear_1[k] = c.shear[k];
  c.slip_trial[k] = trial_slip(c, k);
  return_map(c, k);
  set_contact_force(c, k, tangent_of(c, k), c.span[k], c.foot[k], c.depth[k]);
}

/// Whether the bonded contacts of one pair of edges fail together: |sum T| > c L + tan(phi) sum N,
/// or one of them is pulled beyond its tensile strength.
bool fails(const ContactSet& c, const LawTable& laws, const Segment& segment) {
  double shear = 0.0, normal = 0.0, cohesion = 0.0, friction = 0.0;
  for (const Id k : segment.members) {
    const Law& law = laws.rows[c.law[k]];
    if (law.glued) return false;
    shear += c.share[k] * c.shear[k];
    normal += c.share[k] * c.normal[k];
    cohesion += c.share[k] * c.cohesion[k];
    friction = std::max(friction, c.friction[k]);
    const double strength = law.peak_tension * c.length[k] * laws.thickness;
    if (c.share[k] > 0.0 && c.normal[k] < -strength) return true;
  }
  return std::abs(shear) > cohesion + friction * normal;
}

void break_bond(ContactSet& c, const BlockSet& b, const LawTable& laws, Id k, double step,
                double damping) {
  const Law& law = laws.rows[c.law[k]];
  c.clear(k, cs::bonded);
  c.friction[k] = law.residual_friction;
  c.cohesion[k] = law.residual_cohesion * c.length[k] * laws.thickness;
  const double e = c.effective(k), e_1 = c.effective_1(k);
  if (e <= 0.0) {
    const double slip = -c.shear_1[k] / c.ks[k];
    c.fracture_work[k] += 0.5 * c.share[k] * (c.kn[k] * e * e_1 + c.ks[k] * slip * c.slip_trial[k]);
    c.clear(k, cs::closed | cs::sliding);
    c.set(k, cs::opened);
    c.normal[k] = c.shear[k] = c.shear_1[k] = c.dashpot[k] = 0.0;
    c.rest[k] = 0.0;
    c.fx[k] = c.fy[k] = c.gx[k] = c.gy[k] = 0.0;
    return;
  }
  // What the cohesion held is released by the return map; it is fracture energy, not friction.
  const double friction_before = c.friction_work[k];
  c.shear[k] = c.shear_1[k];
  evaluate(c, b, k, step, damping);
  c.fracture_work[k] += c.friction_work[k] - friction_before;
  c.friction_work[k] = friction_before;
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
  for (Segment& segment : c.segments) {
    if (!fails(c, laws, segment)) continue;
    for (const Id k : segment.members) break_bond(c, b, laws, k, step, damping);
    segment.members.clear();
  }
  std::erase_if(c.segments, [](const Segment& s) { return s.members.empty(); });
}

}  // namespace edda
