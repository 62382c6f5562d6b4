// What sliding over a seam does to contacts: rest penetrations go.
#pragma once

#include "blocks/pose.hpp"
#include "contacts/contact_set.hpp"
#include "contacts/laws.hpp"

namespace edda {

/// Steps of the explicit method between two looks.
constexpr std::uint64_t settles_every = 16;

/// Closed contacts that slide beside a seam lose their rest penetration as e^{-s/l}, l a twentieth
/// of the shorter edge: what is born without force where a block comes onto the next one takes its
/// part of the load, or every seam would leave the block deeper by its penetration at rest. Beyond
/// what the deepest contact of the two blocks is pressed in they go more slowly, beyond twice that
/// not at all. A seam: two edges of different blocks, flush, lie against one. The energy is booked
/// as taken by friction. `steps` since the last look; slips by pose.x1, y1; `leaps`: of the
/// explicit method, which tells otherwise what slides.
void settle_rests(ContactSet& contacts, const BlockSet& blocks, const Pose& pose,
                  const LawTable& laws, double steps, bool leaps);

/// While joints are glued, what has come to touch is glued once it has been pressed for a whole
/// step: the step in which it closes is corrected as any other, and both ways its spring then
/// stores the same.
void glue_pressed(ContactSet& contacts);

}  // namespace edda
