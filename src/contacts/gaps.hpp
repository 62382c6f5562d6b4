// Narrow phase, first half: where every candidate stands.
#pragma once

#include "blocks/pose.hpp"
#include "contacts/contact_set.hpp"

namespace edda {

/// Gap, foot and range of candidate k at step n (Eq. 32 over l).
void update_gap(ContactSet& contacts, const Pose& pose, std::size_t k);

/// All of them, after moving the gaps of the steps before back by one.
void update_gaps(ContactSet& contacts, const Pose& pose);

}  // namespace edda
