// How far edges have approached each other since a list of near ones was made, and with that how
// long the list holds (theory, section 7.5).
#pragma once

#include <algorithm>
#include <limits>
#include <vector>

#include "blocks/pose.hpp"
#include "blocks/state.hpp"
#include "contacts/face_set.hpp"

namespace edda {

/// Width of a free block of mean area, m; 1 where no block is free.
double mean_width(const BlockSet& blocks, const State& state);

/// Blocks in groups of neighbours, and the pairs of groups near each other, as they stood when the
/// list was made. Blocks that move together, however fast, leave the list as it is.
struct NeighbourGroups {
  /// Least and largest of both coordinates of some points, m.
  struct Extent {
    double left = std::numeric_limits<double>::infinity(), right = -left;
    double low = left, high = -left;
    double not_finite = 0.0;  ///< NaN where a coordinate is not finite, else 0

    void include(const Extent& e) {
      left = std::min(left, e.left);
      right = std::max(right, e.right);
      low = std::min(low, e.low);
      high = std::max(high, e.high);
      not_finite += e.not_finite;
    }
    void include(Vec2 p) { include({p.x, p.x, p.y, p.y, 0.0 * (p.x + p.y)}); }
  };
  struct Pair {
    Id one, other;  ///< groups, or a group and itself
    double spare;   ///< m: by how much more than the reach of the list they may approach
  };
  std::uint64_t of_list = 0;      ///< ListOrigin::list; 0: none
  std::vector<Id> begin, blocks;  ///< blocks of group g: blocks[begin[g]] to blocks[begin[g + 1]]
  std::vector<Pair> pairs;        ///< of groups nearer to each other than `far`
  double far = 0.0;               ///< m
  std::vector<Extent> moved;      ///< [groups] displacements of the vertices, at the last look
};

/// Positions of the vertices when a list was made, and its reach.
struct ListOrigin {
  const std::vector<double>&x, &y;  ///< [nv] positions of the vertices, m
  double reach;                     ///< m: the list has the edges nearer to each other than this
  std::uint64_t list;               ///< its number, from 1 on
};
inline ListOrigin origin_of(const FaceSet& faces) {
  return {faces.built_x, faces.built_y, faces.reach, faces.rebuilds};
}

/// Upper bound of the distance (m) by which edges of the blocks alive have approached each other
/// since the list was made, less what those of groups apart from each other have to spare: edges
/// that stood at a distance d >= reach are now farther apart than reach - largest_approach(), and
/// the list holds as long as that is positive. No two vertices of a group have moved against each
/// other by more. Not a number where a position is not.
double largest_approach(NeighbourGroups& groups, const BlockSet& blocks, const State& state,
                        const Pose& pose, const ListOrigin& then);

}  // namespace edda
