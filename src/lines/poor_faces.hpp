// Faces that are too small, too thin or too sharp to be blocks ([quality]), and their merging.
#pragma once

#include <vector>

#include "lines/partition.hpp"

namespace edda {

/// What keeps faces apart, besides joints.
struct FaceGroups {
  const std::vector<Index>& region_of_half_edge;
  const std::vector<Vec2>& held;  ///< points of blocks that do not move; m, local
  double snap = 0.0;              ///< m
};

/// Merges each rock face that is a sliver (is_sliver() in quality.hpp), or has corners sharper than
/// min_angle that vanish with it, into the rock face of the same region and staged opening with
/// which it shares the longest boundary; smallest first, and no face twice, so that strips grow
/// step by step. Faces that hold a held point stay as they are. Returns how many were merged, and
/// adds to `area` theirs (m2); if any, faces must be found anew.
int merge_poor_faces(PlanarGraph& graph, const Partition& parts, const Quality& quality,
                     const FaceGroups& groups, double& area);

}  // namespace edda
