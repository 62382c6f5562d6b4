#include "run/divergence.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "contacts/face_reading.hpp"
#include "contacts/gap.hpp"
#include "contacts/inside.hpp"
#include "run/labels.hpp"

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

Failure lost_block(const BlockSet& b, const State& s, const Pose& pose, const NodalForces& forces,
                   const StepInUse& step) {
  Failure f;
  f.time = s.time;
  f.message = "the motion has grown without bound: " +
              cause(step, "loads or stiffnesses are out of proportion: check units");
  for (std::size_t i = 0; i < b.size(); ++i) {
    double sum = 0.0;
    for (std::size_t k = 0; k < 3; ++k)
      sum += forces.x[k][i] + forces.y[k][i] + s.vx[k][i] + s.vy[k][i];
    if (std::isfinite(sum)) continue;
    f.block = static_cast<Id>(i);
    f.place = at(pose.x1, pose.y1, b.vertex_begin[i]) + b.origin;
    f.message = block_label(b, i) + " has lost its shape: " +
                cause(step,
                      "it is strained beyond what a constant-strain block can bear: check young "
                      "against the loads, and the units");
    break;
  }
  return f;
}

namespace {

std::optional<Failure> deep_face(const FaceSet& c, const BlockSet& b, const State& s,
                                 const Pose& pose, const StepInUse& step) {
  for (std::size_t k = 0; k < c.size(); ++k) {
    const Id i = b.vertex_block[c.edge[k]], j = b.vertex_block[c.facing[k]];
    const double depth = closure_of(c, k);
    if (!(c.now.energy[k] > 0.0) || depth <= std::min(b.inradius[i], b.inradius[j])) continue;
    Failure f;
    f.time = s.time;
    f.block = i;
    const double xi = c.now.closure_b[k] >= c.now.closure_a[k] ? c.now.xi_b[k] : c.now.xi_a[k];
    f.place = (1.0 - xi) * at(pose.x, pose.y, c.edge[k]) + xi * at(pose.x, pose.y, c.edge_end[k]) +
              b.origin;
    f.message = fmt::format(
        "{} is {:.3g} m inside {}, more than half the size of the smaller: {}", block_label(b, i),
        depth, block_label(b, j),
        cause(step,
              "contacts are too soft for these loads or speeds: raise contact.normal_stiffness "
              "(or the joint's kn), or lower solver.max_displacement_ratio"));
    return f;
  }
  return std::nullopt;
}

}  // namespace

std::optional<Failure> deep_overlap(const ContactSet& c, const BlockSet& b, const State& s,
                                    const Pose& pose, double largest, double smallest_half_width,
                                    const StepInUse& step) {
  if (c.on_faces) {
    if (largest <= smallest_half_width) return std::nullopt;
    return deep_face(c.faces, b, s, pose, step);
  }
  auto limit = [&](std::size_t k) {
    return std::min(b.inradius[c.block_i[k]], b.inradius[c.block_j[k]]);
  };
  Id worst = no_id;
  constexpr std::uint64_t look_every = 64;
  if (largest > smallest_half_width || s.steps % look_every == 0) {
    for (std::size_t k = 0; k < c.size() && worst == no_id; ++k) {
      if (c.is(k, contact_state::closed) && c.depth[k] > limit(k)) worst = static_cast<Id>(k);
    }
  }
  // Blocked for its depth below the line of an edge: only where it is truly inside does that
  // matter.
  for (const Id k : c.blocked) {
    if (worst != no_id || c.why[k] != Blocked::depth) continue;
    const Vec2 p = at(pose.x, pose.y, c.vertex[k]);
    if (inside_of(b, pose, p, c.block_j[k]).depth > 0.5 * limit(k)) worst = k;
  }
  if (worst == no_id) return std::nullopt;
  Failure f;
  f.time = s.time;
  f.block = c.block_i[worst];
  f.place = at(pose.x, pose.y, c.vertex[worst]) + b.origin;
  f.message = fmt::format(
      "{} is {:.3g} m inside {}, more than half the size of the smaller: {}",
      block_label(b, c.block_i[worst]), c.depth[worst], block_label(b, c.block_j[worst]),
      cause(step,
            "contacts are too soft for these loads or speeds: raise contact.normal_stiffness "
            "(or the joint's kn), or lower solver.max_displacement_ratio"));
  return f;
}

}  // namespace edda
