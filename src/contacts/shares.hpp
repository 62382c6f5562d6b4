// Corners that line up share one spring, so that a joint's stiffness does not depend on whether
// they do, and hand it over smoothly as they pass each other (method.md section 4).
//
// Notation: A on edge e near its end B, B on edge f near its end A. delta_A: how far A's foot lies
// inside e, measured from B; delta_B likewise.
//   same way (one corner passes the other along a joint): delta_A = -delta_B but for the tilt;
//     w_A = clamp(1/2 + (delta_A - delta_B)/4 r_v, 0, 1), w_B = 1 - w_A, each on the edge to r_v
//     beyond.
//   corner against corner: the overlap is delta_A = delta_B; both have
//     w = clamp(1/2 + (delta_A + delta_B)/4 r_v, 1/2, 1): one spring while it is short, two beyond
//     r_v.
// As the edges turn away from each other (n_f.n_e from -0.99 to -0.98) the weights fade to those of
// corners that do not share.
#pragma once

#include "blocks/pose.hpp"
#include "contacts/contact_set.hpp"

namespace edda {

/// Finds the pairs among the candidates of a new list.
void pair_corners(ContactSet& contacts, const BlockSet& blocks, const Pose& pose);

/// Fills what of `pair_memory` and `tangle` follows from the pairs: all but where the corners
/// stood.
void list_pairs(ContactSet& contacts);

/// Gives candidate k a new share. Of a closed one that grows alone (balanced = false) the added
/// part is born unloaded at the present penetration and slip. What the ledger holds less for it is
/// dissipated.
void change_share(ContactSet& contacts, std::size_t k, double share, bool balanced);

/// Range of feet and share of every paired candidate, from the feet at step n. A share that grows
/// without its partner's shrinking is born where it is: its rest penetration is such that the force
/// does not jump, and what the spring then stores less is booked as dissipated.
/// Whether the corners of pair p pass each other and divide one spring between them, as they stood
/// when their shares were last set.
bool divides(const ContactSet& contacts, std::size_t p);

void update_shares(ContactSet& contacts);

}  // namespace edda
