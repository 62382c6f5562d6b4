// [[fixed]] points: the cut blocks that are fixed.
#pragma once

#include <cstddef>

#include "base/fault.hpp"
#include "cutting/polygon_set.hpp"
#include "imports/imports.hpp"
#include "model/model.hpp"

namespace edda {

/// Marks as fixed the cut block that contains each point of model.fixed; `first_cut` is the number
/// of the first cut block in set.blocks. Faults: a point in no cut block, or within `snap` (m) of
/// the edges of several.
Faults fix_blocks(const Model& model, double snap, std::size_t first_cut, PolygonSet& set);

/// Marks as fixed the cut blocks that the imports' fixed lines run through, or, where such a line
/// runs through none, the one that it touches. Faults: a line that meets no block, or only the
/// edges of several.
Faults fix_along(const Model& model, const Imports& imports, double snap, std::size_t first_cut,
                 PolygonSet& set);

}  // namespace edda
