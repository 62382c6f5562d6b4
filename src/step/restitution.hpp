// Springs and dashpots that give a joint the restitution of its law (theory, section 9.7).
#pragma once

#include <vector>

#include "base/fault.hpp"
#include "blocks/block_set.hpp"
#include "model/model.hpp"

namespace edda {

/// Fills JointLaw::dashpots of the laws that have a restitution. Their springs are soft compared
/// with the blocks, so that an impact depends on them and not on the strain of the blocks:
/// - a part e of the velocity: the dashpot with which a square block of the softest rock and of the
///  median size keeps e of its velocity in a flat impact. That impact is computed.
/// - Housner: normal and shear dashpots so strong that the corner of a rocking block stays where it
///  strikes. Impulses at that corner alone leave (1 - 3/2 sin^2 alpha)^2 of the energy.
/// Faults: restitutions that the blocks' own damping, or a given kn, does not allow.
std::vector<Fault> fit_restitution(Model& model, const BlockSet& blocks);

}  // namespace edda
