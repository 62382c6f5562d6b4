// The block system before any motion, for pictures of a model that has not been run.
#pragma once

#include <array>
#include <vector>

#include "blocks/block_set.hpp"
#include "results/records.hpp"

namespace edda {

/// Every block where it was cut: no displacement, no stress, no contacts. Model coordinates.
Picture start_picture(const Model& model, const BlockSet& blocks);

/// Head and far end of every bolt, those of patterns included. Model coordinates.
std::vector<std::array<Vec2, 2>> bolt_lines(const Model& model);

}  // namespace edda
