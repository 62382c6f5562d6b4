// What springs and dashpots give a joint the restitution that it asks for.
#pragma once

#include <vector>

#include "base/fault.hpp"
#include "blocks/block_set.hpp"
#include "model/model.hpp"

namespace edda {

/// Fills JointLaw::dashpots of the laws that have a restitution. Their springs are soft beside the
/// blocks, so that an impact is theirs and not that of the blocks' strain:
/// - a part e of the velocity: the dashpot with which a square block of the softest rock, as large
///   as the middling block, leaves a flat impact with e of its velocity. That impact is computed.
/// - Housner: dashpots along the normal and the tangent so strong that the corner of a rocking
///   block that strikes stays where it strikes. Impulses at that corner alone leave
///   (1 - 3/2 sin^2 alpha)^2 of the energy.
/// Faults: restitutions that the blocks' own damping, or the kn given, do not leave room for.
std::vector<Fault> fit_restitution(Model& model, const BlockSet& blocks);

}  // namespace edda
