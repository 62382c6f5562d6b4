// How a block that bends stands at one time: its modes in its own frame, what they store, and the
// couple that this puts on its nodes.
#pragma once

#include "blocks/kinematics.hpp"

namespace edda {

/// R^T v and R v.
EDDA_INLINE Vec2 turned_back(const Rotation& r, Vec2 v) {
  return {r.c * v.x + r.s * v.y, r.c * v.y - r.s * v.x};
}
EDDA_INLINE Vec2 turned(const Rotation& r, Vec2 v) {
  return {r.c * v.x - r.s * v.y, r.s * v.x + r.c * v.y};
}

/// w of the rotation r, 1/s, at the rate l of F.
EDDA_INLINE double spin_of(const Rotation& r, const Deformation& l) {
  return (r.c * (l.yx - l.xy) - r.s * (l.xx + l.yy)) * r.inverse;
}

/// s_a = R^T q_a, and with g = K s + g0 (g0 locked) the forces -R g_a on the modes.
struct BentState {
  BlockModes modes;
  Rotation r;
  ModesOfBlock s;
};
inline BentState bent_state(const BlockSet& b, const ModeVectors& bend, const Rotation& r,
                            std::size_t i) {
  BentState state;
  state.modes = b.modes(i);
  state.r = r;
  for (std::size_t a = 0; a < state.modes.count; ++a)
    state.s.set(a, turned_back(r, bend[state.modes[a]]));
  return state;
}

/// K s.
inline ModesOfBlock elastic_stress(const BlockSet& b, const BentState& q, std::size_t i) {
  ModesOfBlock g = q.s;
  mode_stress(view_of(b.bending), q.modes, i, g);
  return g;
}

/// The rotations of the blocks of a group.
struct GroupTurn {
  alignas(64) double c[group_size];
  alignas(64) double s[group_size];
  alignas(64) double inverse[group_size];
  EDDA_INLINE Rotation of(std::size_t at) const { return {c[at], s[at], 0.0, inverse[at]}; }
};
template <class Blocks>
EDDA_INLINE void put_rotation(const Blocks& blocks, std::size_t i, std::size_t at,
                              GroupTurn& turn) {
  const Rotation r = rotation(blocks.deformation_of(i + at));
  turn.c[at] = r.c;
  turn.s[at] = r.s;
  turn.inverse[at] = r.inverse;
}
/// Of the `many` blocks from i on: blocks.deformation_of(j) of block j. Those that would fill the
/// group do not turn.
template <class Blocks>
EDDA_INLINE void turn_of_group(const Blocks& blocks, std::size_t i, std::size_t many,
                               GroupTurn& turn) {
  for (std::size_t at = many; at < group_size; ++at) {
    turn.c[at] = 1.0;
    turn.s[at] = 0.0;
    turn.inverse[at] = 0.5;
  }
#pragma omp simd
  for (std::size_t at = 0; at < many; ++at) put_rotation(blocks, i, at, turn);
}

/// The groups of the blocks [begin, end), which begin and end with a group, or with the last block.
struct Groups {
  const std::uint32_t* begins;
  std::size_t blocks;
  /// Calls body(i, many, modes) for each group with modes: its blocks, from i on, and their modes.
  template <class Body>
  EDDA_INLINE void for_each(std::size_t begin, std::size_t end, Body body) const {
    for (std::size_t i = begin; i < end; i += group_size) {
      const std::size_t g = i / group_size;
      const ModePlaces modes{begins[g], (begins[g + 1] - begins[g]) / group_size};
      if (modes.count > 0) body(i, blocks - i < group_size ? blocks - i : group_size, modes);
    }
  }
};
inline Groups groups_of(const BlockSet& b) {
  return {b.bending.begin.data(), b.size()};
}

/// The derivative by the rotation angle of what the forces g store, N m: sum_a g_a x s_a, since the
/// modes turn with the block. Zero where g is parallel to s.
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wpsabi"
template <class T>
EDDA_INLINE T couple_of(const ModeArray<T>& g, const ModeArray<T>& s, std::size_t count) {
  T sum{};
  for (std::size_t a = 0; a < count; ++a) sum += g.x[a] * s.y[a] - g.y[a] * s.x[a];
  return sum;
}
#pragma GCC diagnostic pop

/// The nodal forces of that couple: the rotation depends on F by d theta = (R J : dF)/(a^2 +
/// b^2)^(1/2), J the rotation by a right angle (kinematics.hpp).
template <class Blocks>
EDDA_INLINE NodeVectors couple_on_nodes(const Blocks& b, const Rotation& r, double couple,
                                        std::size_t i) {
  return nodal_forces_of(b, Deformation{-r.s, -r.c, r.c, -r.s}, -couple * r.inverse, i);
}

/// Adds the nodal forces of the couples of a group.
template <class Blocks>
EDDA_INLINE void add_couple(const Blocks& b, const GroupTurn& turn, const double* couple,
                            NodeValues fx, NodeValues fy, std::size_t i, std::size_t at) {
  add(couple_on_nodes(b, turn.of(at), couple[at], i + at), fx, fy, i + at);
}
template <class Blocks>
EDDA_INLINE void add_couples(const Blocks& b, const GroupTurn& turn, const double* couple,
                             NodeValues fx, NodeValues fy, std::size_t i, std::size_t many) {
#pragma omp simd
  for (std::size_t at = 0; at < many; ++at) add_couple(b, turn, couple, fx, fy, i, at);
}

/// Gradients of the blocks' nodes, for loops.
struct GradientView {
  ConstNodeValues grad_x, grad_y;
};
inline GradientView gradients_of(const BlockSet& b) {
  return {values_of(b.grad_x), values_of(b.grad_y)};
}

}  // namespace edda
