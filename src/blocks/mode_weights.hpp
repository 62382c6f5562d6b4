// How a point inside a block that bends follows the deviations of its corners.
#pragma once

#include <vector>

#include "blocks/block_set.hpp"

namespace edda {

/// The parts with which the point that was at `point` (local coordinates) at the start follows the
/// modes of block i, [modes of the block]: sum_v lambda_v h_av with the mean value coordinates
/// lambda of the corners (Floater 2003), which are linear along edges. Empty where it has none.
std::vector<double> mode_weights(const BlockSet& blocks, std::size_t i, Vec2 point);

/// sum_a w_a v_a of the modes of block i.
Vec2 weighted_modes(const BlockSet& blocks, std::size_t i, const std::vector<double>& weights,
                    const ModeVectors& v);

}  // namespace edda
