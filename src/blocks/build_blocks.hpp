// From polygons to blocks with mass, cover and motion.
#pragma once

#include "blocks/block_set.hpp"
#include "blocks/state.hpp"
#include "lines/polygon_set.hpp"
#include "model/model.hpp"

namespace edda {

/// Moments, covers, masses and elastic constants of every polygon (method.md sections 1 to 3). The
/// polygons are valid: positive area, no ring crossing itself.
BlockSet build_blocks(const Model& model, const PolygonSet& polygons);

/// Every block where it was drawn, unstressed, with its given velocity (v_0, not yet v_{-1/2}).
State initial_state(const BlockSet& blocks, const PolygonSet& polygons);

}  // namespace edda
