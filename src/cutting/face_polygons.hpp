// Faces of the planar graph as block polygons.
#pragma once

#include <vector>

#include "cutting/planar_graph.hpp"
#include "cutting/polygon_set.hpp"

namespace edda {

/// Location of a face.
enum class Zone : std::uint8_t { outside, rock, opening };

/// One face as a polygon with the law of every edge. Rings that touch themselves at a node are
/// split there, so that each is simple; vertices on straight sides (within `tolerance`, m) are
/// omitted.
BlockPolygon face_polygon(const PlanarGraph& graph, const Faces& faces, int face,
                          const std::vector<LineSource>& sources, double tolerance);

/// Signed area of a face, m2.
double face_area(const PlanarGraph& graph, const Faces& faces, int face);

/// Whether a bounded face is thinner than `width` (2 area / perimeter), m.
bool has_thin_face(const PlanarGraph& graph, const Faces& faces, double width);

/// Removes the edges between a rock face that is thinner (2 area / perimeter) than 2 `snap`, or
/// than `width` between sources that have one, and the rock face with which it shares the longest
/// boundary; of the sources on its two sides the first in precedence remains. `rock`: as in
/// Partition. `width`: per source, m, 0 for most. Returns how many faces were merged; if any, the
/// faces must be found again.
int merge_slivers(PlanarGraph& graph, const Faces& faces, const std::vector<int>& rock, double snap,
                  const std::vector<double>& width);

/// Sorts by centroid: y, then x; heights closer than `tolerance` to the next count as equal, so
/// that rounding does not change the order within a row.
void sort_by_centroid(std::vector<BlockPolygon>& blocks, double tolerance);

}  // namespace edda
