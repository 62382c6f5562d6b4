// Joints and rock that get other properties during a run (stage.change).
#pragma once

#include <cstdint>
#include <vector>

#include "blocks/block_set.hpp"

namespace edda {

/// Gives the edges whose joints change, or the blocks whose material does, the new ones; of linings
/// those that are there (by row). Returns which edges have another joint, or belong to a block of
/// another material, [nv]; empty where there is none. Edges that name no joint are of
/// contact.joint, and go on giving way to those that name one.
std::vector<std::uint8_t> change_properties(BlockSet& blocks, const Model& model,
                                            const PropertyChange& change,
                                            const std::vector<std::uint8_t>& linings);

}  // namespace edda
