// Vectors in all degrees of freedom of the blocks: those of the nodes, then those of the modes
// (theory, sections 2 and 3.4). How a block is made is known where these are computed; others see
// its corners (blocks/kinematics.hpp) and what follows here.
#pragma once

#include <cassert>

#include "blocks/bending.hpp"
#include "blocks/nodes.hpp"

namespace edda {

/// Positions, displacements or velocities of all blocks, or forces on them.
struct BodyVectors {
  Nodes x, y;         ///< [nodes][nb] of the nodes
  ModeVectors modes;  ///< [modes] at the places that BlockModes names
};

inline bool is_empty(const BodyVectors& u) {
  bool empty = u.modes.x.empty() && u.modes.y.empty();
  for (const Nodes* nodes : {&u.x, &u.y}) {
    for (const std::vector<double>& values : *nodes) empty = empty && values.empty();
  }
  return empty;
}

/// Of the nodes of block i.
inline NodeVectors vectors_of(const BodyVectors& u, std::size_t i) {
  return vectors_of(u.x, u.y, i);
}
inline void store(const NodeVectors& v, BodyVectors& u, std::size_t i) {
  store(v, u.x, u.y, i);
}
inline void add(const NodeVectors& v, BodyVectors& u, std::size_t i) {
  add(v, u.x, u.y, i);
}

/// Of the modes of one block: few of one that bends, or those of all nodes of a mesh.
class BodyModes {
 public:
  explicit BodyModes(std::size_t count) {
    if (count > most_modes) {
      many_.assign(count, Vec2{});
    } else {
      for (std::size_t a = 0; a < count; ++a) few_.set(a, {});
    }
  }
  Vec2 operator[](std::size_t a) const { return many_.empty() ? few_[a] : many_[a]; }
  void set(std::size_t a, Vec2 v) {
    if (many_.empty()) {
      few_.set(a, v);
    } else {
      many_[a] = v;
    }
  }
  /// Of a block that bends.
  const ModesOfBlock& of_bending() const { return few_; }
  /// Copies `count` of them, and not the room for more.
  void copy(const BodyModes& other, std::size_t count) {
    many_ = other.many_;
    for (std::size_t a = 0; many_.empty() && a < count; ++a) few_.set(a, other.few_[a]);
  }

 private:
  ModesOfBlock few_;
  std::vector<Vec2> many_;
};

/// Those of one block.
struct BodyVector {
  NodeVectors nodes{};
  std::size_t count = 0;  ///< of its modes
  BodyModes modes;        ///< `count` of them

  explicit BodyVector(std::size_t modes_of_block = 0)
      : count(modes_of_block), modes(modes_of_block) {}
  BodyVector(const BodyVector& other) : BodyVector() { *this = other; }
  BodyVector& operator=(const BodyVector& other) {
    nodes = other.nodes;
    count = other.count;
    modes.copy(other.modes, count);
    return *this;
  }
};

inline BodyVector& operator+=(BodyVector& u, const BodyVector& v) {
  assert(u.count == v.count);
  u.nodes = u.nodes + v.nodes;
  for (std::size_t a = 0; a < u.count; ++a) u.modes.set(a, u.modes[a] + v.modes[a]);
  return u;
}
inline BodyVector& operator*=(BodyVector& u, double s) {
  u.nodes = s * u.nodes;
  for (std::size_t a = 0; a < u.count; ++a) u.modes.set(a, s * u.modes[a]);
  return u;
}
inline BodyVector operator/(BodyVector u, double s) {
  for (Vec2& of_node : u.nodes) of_node = of_node / s;
  for (std::size_t a = 0; a < u.count; ++a) u.modes.set(a, u.modes[a] / s);
  return u;
}
inline BodyVector& operator-=(BodyVector& u, const BodyVector& v) {
  assert(u.count == v.count);
  u.nodes = u.nodes - v.nodes;
  for (std::size_t a = 0; a < u.count; ++a) u.modes.set(a, u.modes[a] - v.modes[a]);
  return u;
}
inline BodyVector operator+(BodyVector u, const BodyVector& v) {
  return u += v;
}
inline BodyVector operator-(BodyVector u, const BodyVector& v) {
  return u -= v;
}
inline BodyVector operator*(double s, BodyVector u) {
  return u *= s;
}

/// The work of forces over displacements.
inline double dot(const BodyVector& u, const BodyVector& v) {
  assert(u.count == v.count);
  double sum = dot(u.nodes, v.nodes);
  for (std::size_t a = 0; a < u.count; ++a) sum += dot(u.modes[a], v.modes[a]);
  return sum;
}

/// sum of u . v over the modes of a block, by their masses.
inline double mode_product(const BlockModes& modes, const ModeVectors& u, const ModeVectors& v) {
  double sum = 0.0;
  for (std::size_t a = 0; a < modes.count; ++a)
    sum += modes.mass(a) * dot(u[modes[a]], v[modes[a]]);
  return sum;
}

}  // namespace edda
