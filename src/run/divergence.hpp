// When a run must stop: shape lost, numbers lost, or blocks deep in each other.
#pragma once

#include <optional>
#include <string>

#include "base/vec2.hpp"
#include "blocks/block_set.hpp"
#include "blocks/pose.hpp"
#include "blocks/state.hpp"
#include "contacts/face_set.hpp"
#include "contacts/points.hpp"
#include "forces/nodal_forces.hpp"
#include "model/model.hpp"

namespace edda {

/// Why a run stopped before its end: what, where, when and the likely cause.
struct Failure {
  std::string message;  ///< one line, with the likely cause
  Id block = no_id;
  Vec2 place;         ///< model coordinates
  double time = 0.0;  ///< s
};

/// What made the step in use unsafe, for the message: larger than critical, or nothing of the kind.
struct StepInUse {
  double step = 0.0, critical = 0.0;  ///< s
};

/// The block whose numbers or shape are lost, after a step that gave no finite displacement.
Failure lost_block(const BlockSet& blocks, const State& state, const Pose& pose,
                   const NodalForces& forces, const StepInUse& step);

/// A face that carries and at one of its ends is closed by more than the half-width of either of
/// its blocks (BlockSet::inradius), if there is one.
/// `largest`: largest closure at present, m; faces are looked at only where it is above
/// `smallest_half_width`.
std::optional<Failure> deep_overlap(const FaceSet& contacts, const BlockSet& blocks,
                                    const State& state, const Pose& pose, double largest,
                                    double smallest_half_width, const StepInUse& step);

/// The same of vertices on edges.
std::optional<Failure> deep_overlap(const PointSet& contacts, const BlockSet& blocks,
                                    const State& state, const Pose& pose, double largest,
                                    double smallest_half_width, const StepInUse& step);

}  // namespace edda
