#include "step/divergence.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "step/labels.hpp"

namespace edda {
namespace {

std::string cause(const StepInUse& step, const char* otherwise) {
  if (step.step > step.critical) {
    return fmt::format("the step of {:.3g} s is {:.2f} times the critical one: make it smaller",
                       step.step, step.step / step.critical);
  }
  return otherwise;
}

}  // namespace

Failure lost_block(const BlockSet& b, const State& s, const Pose& pose, const BodyVectors& forces,
                   const StepInUse& step) {
  Failure f;
  f.time = s.time;
  f.message = "the motion has grown without bound: " +
              cause(step, "loads or stiffnesses are out of proportion: check units");
  for (std::size_t i = 0; i < b.size(); ++i) {
    if (s.alive[i] == 0 || (is_finite(b, forces, i) && is_finite(b, s.velocity, i))) continue;
    f.block = static_cast<Id>(i);
    f.place = at(pose.x1, pose.y1, b.vertex_begin[i]) + b.origin;
    f.message = block_label(b, i) + " has lost its shape: " +
                cause(step,
                      "its strain is too large for a constant-strain block: check young against "
                      "the loads, and the units");
    break;
  }
  return f;
}

// The overlap is reported for the block that is free, or for the smaller one, inside the other.
Failure overlap_failure(Id one, Id other, double depth, Vec2 place, const BlockSet& b,
                        const State& s, const StepInUse& step) {
  const auto weight = [&](Id i) {
    return b.fixed[i] != 0 ? std::numeric_limits<double>::infinity() : b.area[i];
  };
  const Id i = weight(one) <= weight(other) ? one : other, j = i == one ? other : one;
  Failure f;
  f.time = s.time;
  f.block = i;
  f.of_block = b.fixed[i] == 0 && step.step <= step.critical;
  f.place = place + b.origin;
  f.message = fmt::format(
      "{} is {:.3g} m inside {}, more than the half-width of the narrower one: {}",
      block_label(b, i), depth, block_label(b, j),
      cause(step,
            "contacts are too soft for these loads or velocities: raise contact.normal_stiffness "
            "(or the joint's kn), or lower solver.max_displacement_ratio"));
  return f;
}

}  // namespace edda
