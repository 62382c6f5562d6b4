// When a run must stop: shape lost, numbers lost, or a vertex deep inside a neighbour.
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

/// A vertex deeper inside a neighbour than half its size (the least of both blocks' half-widths),
/// if there is one: closed contacts, and those blocked for their depth whose vertex truly lies
/// inside. `largest`: largest effective penetration at present, m; blocks are looked at only where
/// it, or a blocked contact, gives cause.
std::optional<Failure> deep_overlap(const FaceSet& contacts, const BlockSet& blocks,
                                    const State& state, const Pose& pose, double largest,
                                    double smallest_half_width, const StepInUse& step);

/// The same of contacts at points.
std::optional<Failure> deep_overlap(const PointSet& contacts, const BlockSet& blocks,
                                    const State& state, const Pose& pose, double largest,
                                    double smallest_half_width, const StepInUse& step);

}  // namespace edda
