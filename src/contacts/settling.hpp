// What sliding does to the springs of contacts: rest penetrations go, and springs stand for the
// overlap that there still is.
#pragma once

#include "blocks/pose.hpp"
#include "contacts/contact_set.hpp"
#include "contacts/laws.hpp"

namespace edda {

/// Steps between two looks.
constexpr std::uint64_t settles_every = 16;

/// Closed contacts that slide lose their rest penetration as e^{-s/l}, l a twentieth of the shorter
/// edge: what is born without force where a block comes onto the next one takes its part of the
/// load, or every seam would leave the block deeper by its penetration at rest. Beyond what the
/// deepest contact of the two blocks is pressed in they go more slowly, beyond twice that not at
/// all: nothing that has come in sideways may be thrown out. The energy is booked as taken by
/// friction. `steps` since the last look; slips by pose.x1, y1.
void settle_rests(ContactSet& contacts, const BlockSet& blocks, const Pose& pose,
                  const LawTable& laws, double steps);

}  // namespace edda
