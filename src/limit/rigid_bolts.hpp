// The bolts of a model as ties between rigid blocks.
#pragma once

#include "limit/rigid_blocks.hpp"

namespace edda {

/// Adds ties and grout of all bolts, of which those that are anchored at their ends pull and do not
/// push; broken ones carry nothing.
void add_bolts(RigidBlocks& rigid, const Simulation& sim, BoltForces forces);

}  // namespace edda
