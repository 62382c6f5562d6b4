// The blocks of the replay page as they lie in the first frame. A block is placed by its
// mean deformation, so that from then on six numbers per block and frame place all its vertices; in
// a run with zones the vertices of blocks of several cells have displacements of their own.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "base/fault.hpp"
#include "base/vec2.hpp"
#include "report/shapes.hpp"
#include "results/grid.hpp"

namespace edda {

struct ViewMesh {
  std::vector<std::int32_t> id;                         ///< [nb] rising
  std::vector<std::int32_t> material;                   ///< [nb]
  std::vector<std::uint8_t> fixed;                      ///< [nb]
  std::vector<Vec2> centre;                             ///< [nb] of area, m
  std::vector<std::size_t> begin;                       ///< [nb + 1] first vertex of each block
  std::vector<Vec2> vertex;                             ///< [nv] from the block's centre, m
  std::vector<std::int64_t> point;                      ///< [nv] the vertex in the frames' grids
  std::vector<std::array<std::uint32_t, 3>> triangles;  ///< of vertices
  std::vector<std::array<std::uint32_t, 2>> edges;      ///< of vertices, counter-clockwise
  std::vector<std::size_t> edge_begin;                  ///< [nb + 1] first edge of each block
  std::vector<std::uint8_t> zoned;                      ///< [nb] its triangles are cells

  std::size_t points = 0;  ///< points of every frame's grid, those of excavated blocks included

  std::size_t size() const { return id.size(); }
  std::size_t row_of(std::int32_t block) const;  ///< size() where there is none
  double reach(
      std::size_t row) const;  ///< largest distance of a vertex from the centre in x or y, m
};

ViewMesh view_mesh(const Grid& first);

/// The format for the page (read by page/src/data/mesh.ts): nb, nv, triangles, edges as u32;
/// centres f64; vertices f32; then by u32 id, material, first vertex; triangles and edges u32;
/// fixed and zoned u8.
std::string mesh_bytes(const ViewMesh& mesh);

/// Motion of a block: u(X) = d + A (X - c), c its centre and X in the first frame.
using BlockMotion = AffineField;

/// Motion of block `row`, from the values (m) at its vertices; `value(v)` is that at vertex v of
/// the mesh.
template <class Value>
BlockMotion block_motion(const ViewMesh& mesh, std::size_t row, Value value) {
  const std::size_t first = mesh.begin[row], edge = mesh.edge_begin[row];
  return mean_field(
      mesh.begin[row + 1] - first, mesh.edge_begin[row + 1] - edge,
      [&](std::size_t k) {
        return std::pair{mesh.edges[edge + k][0] - first, mesh.edges[edge + k][1] - first};
      },
      [&](std::size_t v) { return mesh.vertex[first + v]; },
      [&](std::size_t v) { return value(first + v); });
}

}  // namespace edda
