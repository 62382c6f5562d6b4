// The blocks of a frame as shapes: the cells of each block, its outline, the initial positions of
// its points.
#pragma once

#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "base/vec2.hpp"
#include "results/grid.hpp"

namespace edda {

struct BlockShape {
  std::size_t first_cell = 0, end_cell = 0;                    ///< cells of one id
  std::vector<std::pair<std::int64_t, std::int64_t>> outline;  ///< edges, by points of the grid
  std::vector<std::vector<std::int64_t>> rings;                ///< the same, closed, holes too
};

/// Cells that follow each other and have one id are one block; edges between two of its cells are
/// no outline.
std::vector<BlockShape> block_shapes(const Grid& grid);

/// Every point drawn with its displacement `scale` times as large, m.
std::vector<Vec2> drawn_points(const Grid& grid, double scale);

/// Area of every cell, m2.
std::vector<double> cell_areas(const Grid& grid);

/// An affine vector field over a block: u(r) = d + A r.
struct AffineField {
  Vec2 d;
  double xx = 0.0, xy = 0.0, yx = 0.0, yy = 0.0;  ///< A

  Vec2 at(Vec2 r) const { return d + Vec2{xx * r.x + xy * r.y, yx * r.x + yy * r.y}; }
};

/// Fits the field to its values at n points by least squares, exact for an affine field. `place(k)`
/// is r there, `value(k)` is u.
template <class Place, class Value>
AffineField affine_field(std::size_t count, Place place, Value value) {
  const auto n = static_cast<double>(count);
  Vec2 middle, mean;
  for (std::size_t k = 0; k < count; ++k) {
    middle += place(k) / n;
    mean += value(k) / n;
  }
  // A = (sum u r^T) (sum r r^T)^-1, u and r from their means.
  double xx = 0.0, xy = 0.0, yy = 0.0;
  Vec2 ux, uy;
  for (std::size_t k = 0; k < count; ++k) {
    const Vec2 r = place(k) - middle, u = value(k) - mean;
    xx += r.x * r.x;
    xy += r.x * r.y;
    yy += r.y * r.y;
    ux += u.x * r;
    uy += u.y * r;
  }
  const double det = xx * yy - xy * xy;
  AffineField f;
  if (det > 0.0) {
    f.xx = (ux.x * yy - ux.y * xy) / det;
    f.xy = (ux.y * xx - ux.x * xy) / det;
    f.yx = (uy.x * yy - uy.y * xy) / det;
    f.yy = (uy.y * xx - uy.x * xy) / det;
  }
  f.d = mean - Vec2{f.xx * middle.x + f.xy * middle.y, f.yx * middle.x + f.yy * middle.y};
  return f;
}

/// Area-weighted centre of a shape at the given points.
Vec2 centre_of(const Grid& grid, const BlockShape& shape, const std::vector<Vec2>& points);

/// Where marks of a shape are drawn: its centre, or, where that lies in a hole or outside, the
/// middle of the cell whose middle is farthest from the outline.
Vec2 mark_place(const Grid& grid, const BlockShape& shape, const std::vector<Vec2>& points);

/// Carries material points along with the cells that hold them, from one place of the grid's points
/// to another. `grid` must outlive it.
class Follower {
 public:
  Follower(const Grid& grid, std::vector<Vec2> from, const std::vector<Vec2>& to);
  /// The present position of `start`; nothing where it lies in no cell. On a border it belongs to a
  /// free block before a fixed one, then to the block of lowest number, as in the program.
  std::optional<Vec2> operator()(Vec2 start) const;

 private:
  struct Bounds {
    Vec2 low, high;
  };
  std::optional<Vec2> within(std::size_t cell, Vec2 start) const;
  const Grid& grid_;
  std::vector<Vec2> from_;
  const std::vector<Vec2>& to_;
  std::vector<Bounds> bounds_;  ///< of each cell, before
};

/// At most one shape per square of side `raster` m: that whose centre is nearest to the square's.
std::vector<std::size_t> thinned(const std::vector<Vec2>& centres, double raster);

}  // namespace edda
