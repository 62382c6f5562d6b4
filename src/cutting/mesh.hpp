// Triangle meshes of polygons, graded by a size: the zones of a block.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "cutting/triangulate.hpp"

namespace edda {

/// Length of the edges of triangles that a mesh is to have at a point, m; above 0.
using MeshSize = std::function<double(Vec2)>;

/// Points within an edge from a to b that divide it so that each piece is about as long as the size
/// asks for: n pieces of equal integral of ds/size, the fewest of which that is at most 1. An edge
/// is divided alike from either end.
std::vector<Vec2> divisions(Vec2 a, Vec2 b, const MeshSize& size);
/// The ring with these points on its edges.
Ring divided(const Ring& ring, const MeshSize& size);

struct Mesh {
  std::vector<Vec2> nodes;  ///< first the corners of the rings, in their order, then inner nodes
  std::vector<Triangle> triangles;  ///< counter-clockwise
};

/// A Delaunay mesh of the region bounded by `rings` (as triangulate() takes them), whose edges are
/// edges of triangles, undivided. Inner nodes are added at circumcentres (Chew 1989, Ruppert 1995)
/// where triangles are larger than the size asks for, or flat, and are then moved towards the
/// centres of their triangles. Where corners of the rings are much nearer to each other than the
/// size, or their angles are sharp, triangles remain flat.
Mesh mesh_polygon(std::span<const Ring> rings, const MeshSize& size);

}  // namespace edda
