// How a block that bends stands at one time: its modes in its own frame, what they store, and the
// couple that this puts on its nodes.
#pragma once

#include <array>

#include "blocks/kinematics.hpp"

namespace edda {

using ModesOfBlock = std::array<Vec2, most_modes>;

/// R^T v and R v.
EDDA_INLINE Vec2 turned_back(const Rotation& r, Vec2 v) {
  return {r.c * v.x + r.s * v.y, r.c * v.y - r.s * v.x};
}
EDDA_INLINE Vec2 turned(const Rotation& r, Vec2 v) {
  return {r.c * v.x - r.s * v.y, r.s * v.x + r.c * v.y};
}

/// s_a = R^T q_a, and with g = K s + g0 (g0 locked) the forces -R g_a on the modes.
struct BentState {
  BlockModes modes;
  Rotation r;
  ModesOfBlock s;
};
inline BentState bent_state(const BlockSet& b, const ModeVectors& bend, const Rotation& r,
                            std::size_t i) {
  BentState state{b.modes(i), r, {}};
  for (std::size_t a = 0; a < state.modes.count; ++a)
    state.s[a] = turned_back(r, bend[state.modes.first + a]);
  return state;
}

/// K s.
inline ModesOfBlock elastic_stress(const BlockSet& b, const BentState& q, std::size_t i) {
  ModesOfBlock g;
  mode_stress(
      b.bending, q.modes, i, [&q](std::size_t a) { return q.s[a]; }, g.data());
  return g;
}

/// The derivative by the rotation angle of what the forces g store, N m: sum_a g_a x s_a, since the
/// modes turn with the block. Zero where g is parallel to s.
inline double couple_of(const BentState& q, const ModesOfBlock& g) {
  double sum = 0.0;
  for (std::size_t a = 0; a < q.modes.count; ++a) sum += cross(g[a], q.s[a]);
  return sum;
}

/// The nodal forces of that couple: the rotation depends on F by d theta = (R J : dF)/(a^2 +
/// b^2)^(1/2), J the rotation by a right angle (kinematics.hpp).
inline NodeVectors couple_on_nodes(const BlockSet& b, const Rotation& r, double couple,
                                   std::size_t i) {
  return nodal_forces_of(b, Deformation{-r.s, -r.c, r.c, -r.s}, -couple * r.inverse, i);
}

}  // namespace edda
