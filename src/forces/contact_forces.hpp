// Contact springs with Coulomb friction, cohesion and bonds (method.md section 4).
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "base/vector_loop.hpp"
#include "blocks/pose.hpp"
#include "blocks/state.hpp"
#include "contacts/contact_set.hpp"

namespace edda {

/// Forces of one contact, N, on P1, P2, P3. They sum to zero and have no moment.
struct ContactForce {
  Vec2 f1, f2, f3;
};

/// Gradient form of the springs, for the whole spring (share 1):
///   f1 = N n + T t,  f2 = -(1-xi) N n - T [(1-xi0) t + (g/l) n],  f3 = -xi N n - T [xi0 t - (g/l)
///   n].
EDDA_INLINE ContactForce contact_force(Vec2 t, double l, double foot, double depth, double anchor,
                                       double normal, double shear) {
  const Vec2 n = outward_normal(t);
  const double xi = foot / l, lift = -depth / l;  // g/l
  const Vec2 f1 = normal * n + shear * t;
  const Vec2 f3 = -xi * normal * n - shear * (anchor * t - lift * n);
  return {f1, -(f1 + f3), f3};
}

/// 1/m_c = sum of weights^2/mass over both blocks for a unit force along `direction` on the vertex
/// and against it at the foot, 1/kg (for `consistent` the quadratic form with the inverse mass).
double inverse_contact_mass(const BlockSet& blocks, const ContactSet& contacts, std::size_t k,
                            double xi);

/// Viscous coefficient of a contact, c = 2 zeta sqrt(p m_c), N s/m.
double dashpot_coefficient(const ContactSet& contacts, const BlockSet& blocks, std::size_t k,
                           double damping);

/// Normal force of contact k at step n with alpha = 1, its spring's and its dashpot's: fills alpha
/// and normal. `step` s; `damping` zeta.
void set_normal_force(ContactSet& contacts, const BlockSet& blocks, std::size_t k, double step,
                      double damping);

/// Springs and return map of every contact at step n with alpha = 1: fills normal, shear
/// and the forces, and where the shear is cut slip_trial and the anchor. `step` s; `damping` zeta,
/// fraction of critical. Then breaks bonded segments that are overloaded; both their contacts
/// follow the residual law at once.
void evaluate_contacts(ContactSet& contacts, const BlockSet& blocks, const LawTable& laws,
                       double step, double damping);

/// The bonds alone, for a method that finds normal and shear itself: contacts whose segment is
/// overloaded, or whose tensile strength is spent, follow the residual law from now on or let go.
/// Nothing is booked. Returns them.
std::vector<Id> break_overloaded(ContactSet& contacts, const BlockSet& blocks,
                                 const LawTable& laws);

/// Keeps what acts on the ends of an edge as entry q of `reaction`.
EDDA_INLINE void keep_reaction(double* reaction, std::size_t q, const ContactForce& f) {
  reaction[4 * q] = f.f2.x;
  reaction[4 * q + 1] = f.f2.y;
  reaction[4 * q + 2] = f.f3.x;
  reaction[4 * q + 3] = f.f3.y;
}

/// Keeps the forces of contact k.
inline void keep_contact_force(ContactSet& c, std::size_t k, const ContactForce& f) {
  c.force[2 * k] = f.f1.x;
  c.force[2 * k + 1] = f.f1.y;
  keep_reaction(c.reaction.data(), c.slot[k], f);
}

/// Sets the forces of contact k from its N and T as they stand, scaled by its share (and alpha),
/// for an edge of tangent t and length l with the foot at `foot` and penetration `depth`.
inline void set_contact_force(ContactSet& c, std::size_t k, Vec2 t, double l, double foot,
                              double depth) {
  const double w = c.share[k];
  keep_contact_force(c, k,
                     contact_force(t, l, foot, depth, c.anchor[k], w * c.alpha[k] * c.normal[k],
                                   w * (c.shear[k] + c.drag_of(k))));
}

inline void clear_contact_force(ContactSet& c, std::size_t k) {
  keep_contact_force(c, k, {});
}

/// A contact whose tensile strength is spent opens; what it stores is fracture energy.
void tear(ContactSet& contacts, std::size_t k);

}  // namespace edda
