// How the shape of a meshed block has changed, whatever way it has moved as a whole.
#pragma once

#include <vector>

#include "blocks/block_set.hpp"
#include "blocks/state.hpp"

namespace edda {

/// |R^T (x_j - c) - R_0^T (x_0j - c_0)| of each mesh node of block i, m, with the centroids c and
/// the rotations R of the block at `then` and `now`.
std::vector<double> shape_change(const BlockSet& blocks, const BodyVectors& then,
                                 const BodyVectors& now, std::size_t i);

}  // namespace edda
