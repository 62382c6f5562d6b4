// Which pairs of edges may come into contact soon.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "blocks/block_set.hpp"
#include "blocks/pose.hpp"
#include "blocks/state.hpp"
#include "contacts/approach.hpp"
#include "contacts/face_parts.hpp"

namespace edda {

/// Two edges of different blocks, the lower number first.
using EdgePair = std::pair<Id, Id>;

/// Cosine of the angle up to which a face carries its full load, and of that at which it carries
/// none: 60 and 85 degrees. Beside a corner of alpha < 90 degrees both are (90 - alpha)/2 larger,
/// since its two edges stand at 90 - alpha/2 to an edge that it strikes at a right angle.
struct AngleGate {
  double whole, none;
};
AngleGate angle_gate(const BlockSet& blocks, Id e, Id f);

/// Candidate range: edges are near each other where an end of one is nearer than `apart` (m) to the
/// other. Edges that lie behind each other with the overlap l, `behind` (m) at most, act up to the
/// closure l/aspect_from, by which the range is larger.
struct Reach {
  double apart;
  double behind = 0.0;
  // A number is a reach of edges apart. NOLINTNEXTLINE(google-explicit-constructor)
  Reach(double within, double penetrated = 0.0) : apart(within), behind(penetrated) {}
  /// No pair of edges farther from each other than this is near, m.
  double furthest() const { return apart + behind / aspect_from; }
};

/// Pairs of edges that stood within a wider reach some time ago. As long as neighbours have not
/// approached each other by the difference, those within a reach now are among them. A store: what
/// edges_within() returns does not depend on it.
struct NearEdges {
  std::vector<Id> first, second;         ///< sorted by both
  double reach = 0.0;                    ///< m
  std::vector<double> built_x, built_y;  ///< [nv] positions of the vertices then, m
  std::uint64_t lists = 0;               ///< how often it has been filled
  NeighbourGroups groups;
};

/// All pairs of edges of two blocks, both alive and not both fixed, that are within this reach of
/// each other and may be opposed before any vertex has moved by half of `apart`; sorted.
std::vector<EdgePair> edges_within(NearEdges& known, const BlockSet& blocks, const State& state,
                                   const Pose& pose, const Reach& reach);

}  // namespace edda
