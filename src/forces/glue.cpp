#include "forces/glue.hpp"

#include "forces/contact_forces.hpp"

namespace edda {

namespace cs = contact_state;

void glue(ContactSet& c) {
  c.lent.assign(c.size(), 0);
  for (std::size_t k = 0; k < c.size(); ++k) {
    if (!c.is(k, cs::closed) || c.is(k, cs::glued)) continue;
    c.keep_slips(k);
    c.lent[k] = static_cast<std::uint8_t>(cs::closed | (c.state[k] & (cs::bonded | cs::pulls)));
    c.set(k, cs::glued | cs::bonded | cs::pulls);
    c.forget_cut(k);
  }
}

void unglue(ContactSet& c) {
  for (std::size_t k = 0; k < c.lent.size(); ++k) {
    if (c.lent[k] == 0) continue;
    c.keep_slips(k);
    c.clear(k, cs::glued);
    if (!c.is(k, cs::closed)) continue;
    const bool bonded = (c.lent[k] & cs::bonded) != 0, pulls = (c.lent[k] & cs::pulls) != 0;
    // While it still pulls, so that what its spring stores is known to have gone.
    if (!bonded && !pulls && c.effective(k) <= 0.0) {
      tear(c, k);
      continue;
    }
    if (!bonded) c.clear(k, cs::bonded);
    if (!pulls) c.clear(k, cs::pulls);
  }
  c.lent.clear();
}

}  // namespace edda
