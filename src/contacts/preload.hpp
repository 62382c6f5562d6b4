// What contacts carry at the start, so that they match the initial stress of the blocks.
#pragma once

#include <functional>
#include <vector>

#include "blocks/initial_stress.hpp"
#include "blocks/pose.hpp"
#include "contacts/contact_set.hpp"
#include "contacts/transitions.hpp"

namespace edda {

/// What the initial stress does over the part from s = from to s = to of a face (0: its first
/// vertex, 1: its second).
using FaceTraction = std::function<EndForces(Id edge, double from, double to)>;

/// Of all contacts of one law at the start.
struct JointStress {
  double length = 0.0;     ///< m they stand for
  double over = 0.0;       ///< m of that whose shear is above its strength
  double torn = 0.0;       ///< m of that in tension above its strength
  double mobilised = 0.0;  ///< largest shear over strength, where pressed
  double ratio = 0.0;      ///< largest shear over normal force, where pressed
};

/// Closes what touches, as settle_contacts() does at the start, and loads each contact with the
/// traction of the initial stress on the faces that it is the end of: of their overlap, the two end
/// forces with the same resultant and moment. The springs are strained for it by their rest
/// penetration and anchor, so that the blocks stay as drawn.
/// Returns what is asked of the contacts, by row of the laws; bonds and friction have not had their
/// say yet (cut_preload()).
std::vector<JointStress> preload_contacts(ContactSet& contacts, const BlockSet& blocks,
                                          const Pose& pose, const LawTable& laws,
                                          const FaceTraction& traction, TransitionScratch& scratch);

/// Cuts the shear of preloaded contacts that are not bonded to their strength; those that are not
/// closed carry nothing.
void cut_preload(ContactSet& contacts);

}  // namespace edda
