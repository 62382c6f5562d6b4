// Blocks that come into being between two steps, on walls as these are by then.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "blocks/block_set.hpp"

namespace edda {

struct Simulation;

/// Displacement of the walls at a point of them as drawn: the mean over the edges of blocks that
/// are there ([nb] 1); none where there is none.
std::optional<Vec2> displacement_of_walls(const Simulation& sim,
                                          const std::vector<std::uint8_t>& there, Vec2 drawn,
                                          double within);

/// Completes what is missing from the nearest before and after, round a closed line.
std::vector<Vec2> completed(const std::vector<std::optional<Vec2>>& some, bool closed);

/// Puts the mesh nodes of block i there, at rest.
void place_mesh(Simulation& sim, std::size_t i, const std::vector<Vec2>& node);

}  // namespace edda
