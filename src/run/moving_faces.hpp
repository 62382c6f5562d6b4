// Joints between blocks that have moved, face by face.
#pragma once

#include <limits>
#include <map>
#include <tuple>
#include <vector>

#include "run/mechanism.hpp"

namespace edda {

/// A joint while its faces are gone through.
struct Seen {
  MovingJoint joint;
  double least_opening = std::numeric_limits<double>::infinity();
  Vec2 hinge;  ///< m: where it opens least
};
using SeenJoints = std::map<std::tuple<Id, Id, std::uint16_t>, Seen>;

/// Adds the faces that carried `before` and have slipped, opened or turned by `least` (m) `after`.
/// rotation: [nb] of the blocks meanwhile, rad.
void see_faces(SeenJoints& joints, const Simulation& before, const Simulation& after,
               const std::vector<double>& rotation, double least);

}  // namespace edda
