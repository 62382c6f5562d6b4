// Faces that are too small, too thin or too sharp to be blocks ([quality]), and their merging.
#pragma once

#include <vector>

#include "cutting/line_work.hpp"
#include "cutting/partition.hpp"

namespace edda {

/// Limits on merging faces, besides joints.
struct FaceGroups {
  const std::vector<Index>& region_of_half_edge;
  const std::vector<Vec2>& fixed;  ///< points of fixed blocks; m, local
  const std::vector<LineSource>& sources;
  double snap = 0.0;  ///< m
};

/// A face that was merged into a neighbour.
struct FaceMerge {
  Vec2 at;            ///< centroid of the face, m, local
  double area = 0.0;  ///< m2
  double lost = 0.0;  ///< length of the boundary between the two, m
  Index source = 0;   ///< source of the longest part of that boundary
};

/// Merges each rock face that is a sliver (is_sliver() in quality.hpp), or has corners sharper than
/// min_angle that vanish with it, into a rock face of the same region and staged opening: the
/// neighbour with the shortest common boundary among those where merging does not interrupt a
/// continuous joint. A joint is continuous at a boundary if it continues beyond both of its ends,
/// or ends at the surface (the outline or an opening); borders of Voronoi cells never are. Then
/// only the tip of a joint that ends on another one is lost. The smallest faces come first, and no
/// poor face is merged twice, so that strips grow step by step. Faces that contain a point of a
/// fixed block are not merged. Returns how many were merged, and adds them to `merges`; if any, the
/// faces must be found again.
int merge_poor_faces(PlanarGraph& graph, const Partition& parts, const Quality& quality,
                     const FaceGroups& groups, std::vector<FaceMerge>& merges);

}  // namespace edda
