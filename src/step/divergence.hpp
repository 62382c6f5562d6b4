// When a run must stop: a block has lost its shape, values are not finite, or blocks overlap
// deeply.
#pragma once

#include <optional>
#include <string>

#include "base/vec2.hpp"
#include "blocks/block_set.hpp"
#include "blocks/pose.hpp"
#include "blocks/state.hpp"
#include "forces/nodal_forces.hpp"
#include "model/model.hpp"

namespace edda {

/// Why a run stopped before its end: what, where, when and the likely cause.
struct Failure {
  std::string message;  ///< one line, with the likely cause
  Id block = no_id;
  Vec2 place;             ///< model coordinates
  double time = 0.0;      ///< s
  bool of_block = false;  ///< it is the trouble of this block alone: it sinks too deep into others
};

/// The step and the critical step, which the message compares to name the cause.
struct StepInUse {
  double step = 0.0, critical = 0.0;  ///< s
};

/// The block whose values are not finite or whose shape is lost, after a step without a finite
/// displacement.
Failure lost_block(const BlockSet& blocks, const State& state, const Pose& pose,
                   const BodyVectors& forces, const StepInUse& step);

/// The failure of two blocks that overlap by `depth` (m) at `place` (local coordinates), more than
/// the half-width of the narrower.
Failure overlap_failure(Id one, Id other, double depth, Vec2 place, const BlockSet& blocks,
                        const State& state, const StepInUse& step);

}  // namespace edda
