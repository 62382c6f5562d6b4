// The lines of boundaries.
#pragma once

#include <vector>

#include "blocks/block_set.hpp"
#include "model/model.hpp"

namespace edda {

struct Line {
  Vec2 a, b;
};

/// The lines of a boundary, local coordinates: sides of the bounding box of the outline (of all
/// blocks where there is no outline), or the pieces of its polyline.
std::vector<Line> boundary_lines(const Model& model, const BlockSet& blocks,
                                 const Boundary& boundary);

/// Largest distance of a vertex from a line on which it counts as lying, m.
double boundary_snap(const Model& model, const BlockSet& blocks);

}  // namespace edda
