// The lines of boundaries.
#pragma once

#include <vector>

#include "blocks/block_set.hpp"
#include "model/model.hpp"

namespace edda {

struct Line {
  Vec2 a, b;
};

/// Sides of the bounding box of the outline (of all blocks where there is no outline), and the
/// pieces of a polyline; local coordinates.
std::vector<Line> lines_along(const Model& model, const BlockSet& blocks,
                              const std::vector<std::string>& sides,
                              const std::vector<Vec2>& along);
/// The lines of a boundary.
inline std::vector<Line> boundary_lines(const Model& model, const BlockSet& blocks,
                                        const Boundary& boundary) {
  return lines_along(model, blocks, boundary.sides, boundary.along);
}

/// Largest distance of a vertex from a line on which it counts as lying, m.
double boundary_snap(const Model& model, const BlockSet& blocks);

}  // namespace edda
