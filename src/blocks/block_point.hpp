// Material points of blocks, such as those of monitors.
#pragma once

#include <utility>
#include <vector>

#include "blocks/kinematics.hpp"

namespace edda {

/// A point of a block.
struct BlockPoint {
  std::size_t block = 0;
  NodeWeights nodes{};  ///< area coordinates in the block
  std::vector<std::pair<std::size_t, double>>
      modes{};  ///< modes, and by which part it follows them
};

/// The point of block i that was at `point` (local coordinates) at the start. It follows the modes
/// by sum_v lambda_v h_av with the mean value coordinates lambda of the corners (Floater 2003),
/// which are linear along edges; of a mesh the corners of the zone that it lies in, or lies
/// nearest to.
BlockPoint block_point(const BlockSet& blocks, std::size_t i, Vec2 point);

/// Corner v of its block.
BlockPoint corner_point(const BlockSet& blocks, Id v);

/// Adds `factor` times a force at a point of the block.
void push(BlockForces& on, const BlockPoint& point, Vec2 force, double factor);

/// Where its block takes the point; of velocities, its velocity.
Vec2 at_point(const BlockSet& blocks, const BodyVectors& u, const BlockPoint& point);
Vec2 at_point(const BodyVector& u, const BlockPoint& point);

}  // namespace edda
