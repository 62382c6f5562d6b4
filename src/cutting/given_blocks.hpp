// Blocks that need no cutting: [[block]] polygons and [[brick_wall]]s.
#pragma once

#include <vector>

#include "base/vec2.hpp"
#include "cutting/polygon_set.hpp"
#include "model/model.hpp"

namespace edda {

/// Centre of the bounding box of the outline, the blocks, walls, arches and openings, m; (0, 0) for
/// an empty model. Coordinates are kept relative to it.
Vec2 model_centre(const Model& model);

/// One polygon per [[block]], in file order, outer ring counter-clockwise, relative to `origin`.
std::vector<BlockPolygon> given_blocks(const Model& model, Vec2 origin);

/// The bricks of every wall, row by row from the lower left, relative to `origin`. Even rows (from
/// 0) have `columns` bricks; odd rows are shifted by half a brick and closed by two half bricks.
/// Corners that two bricks share are the same to the bit.
std::vector<BlockPolygon> wall_bricks(const Model& model, Vec2 origin);

/// The voussoirs of every arch, counter-clockwise, relative to `origin`. Corners that two voussoirs
/// share are the same to the bit.
std::vector<BlockPolygon> voussoirs(const Model& model, Vec2 origin);

}  // namespace edda
