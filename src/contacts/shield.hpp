// The diagonals of a joint crossing: corners that touch while other blocks fill the space between.
#pragma once

#include "blocks/pose.hpp"
#include "contacts/contact_set.hpp"

namespace edda {

/// Whether candidate k touches only at a corner while other blocks fill the corner between its two
/// blocks: on one side of the common point the free angle between them is under 180 degrees and
/// nine tenths of it is filled by corners of other blocks at that point. Blocks that keep each
/// other apart along a joint (no free angle) are not shielded.
bool shielded(const ContactSet& contacts, const BlockSet& blocks, const Pose& pose, std::size_t k);

}  // namespace edda
