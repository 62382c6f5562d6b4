// Faces that are too small, too thin or too sharp to be blocks ([quality]), and their merging.
#pragma once

#include <vector>

#include "lines/line_work.hpp"
#include "lines/partition.hpp"

namespace edda {

/// What keeps faces apart, besides joints.
struct FaceGroups {
  const std::vector<Index>& region_of_half_edge;
  const std::vector<Vec2>& held;  ///< points of blocks that do not move; m, local
  const std::vector<LineSource>& sources;
  double snap = 0.0;  ///< m
};

/// A face that has joined a neighbour.
struct FaceMerge {
  Vec2 at;            ///< centroid of the face, m, local
  double area = 0.0;  ///< m2
  double lost = 0.0;  ///< length of the boundary between the two, m
  Index source = 0;   ///< of the longest part of that
};

/// Merges each rock face that is a sliver (is_sliver() in quality.hpp), or has corners sharper than
/// min_angle that vanish with it, into a rock face of the same region and staged opening: that with
/// which it shares the shortest boundary, of those that put no rock across a joint that runs
/// through. A joint runs through a boundary if it goes on beyond both ends of it, or ends at the
/// surface: at the outline, or at an opening; borders of Voronoi cells never do. What is lost is
/// then the tip of a joint that ends on another one. Smallest first, and no poor face twice, so
/// that strips grow step by step. Faces that hold a held point stay as they are. Returns how many
/// were merged, and adds them to `merges`; if any, faces must be found anew.
int merge_poor_faces(PlanarGraph& graph, const Partition& parts, const Quality& quality,
                     const FaceGroups& groups, std::vector<FaceMerge>& merges);

}  // namespace edda
