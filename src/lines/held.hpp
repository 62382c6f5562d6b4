// [[held]] points: the cut blocks that do not move.
#pragma once

#include <cstddef>

#include "base/fault.hpp"
#include "lines/imports.hpp"
#include "lines/polygon_set.hpp"
#include "model/model.hpp"

namespace edda {

/// Marks as fixed the cut block that holds each of model.held; `first_cut` is the number of the
/// first of them in set.blocks. Faults: a point in no cut block, or within `snap` (m) of the edges
/// of several.
Faults hold_blocks(const Model& model, double snap, std::size_t first_cut, PolygonSet& set);

/// Marks as fixed the cut blocks that the imports' fixed lines run into, or, where such a line runs
/// into none, the one that it touches. Faults: a line that meets no block, or only the edges of
/// several.
Faults hold_along(const Model& model, const Imports& imports, double snap, std::size_t first_cut,
                  PolygonSet& set);

}  // namespace edda
