// The blocks of a frame as shapes: which cells are one block, its outline, where its points were.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "base/vec2.hpp"
#include "results/grid.hpp"

namespace edda {

struct BlockShape {
  std::size_t first_cell = 0, end_cell = 0;                    ///< cells of one id
  std::vector<std::pair<std::int64_t, std::int64_t>> outline;  ///< edges, by points of the grid
};

/// Cells that follow each other and have one id are one block; edges between two of its cells are
/// no outline.
std::vector<BlockShape> block_shapes(const Grid& grid);

/// Every point drawn with its displacement `scale` times as large, m.
std::vector<Vec2> drawn_points(const Grid& grid, double scale);

/// Area-weighted centre of a shape at the given points.
Vec2 centre_of(const Grid& grid, const BlockShape& shape, const std::vector<Vec2>& points);

/// Where the material point that was at `start` is drawn; false where it lies in no cell.
bool follow(const Grid& grid, const std::vector<Vec2>& drawn, Vec2 start, Vec2& now);

}  // namespace edda
