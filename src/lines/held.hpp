// [[held]] points: the cut blocks that do not move.
#pragma once

#include <cstddef>

#include "base/fault.hpp"
#include "lines/polygon_set.hpp"
#include "model/model.hpp"

namespace edda {

/// Marks as fixed the cut block that holds each of model.held; `first_cut` is the number of the
/// first of them in set.blocks. Faults: a point in no cut block, or within `snap` (m) of the edges
/// of several.
Faults hold_blocks(const Model& model, double snap, std::size_t first_cut, PolygonSet& set);

}  // namespace edda
