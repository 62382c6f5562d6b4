// Faces of the planar graph as block polygons.
#pragma once

#include <vector>

#include "lines/planar_graph.hpp"
#include "lines/polygon_set.hpp"

namespace edda {

/// Where a face lies.
enum class Zone : std::uint8_t { outside, rock, opening };

/// One face as a polygon with the law of every edge. Rings that touch themselves at a node are
/// split there, so that each is simple; vertices on straight sides (within `tolerance`, m) are left
/// out.
BlockPolygon face_polygon(const PlanarGraph& graph, const Faces& faces, int face,
                          const std::vector<LineSource>& sources, double tolerance);

/// Signed area of a face, m2.
double face_area(const PlanarGraph& graph, const Faces& faces, int face);

/// Whether a bounded face is thinner than `width` (2 area / perimeter), m.
bool has_thin_face(const PlanarGraph& graph, const Faces& faces, double width);

/// Removes the edges between a rock face thinner than 2 `snap` (2 area / perimeter) and the rock
/// face with which it shares the longest boundary; of its two sides the source first in precedence
/// stays. `rock`: as Partition has it. Returns how many faces went; if any, faces must be found
/// anew.
int merge_slivers(PlanarGraph& graph, const Faces& faces, const std::vector<int>& rock,
                  double snap);

/// Sorts by centroid: y, then x; heights closer than `tolerance` to the next count as equal, so
/// that rounding does not shuffle a row.
void sort_by_centroid(std::vector<BlockPolygon>& blocks, double tolerance);

}  // namespace edda
