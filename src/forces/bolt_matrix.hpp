// What bolts add to the stiffness of a block.
#pragma once

#include "attachments/bolts.hpp"
#include "forces/block_matrices.hpp"

namespace edda {

/// A bound for the stiffness that the bolts through block i give it, N/m, in the block's own frame:
/// with K of it on each block, x^T K_bolts x <= sum over blocks x_i^T K x_i. A bolt's nodes take
/// the slips of least energy, which is no more than what the bonds alone store where the bolt is
/// held in space: sum of K_k u_k u_k^T, u along the bolt. Dowels and end-anchored bars are springs
/// from block to block, as contacts: 2 k u u^T, and for what a bar pulls across itself 2 N/L, N at
/// most its yield.
Matrix6 bolt_matrix(const Bolts& bolts, const BlockSet& blocks, const State& state, std::size_t i);

}  // namespace edda
