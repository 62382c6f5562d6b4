// Relative motion of the joints between blocks, face by face.
#pragma once

#include <limits>
#include <map>
#include <tuple>
#include <vector>

#include "study/mechanism.hpp"

namespace edda {

/// A joint while its faces are collected.
struct JointData {
  MovingJoint joint;
  double least_opening = std::numeric_limits<double>::infinity();
  Vec2 hinge;  ///< m: the end with the least opening
};
using SeenJoints = std::map<std::tuple<Id, Id, std::uint16_t>, JointData>;

/// Adds the faces that carried load `before` and have slipped, opened or rotated by `least` (m)
/// `after`. rotation: [nb] rotation of the blocks in between, rad.
void collect_joints(SeenJoints& joints, const Simulation& before, const Simulation& after,
                    const std::vector<double>& rotation, double least);

}  // namespace edda
