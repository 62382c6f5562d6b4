// From the model's line work, blocks and walls to one polygon per block (theory, section 15.1).
#pragma once

#include "base/fault.hpp"
#include "cutting/polygon_set.hpp"
#include "model/model.hpp"

namespace edda {

/// All blocks of the model: [[block]]s, bricks of walls, and the domain cut by joint sets, traces
/// and openings. Lengths in m, local to PolygonSet::origin. Faults: geometry that cannot be cut,
/// openings outside the outline, more blocks than domain.max_blocks, [[fixed]] points that do not
/// lie in exactly one block, and blocks that overlap by more than 1e-3 of the smaller's size. O(n
/// log n) in blocks.
Result<PolygonSet> build_polygons(const Model& model);

}  // namespace edda
