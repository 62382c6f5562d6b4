// Where boundaries lie.
#pragma once

#include <vector>

#include "blocks/block_set.hpp"
#include "model/model.hpp"

namespace edda {

struct Line {
  Vec2 a, b;
};

/// The lines of a boundary, local coordinates: sides of the outline's box (of the box round all
/// blocks where there is no outline), or the pieces of its polyline.
std::vector<Line> boundary_lines(const Model& model, const BlockSet& blocks,
                                 const Boundary& boundary);

/// How far from a line a vertex may lie and still be on it, m.
double boundary_snap(const Model& model, const BlockSet& blocks);

}  // namespace edda
