// Stiffness of bolts, as the critical step needs it: springs at points of a block.
//
// The slips of a bolt's nodes minimise its energy, which is then at most what the bonds alone store
// with the bolt fixed in space: sum of K_k u_k u_k^T, u along the bolt. Dowels and end-anchored
// bars are springs between two blocks, as contacts are: 2 k u u^T; across itself a bar of tension N
// has the stiffness 2 N/L, N at most its yield force, and so has a link (attachments/dowel.hpp).
#pragma once

#include "attachments/bolts.hpp"
#include "forces/block_matrices.hpp"

namespace edda {

/// Springs at a node of a bolt.
struct BoltSpringAt {
  std::size_t node;
  Vec2 t;               ///< direction in space
  double along = 0.0;   ///< stiffness along t, N/m
  double across = 0.0;  ///< and across it
};
/// All of them at the nodes in block i.
std::vector<BoltSpringAt> bolt_springs(const Bolts& bolts, const BlockSet& blocks,
                                       const State& state, std::size_t i);

/// An upper bound of the stiffness that the bolts through block i, which is not meshed, give it,
/// N/m, in the block's own frame: with this K for each block, x^T K_bolts x <= sum over blocks
/// x_i^T K x_i.
NodalMatrix bolt_matrix(const Bolts& bolts, const BlockSet& blocks, const State& state,
                        std::size_t i);

}  // namespace edda
