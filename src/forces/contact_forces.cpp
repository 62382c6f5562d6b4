#include "forces/contact_forces.hpp"

#include <algorithm>
#include <cmath>

#include "base/parallel.hpp"
#include "base/vector_loop.hpp"
#include "blocks/point_mass.hpp"
#include "contacts/candidates.hpp"
#include "contacts/gap.hpp"
#include "contacts/stored_energy.hpp"
#include "contacts/switching.hpp"

namespace edda {
namespace {

namespace cs = contact_state;

void let_go(ContactSet& c, std::size_t k) {
  c.clear(k, cs::closed | cs::bonded | cs::pulls | cs::sliding);
  c.set(k, cs::opened);
}

}  // namespace

void tear(ContactSet& c, std::size_t k) {
  const double before = c.effective_1(k), now = c.effective(k), slip = -c.shear_1[k] / c.ks[k];
  const double slip_now = c.slip_before_cut(k);
  const double normal = c.is(k, cs::pulls) || (before > 0.0 && now > 0.0) ? before * now : 0.0;
  const double stored = 0.5 * c.share[k] * (c.kn[k] * normal + c.ks[k] * slip * slip_now);
  c.fracture_work[k] += std::max(stored, 0.0);
  let_go(c, k);
  c.normal[k] = c.shear[k] = c.shear_1[k] = c.slip_trial[k] = 0.0;
  if (!c.drag.empty()) c.drag[k] = 0.0;
  c.rest[k] = std::max(0.0, std::min(c.rest[k], c.depth[k]));
  clear_contact_force(c, k);
}

namespace {

/// N of the spring alone.
template <class Contacts>
EDDA_INLINE double spring_normal(const Contacts& c, std::size_t k) {
  const double e = c.effective(k), n = c.kn[k] * (may_pull(c.hold[k]) ? e : larger(e, 0.0));
  return carries(c.hold[k]) ? n : 0.0;
}

/// Dashpots of all contacts; what of the blocks decides them.
struct ContactDashpots {
  double damping, step;  ///< zeta; s
  bool by_law;           ///< laws have their own
  const double *point_inverse, *edge_inverse;
};

/// Without a step there is no rate.
ContactDashpots dashpots_of(const ContactSet& c, const BlockSet& b, double damping, double step) {
  return {damping, step, !c.zeta.empty() && step > 0.0, b.point_inverse.data(),
          b.edge_inverse.data()};
}

/// 1/m_c at the foot of k.
template <class Blocks, class Contacts>
EDDA_INLINE double inverse_mass_at(const Blocks& b, const Contacts& c, std::size_t k, double xi) {
  return b.point_inverse[c.vertex[k]] + inverse_mass_on_edge(b, c.edge[k], c.edge_end[k], xi);
}

/// c = 2 zeta sqrt(p m_c).
template <class Blocks, class Contacts>
EDDA_INLINE double coefficient(const Blocks& b, const Contacts& c, std::size_t k, double damping) {
  const double xi = c.foot[k] / c.span[k];
  return 2.0 * damping * std::sqrt(c.kn[k] / inverse_mass_at(b, c, k, xi));
}

/// N with what the dashpot does; `damping` zeta.
template <class Contacts>
EDDA_INLINE double damped_normal(const Contacts& c, std::size_t k, double spring,
                                 const ContactDashpots& d, double damping) {
  const double hold = c.hold[k];
  const double rate = (c.depth[k] - c.depth_1[k]) / d.step;
  const double damped = spring + coefficient(d, c, k, damping) * rate;
  const double pushing = larger(damped, 0.0);
  const bool carrying = carries(hold), pulling = may_pull(hold), inside = c.effective(k) > 0.0;
  const bool acts = carrying & (pulling | inside);
  return acts ? (pulling ? damped : pushing) : spring;
}

/// T by the return map.
struct Cut {
  double trial_slip, kept;
  bool slid;
};

EDDA_INLINE Cut cut_of(const ContactView& c, std::size_t k, double normal) {
  const double hold = c.hold[k], present = c.trial_slip(k);
  const double trial_slip = carries(hold) ? present : 0.0;
  const double trial = -c.ks[k] * trial_slip;
  const double within = cut_shear(trial, c.shear_limit(k, normal));
  const double kept = is_bonded(hold) ? trial : within;
  return {trial_slip, kept, kept != trial};
}

/// Where the anchor lies so that the slip is that of the shear force T.
EDDA_INLINE double anchor_of(const ContactView& c, std::size_t k, double shear) {
  return (c.foot[k] + shear / c.ks[k]) / c.span[k];
}

/// What acts on the ends of the edges of a chunk, N.
struct Reactions {
  double start_x[ContactSet::chunk], start_y[ContactSet::chunk], end_x[ContactSet::chunk],
      end_y[ContactSet::chunk];
};

/// What the shear dashpot adds to the T of the spring: so much that both together stay within the
/// limit of friction.
EDDA_INLINE double drag_of(const ContactView& c, const ContactDashpots& d, std::size_t k,
                           double normal, const Cut& cut) {
  const double xi = c.foot[k] / c.span[k];
  const double mass = 1.0 / inverse_mass_at(d, c, k, xi);
  const double rate = (cut.trial_slip + c.shear_1[k] / c.ks[k]) / d.step;
  const double drag = -2.0 * c.shear_zeta[k] * std::sqrt(c.ks[k] * mass) * rate;
  const double limit = c.shear_limit(k, normal);
  const double within = larger(-limit - cut.kept, smaller(limit - cut.kept, drag));
  const double acting = is_bonded(c.hold[k]) ? drag : within;
  return (cut.slid | !carries(c.hold[k])) ? 0.0 : acting;
}

/// T of the spring and the forces under the normal force N and a drag that acts along with T; the
/// reaction as entry q. Whether T was cut.
EDDA_INLINE bool push_with(const ContactView& c, std::size_t k, double normal, const Cut& cut,
                           double drag, Reactions& on, std::size_t q) {
  const double followed = anchor_of(c, k, cut.kept), anchor = c.anchor[k], w = c.share[k];
  c.normal[k] = normal;
  c.shear[k] = cut.kept;
  const ContactForce f =
      contact_force(c.tangent(k), c.span[k], c.foot[k], c.depth[k], cut.slid ? followed : anchor,
                    w * normal, w * (cut.kept + drag));
  c.force[2 * k] = f.f1.x;
  c.force[2 * k + 1] = f.f1.y;
  on.start_x[q] = f.f2.x;
  on.start_y[q] = f.f2.y;
  on.end_x[q] = f.f3.x;
  on.end_y[q] = f.f3.y;
  return cut.slid;
}

EDDA_INLINE bool push(const ContactView& c, std::size_t k, double normal, Reactions& on,
                      std::size_t q) {
  return push_with(c, k, normal, cut_of(c, k, normal), 0.0, on, q);
}

EDDA_INLINE bool push_damped(const ContactView& c, const ContactDashpots& d, std::size_t k,
                             Reactions& on, std::size_t q) {
  return push(c, k, damped_normal(c, k, spring_normal(c, k), d, d.damping), on, q);
}

/// Where laws have dashpots of their own.
EDDA_INLINE bool push_by_law(const ContactView& c, const ContactDashpots& d, std::size_t k,
                             Reactions& on, std::size_t q) {
  const double own = c.zeta[k], zeta = own >= 0.0 ? own : d.damping;
  const double normal = damped_normal(c, k, spring_normal(c, k), d, zeta);
  const Cut cut = cut_of(c, k, normal);
  const double drag = drag_of(c, d, k, normal, cut);
  c.drag[k] = drag;
  return push_with(c, k, normal, cut, drag, on, q);
}

/// Where T was cut the anchor follows and the slip is booked, p_t (s_tr - s)(s + s_{n-1})/2
/// (method.md section 4). True where that is for the first time.
EDDA_INLINE bool book_cut(const ContactView& c, std::size_t k) {
  const Cut cut = cut_of(c, k, c.normal[k]);
  const double ks = c.ks[k], slip = -cut.kept / ks, slip_1 = -c.shear_1[k] / ks;
  const double followed = anchor_of(c, k, cut.kept), anchor = c.anchor[k];
  const double work = 0.5 * c.share[k] * ks * (cut.trial_slip - slip) * (slip + slip_1);
  const bool slid = cut.slid;
  c.slip_trial[k] = slid ? cut.trial_slip : slip;
  c.anchor[k] = slid ? followed : anchor;
  c.friction_work[k] += slid ? work : 0.0;
  return slid & !has_slipped(c.hold[k]);
}

/// What was found in a chunk.
struct Found {
  double hold;  ///< the strongest
  bool cut;     ///< the shear of one was cut
  bool fresh;   ///< for the first time
};

/// One chunk, or one contact.
EDDA_VECTOR Found push_chunk(ContactView c, ContactDashpots d, std::size_t first,
                             std::size_t last) {
  double cut = 0.0, fresh = 0.0, hold = 0.0;
  Reactions on;
  if (d.by_law) {
    for (std::size_t k = first; k < last; ++k) {
      cut = larger(cut, push_by_law(c, d, k, on, k - first) ? 1.0 : 0.0);
      hold = larger(hold, c.hold[k]);
    }
  } else if (d.damping > 0.0) {
#pragma omp simd reduction(max : cut, hold)
    for (std::size_t k = first; k < last; ++k) {
      cut = larger(cut, push_damped(c, d, k, on, k - first) ? 1.0 : 0.0);
      hold = larger(hold, c.hold[k]);
    }
  } else {
#pragma omp simd reduction(max : cut, hold)
    for (std::size_t k = first; k < last; ++k) {
      cut = larger(cut, push(c, k, spring_normal(c, k), on, k - first) ? 1.0 : 0.0);
      hold = larger(hold, c.hold[k]);
    }
  }
  for (std::size_t k = first; k < last; ++k) {
    const std::size_t q = k - first;
    keep_reaction(c.reaction, c.slot[k],
                  {{}, {on.start_x[q], on.start_y[q]}, {on.end_x[q], on.end_y[q]}});
  }
  if (cut > 0.0) {
#pragma omp simd reduction(max : fresh)
    for (std::size_t k = first; k < last; ++k) fresh = larger(fresh, book_cut(c, k) ? 1.0 : 0.0);
  }
  return {hold, cut > 0.0, fresh > 0.0};
}

void evaluate_one(ContactSet& c, const BlockSet& b, std::size_t k, double step, double damping) {
  c.keep_slips(k);
  const Found found = push_chunk(c.view(), dashpots_of(c, b, damping, step), k, k + 1);
  if (found.fresh) c.set(k, cs::slipped);
  if (!found.cut) c.slip_trial[k] = -c.shear[k] / c.ks[k];
  if (c.is(k, cs::pulls) && !c.is(k, cs::bonded) && c.normal[k] < -c.tension[k]) tear(c, k);
}

/// Springs, dashpots and return map of the contacts [begin, end): whole chunks.
void evaluate(ContactSet& c, const BlockSet& b, std::size_t begin, std::size_t end, double step,
              double damping) {
  const ContactView view = c.view();
  const ContactDashpots dashpots = dashpots_of(c, b, damping, step);
  for (std::size_t first = begin; first < end; first += ContactSet::chunk) {
    const std::size_t last = std::min(end, first + ContactSet::chunk);
    const Found found = push_chunk(view, dashpots, first, last);
    c.cuts[first / ContactSet::chunk] = found.cut ? 1 : 0;
    for (std::size_t k = first; found.fresh && k < last; ++k) {
      if (c.cut(k)) c.set(k, cs::slipped);
    }
    if (!may_pull(found.hold)) continue;
    for (std::size_t k = first; k < last; ++k) {
      if (c.is(k, cs::pulls) && !c.is(k, cs::bonded) && c.normal[k] < -c.tension[k]) tear(c, k);
    }
  }
}

/// Whether the bonded contacts of one pair of edges fail together: |sum T| > c L + tan(phi) sum N,
/// or one of them tears. A joint without tensile strength tears where it gapes by more than 1e-6 of
/// the smaller block's size, the gap within which contacts are bonded in the first place: at rest N
/// is zero but for rounding, and rounding must not decide.
bool fails(const ContactSet& c, const BlockSet& b, const Segment& segment) {
  double shear = 0.0, normal = 0.0, cohesion = 0.0, friction = 0.0;
  for (const Id k : segment.members) {
    if (c.is(k, cs::glued)) return false;
    shear += c.share[k] * c.shear[k];
    normal += c.share[k] * c.normal[k];
    cohesion += c.share[k] * c.cohesion[k];
    friction = std::max(friction, c.friction[k]);
    if (c.share[k] == 0.0) continue;
    if (c.is(k, cs::pulls)) {
      if (c.normal[k] < -c.tension[k]) return true;
    } else {
      const double size = smaller_size(c, b, k);
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
  evaluate_one(c, b, k, step, damping);
  c.fracture_work[k] += std::max(0.0, c.friction_work[k] - friction_before);
  c.friction_work[k] = friction_before;
}

/// Calls break_one(k) for every contact of the bonded segments that fail, and lets these go.
template <class Break>
void break_failed(ContactSet& c, const BlockSet& b, Break break_one) {
  for (Segment& segment : c.segments) {
    if (!fails(c, b, segment)) continue;
    for (const Id k : segment.members) break_one(k);
    c.broken += segment.members.size();
    segment.members.clear();
  }
  std::erase_if(c.segments, [](const Segment& s) { return s.members.empty(); });
}

}  // namespace

double inverse_contact_mass(const BlockSet& b, const ContactSet& c, std::size_t k, double xi) {
  return inverse_mass_at(b, c, k, xi);
}

double dashpot_coefficient(const ContactSet& c, const BlockSet& b, std::size_t k, double damping) {
  return coefficient(b, c, k, damping);
}

void set_normal_force(ContactSet& c, const BlockSet& b, std::size_t k, double step,
                      double damping) {
  c.alpha[k] = 1.0;
  const double spring = spring_normal(c, k);
  c.normal[k] = damping > 0.0
                    ? damped_normal(c, k, spring, dashpots_of(c, b, damping, step), damping)
                    : spring;
}

void evaluate_contacts(ContactSet& c, const BlockSet& b, const LawTable& laws, double step,
                       double damping) {
  for (const Id k : c.reduced) c.alpha[k] = 1.0;
  c.reduced.clear();
  std::swap(c.shear, c.shear_1);
  parallel_chunks(c.size(), ContactSet::run, [&](std::size_t, std::size_t begin, std::size_t end) {
    evaluate(c, b, begin, end, step, damping);
  });
  break_failed(c, b, [&](Id k) { break_bond(c, b, laws, k, step, damping); });
}

std::vector<Id> break_overloaded(ContactSet& c, const BlockSet& b, const LawTable& laws) {
  std::vector<Id> broken;
  break_failed(c, b, [&](Id k) {
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
