// A frame of two blocks, for the tests of pictures.
#pragma once

#include "results/grid.hpp"

namespace edda {

/// A square of two triangles (block 4) and a square cell (block 5, held), moved by (0.5, 0).
inline Grid two_blocks() {
  Grid g;
  g.points = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 2, 0, 0, 3, 0, 0, 3, 1, 0, 2, 1, 0};
  g.corners = {0, 1, 2, 0, 2, 3, 4, 5, 6, 7};
  g.ends = {3, 6, 10};
  g.types = {cell_type::triangle, cell_type::triangle, cell_type::polygon};
  std::vector<double> u;
  for (int k = 0; k < 8; ++k) u.insert(u.end(), {0.5, 0.0, 0.0});
  g.point_fields = {{"displacement", 3, u, {}, false}};
  g.cell_fields = {{"id", 1, {4, 4, 5}, {}, true},
                   {"fixed", 1, {0, 0, 1}, {}, true},
                   {"displacement", 3, {0.5, 0, 0, 0.5, 0, 0, 0.5, 0, 0}, {}, false}};
  return g;
}

}  // namespace edda
