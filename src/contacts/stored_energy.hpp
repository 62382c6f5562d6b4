// What the ledger holds of a contact.
#pragma once

#include "contacts/contact_set.hpp"

namespace edda {

/// Slip s of contact k at step n before the return map, m.
inline double trial_slip(const ContactSet& c, std::size_t k) {
  return c.trial_slip(k);
}

/// Stored energy of a closed contact between steps n - 1 and n, in the ledger's terms (method.md
/// section 4): w (p e_{n-1} e_n + p_t s_{n-1} s_n)/2, s_n before its return map, J.
inline double stored_energy(const ContactSet& c, std::size_t k) {
  const double before = c.effective_1(k), now = c.effective(k);
  const bool both = c.is(k, contact_state::pulls) || (before > 0.0 && now > 0.0);
  const double slip_before = -c.shear[k] / c.ks[k];
  return 0.5 * c.share[k] *
         (c.kn[k] * (both ? before * now : 0.0) + c.ks[k] * slip_before * trial_slip(c, k));
}

}  // namespace edda
