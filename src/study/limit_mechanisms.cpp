#include "study/limit_mechanisms.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "step/simulation.hpp"
#include "step/tile_step.hpp"

namespace edda {
namespace {

/// The blocks moved by the mechanism, its largest velocity `far` (m).
Simulation moved_by(const Simulation& drawn, const RigidBlocks& rigid,
                    const std::vector<RigidMotion>& motion, double far) {
  Simulation moved = drawn;
  State& state = moved.motion.state;
  for (std::size_t r = 0; r < motion.size(); ++r) {
    for (const Id i : rigid.blocks[r]) {
      // A rotation, not its first order, so that blocks keep their shape.
      const BodyVector turned =
          rigid_positions(vector_of(moved.scene->blocks, state.position, i), rigid.centroid[r],
                          far * motion[r].velocity, far * motion[r].spin);
      store(turned, moved.scene->blocks, state.position, i);
      place_vertices(moved.scene->blocks, state.position, i, moved.motion.pose.x,
                     moved.motion.pose.y);
    }
  }
  return moved;
}

}  // namespace

std::optional<LimitMotion> limit_motion(const Simulation& drawn, const RigidBlocks& rigid,
                                        const LimitState& state) {
  constexpr double far = 0.01;     // of the blocks' size
  constexpr double moving = 0.01;  // nothing moves but the mechanism
  if (state.motion.empty()) return {};
  Simulation moved = moved_by(drawn, rigid, state.motion, far * rigid.size);
  Simulation before = drawn;  // whose joints carry what they carry at the limit
  // Closed by what the tiles remember (is_closed_now()), whatever the edges as drawn say.
  change_faces(before, [&](const FaceSet&, FaceStates& faces) {
    for (const RigidJoint& joint : rigid.joints) faces.now[joint.face].energy = 1.0;
  });
  // A rigid joint opens as it slides, by its friction angle.
  Mechanism mechanism = mechanism_of(before, moved, moving, drawn);
  return LimitMotion{std::move(mechanism), std::move(moved)};
}

LimitMechanisms::LimitMechanisms(const Simulation& drawn, LimitCase first, double least_area)
    : drawn_(drawn), least_area_(least_area), case_(std::move(first)) {}

bool LimitMechanisms::find_next() {
  if (ended_) return false;
  if (!found.empty()) {
    LimitCase next = case_->carrying(found.back().blocks);
    case_.emplace(std::move(next));
  }
  answer_ = case_->at_end(true, StrengthOf::peak);
  motion.reset();
  LimitMechanism next;
  next.value = {answer_.end, answer_.lower, answer_.upper};
  // Without a limit nothing moves: what the last program left is no mechanism.
  if (answer_.end == LimitEnd::found || answer_.end == LimitEnd::no_equilibrium)
    motion = limit_motion(drawn_, case_->rigid(), answer_.state);
  const BlockSet& b = drawn_.scene->blocks;
  if (motion) {
    next.text = motion->mechanism.text;
    next.blocks = blocks_of(motion->mechanism);
    next.area = area_of(motion->mechanism, b);
  }
  next.left_out = motion && next.area < least_area_;
  ended_ = next.blocks.empty();
  found.push_back(std::move(next));
  return true;
}

}  // namespace edda
