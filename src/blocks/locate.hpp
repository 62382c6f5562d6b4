// Which block contains a point of the model at the start.
#pragma once

#include <optional>
#include <vector>

#include "blocks/block_set.hpp"
#include "cutting/polygon_set.hpp"

namespace edda {

/// Which blocks to consider.
enum class Among { all_blocks, free_blocks };

/// The block that contains p (local coordinates) or has it on its edge. Of several that share a
/// border there: what is there at the start before fill, then one that stays before one that a
/// stage excavates, then a free before a fixed one, then the one of lowest number, as cut. If there
/// is none, the nearest within the snap distance: `domain.snap`, or 1e-9 of the model's size.
std::optional<Id> block_at(const Model& model, const PolygonSet& polygons, const BlockSet& blocks,
                           Vec2 p, Among among = Among::all_blocks);

/// All blocks that contain p or have it on their edges, in the order of preference of block_at().
std::vector<Id> blocks_at(const Model& model, const PolygonSet& polygons, const BlockSet& blocks,
                          Vec2 p, Among among = Among::all_blocks);

/// Points closer than this are one point, m.
double snap_distance(const Model& model, const BlockSet& blocks);

}  // namespace edda
