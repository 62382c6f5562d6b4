// Blocks that need no cutting: [[block]] polygons and [[brick_wall]]s.
#pragma once

#include <vector>

#include "base/vec2.hpp"
#include "cutting/polygon_set.hpp"
#include "imports/imports.hpp"
#include "model/model.hpp"

namespace edda {

/// Centre of the bounding box of the outline, the blocks, walls, arches, openings and imported
/// blocks, m; (0, 0) for an empty model. Coordinates are kept relative to it.
Vec2 model_centre(const Model& model, const Imports& imports);

/// One polygon per [[block]], in file order, outer ring counter-clockwise, relative to `origin`.
std::vector<BlockPolygon> given_blocks(const Model& model, Vec2 origin);

/// The bricks of every wall, row by row from the lower left, relative to `origin`. Even rows (from
/// 0) have `columns` bricks; odd rows are shifted by half a brick and closed by two half bricks.
/// Corners that two bricks share are the same to the bit.
std::vector<BlockPolygon> wall_bricks(const Model& model, Vec2 origin);

/// The voussoirs of every arch, counter-clockwise, relative to `origin`. Corners that two voussoirs
/// share are the same to the bit.
std::vector<BlockPolygon> voussoirs(const Model& model, Vec2 origin);

/// The blocks of drawings (imports as blocks), in the order of the files, relative to `origin`.
std::vector<BlockPolygon> imported_blocks(const Model& model, const Imports& imports, Vec2 origin);

}  // namespace edda
