// The blocks of a frame as shapes: the cells of each block, its outline, the initial positions of
// its points.
#pragma once

#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "base/corner_weights.hpp"
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

/// The mean of a field that is linear along the edges of a block: A the mean of its gradient over
/// the block, by Gauss's theorem, and d as the corners of a block that bends have it (theory,
/// section 3.4); exact for an affine field. `edge(k)`: the two corners of edge k,
/// counter-clockwise; `place(v)`: r at a corner, from the centroid; `value(v)`: u there.
template <class Edge, class Place, class Value>
AffineField mean_field(std::size_t corners, std::size_t edges, Edge edge, Place place,
                       Value value) {
  AffineField f;
  double area = 0.0;
  std::vector<double> tributary(corners, 0.0);
  for (std::size_t k = 0; k < edges; ++k) {
    const auto [a, b] = edge(k);
    const Vec2 along = place(b) - place(a), u = 0.5 * (value(a) + value(b));
    f.xx += u.x * along.y;
    f.xy -= u.x * along.x;
    f.yx += u.y * along.y;
    f.yy -= u.y * along.x;
    area += 0.5 * cross(place(a), place(b));
    tributary[a] += 0.5 * norm(along);
    tributary[b] += 0.5 * norm(along);
  }
  for (double* entry : {&f.xx, &f.xy, &f.yx, &f.yy}) *entry = area > 0.0 ? *entry / area : 0.0;
  std::vector<Vec2> corner(corners);
  for (std::size_t v = 0; v < corners; ++v) corner[v] = place(v);
  const std::vector<double> weight = corner_weights(corner, tributary);
  Vec2 d;
  for (std::size_t v = 0; v < corners; ++v) d += weight[v] * (value(v) - f.at(corner[v]));
  f.d = d;
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
  /// The same of a point on a surface that has moved since it was given, before displacements were
  /// reset: it lies a little outside.
  std::optional<Vec2> on_surface(Vec2 start) const;

 private:
  struct Bounds {
    Vec2 low, high;
  };
  std::optional<Vec2> within(std::size_t cell, Vec2 start) const;
  const Grid& grid_;
  std::vector<Vec2> from_;
  const std::vector<Vec2>& to_;
  std::vector<Bounds> bounds_;  ///< of each cell, before
  double width_ = 0.0;          ///< of the whole, before
};

/// At most one shape per square of side `raster` m: that whose centre is nearest to the square's.
std::vector<std::size_t> thinned(const std::vector<Vec2>& centres, double raster);

}  // namespace edda
