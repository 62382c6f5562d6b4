// Whether a vertex really lies in a block, or only below the line of one of its edges.
#pragma once

#include <vector>

#include "blocks/block_set.hpp"
#include "blocks/pose.hpp"
#include "contacts/contact_set.hpp"

namespace edda {

/// How a point lies to a block.
struct Inside {
  double depth;  ///< distance from its boundary, m; below zero outside
  Id edge;       ///< the nearest
};

/// How p lies to block j as that lies. O(its edges).
Inside inside_of(const BlockSet& blocks, const Pose& pose, Vec2 p, std::size_t j);

/// Whether the vertex, though below the edge by more than `tolerance` (m), does not lie in the
/// block: outside it, on its far side, or nearer to that, which is then what it touches. Beyond the
/// ends of the edge, where a shared or reentrant one runs on, what lies below its end must be near
/// the block: below the tip of a wedge it is not.
bool lies_outside(const ContactSet& contacts, const BlockSet& blocks, const Pose& pose,
                  std::size_t k, double tolerance);

}  // namespace edda
