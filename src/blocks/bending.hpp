// Blocks that bend: the deviations of their corners from the affine motion of the three nodes
// (theory, section 3.4).
//
// The corner v of a block of n corners is at x_v = sum_k w_kv x_k + sum_a h_av q_a: where the nodes
// take it, and n - 3 modes of amplitude q_a. Edges stay straight. The shapes h_a contain no affine
// motion,
//   sum_v mu_v h_av = 0,  sum_v h_av G_v = 0,  sum_v mu_v h_av h_bv = 1 if a = b, else 0,
// with G_v = (y_v+1 - y_v-1, x_v-1 - x_v+1)/(2 A), for which sum_v x_v G_v^T is the mean of the
// deformation gradient over the block, and mu_v the part of the mass at the corner, n at all of
// them. So the mean strain is that of the nodes, and each mode moves the mass m = M/n.
// With s_a = R^T q_a, R the rotation of the nodes' F, the modes store s^T K s/2,
//   K = D - sum_b less_b e_b e_b^T:
// D = diag(k_a) is the stiffness of a boundary that moves by itself, and the orthonormal e_b take
// away what it is too stiff by where stresses that are linear over the block, as in bending, move
// the corners: of these K is exact (bending.cpp).
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <type_traits>
#include <vector>

#include "base/vec2.hpp"
#include "base/vector_loop.hpp"

namespace edda {

/// Blocks are taken in groups of eight that follow each other, for loops over all of a group.
inline constexpr std::size_t group_size = 8;
using Eight __attribute__((vector_size(64))) = double;

/// The number of blocks with those that would fill the last group.
inline std::size_t in_groups(std::size_t blocks) {
  return (blocks + group_size - 1) / group_size * group_size;
}

/// Numbers of the modes of all blocks, at the places that BlockModes names: those of the groups,
/// with 0 where a block has fewer modes than others of its group, then those of the meshes, of
/// which each node is a mode (meshes.hpp).
struct ModeVectors {
  std::vector<double> x, y;
  std::size_t size() const { return x.size(); }
  void assign(std::size_t modes, double value) {
    x.assign(modes, value);
    y.assign(modes, value);
  }
  Vec2 operator[](std::size_t m) const { return {x[m], y[m]}; }
  void set(std::size_t m, Vec2 v) {
    x[m] = v.x;
    y[m] = v.y;
  }
  void add(std::size_t m, Vec2 v) {
    x[m] += v.x;
    y[m] += v.y;
  }
};

/// The most motions of a block that linear stresses make.
inline constexpr std::size_t bendings = 4;

/// The modes of the blocks, constant during a run. All empty where no block bends.
struct Bending {
  std::vector<std::uint32_t> begin;      ///< [groups + 1] where the places of a group begin
  std::vector<std::uint8_t> count;       ///< [nb] modes of each block
  std::vector<std::size_t> shape_begin;  ///< [nb + 1] where its shapes begin
  std::vector<double> shape;             ///< h_av: of each corner of a block, of each of its modes
  std::vector<double> stiffness;         ///< [places] k_a, N/m
  std::array<ModeVectors, bendings> axis;          ///< [4][places] e_b; 0: none
  std::array<std::vector<double>, bendings> less;  ///< [4][in_groups(nb)] less_b, N/m

  /// The number of places of the groups.
  std::size_t modes() const { return stiffness.size(); }
  bool any() const { return !stiffness.empty(); }
  /// The number of modes of block i.
  std::size_t modes_of(std::size_t i) const { return count.empty() ? 0 : count[i]; }
  /// The first place of the group of block i, or of the next where i is the number of blocks.
  std::size_t begin_of_group(std::size_t i) const {
    return begin[(i + group_size - 1) / group_size];
  }
};

/// The most corners of a block that bends. A block with more is uniform: its shapes take the square
/// of their number.
inline constexpr std::size_t most_corners_that_bend = 48;
inline constexpr std::size_t most_modes = most_corners_that_bend - 3;

/// `count` modes from the place `first` on: of a block in a group, or of all eight.
struct ModePlaces {
  std::size_t first, count;
  /// The place of mode a.
  std::size_t operator[](std::size_t a) const { return first + group_size * a; }
};

/// Numbers of the modes of one block (T = double), or of all of a group (T = Eight).
template <class T>
struct ModeArray {
  T x[most_modes], y[most_modes];
  Vec2 operator[](std::size_t a) const { return {x[a], y[a]}; }
  void set(std::size_t a, Vec2 v) {
    x[a] = v.x;
    y[a] = v.y;
  }
};
using ModesOfBlock = ModeArray<double>;

/// The modes of one block, and their shapes at its corners.
struct BlockModes : ModePlaces {
  const double* shape;  ///< [corners][count]; of a mesh null: its first modes are its corners
  std::size_t corners;
  const double* share = nullptr;  ///< [count] of a mesh: of its nodes (meshes.hpp)

  bool of_mesh() const { return share != nullptr; }
  /// The place of mode a.
  std::size_t operator[](std::size_t a) const { return first + (of_mesh() ? 1 : group_size) * a; }
  /// h_a at the corner `at`, counted from the block's first.
  double of(std::size_t a, std::size_t at) const {
    if (of_mesh()) return a == at ? 1.0 : 0.0;
    return shape[at * count + a];
  }
  /// The mass of mode a, over 1/Masses::mode_inverse.
  double mass(std::size_t a) const { return of_mesh() ? share[a] : 1.0; }
  /// sum_a h_a v_a at a corner.
  Vec2 at(const ModeVectors& v, std::size_t corner) const {
    if (of_mesh()) return v[first + corner];
    Vec2 sum;
    for (std::size_t a = 0; a < count; ++a) sum += of(a, corner) * v[(*this)[a]];
    return sum;
  }
  /// The sum of the squares of the shapes at a corner, and their product at two.
  double product(std::size_t corner, std::size_t other) const {
    double sum = 0.0;
    for (std::size_t a = 0; a < count; ++a) sum += of(a, corner) * of(a, other);
    return sum;
  }
};
EDDA_INLINE BlockModes modes_of(const Bending& b, std::size_t i, std::size_t corners) {
  if (b.count.empty()) return {{0, 0}, nullptr, corners};
  return {{b.begin[i / group_size] + i % group_size, b.count[i]},
          b.shape.data() + b.shape_begin[i],
          corners};
}

/// Calls body(count): with the counts that most blocks have as constants.
template <class Body>
EDDA_INLINE void with_count(std::size_t count, Body body) {
  switch (count) {
    case 1:
      return body(std::integral_constant<std::size_t, 1>{});
    case 2:
      return body(std::integral_constant<std::size_t, 2>{});
    case 3:
      return body(std::integral_constant<std::size_t, 3>{});
    case 4:
      return body(std::integral_constant<std::size_t, 4>{});
    default:
      return body(count);
  }
}

// Vectors are passed between inlined functions alone.
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wpsabi"

/// The numbers from a place on: one, or eight.
template <class T>
EDDA_INLINE T from(const double* place) {
  T values;
  std::memcpy(&values, place, sizeof values);
  return values;
}
template <class T>
EDDA_INLINE void to(double* place, const T& values) {
  std::memcpy(place, &values, sizeof values);
}

/// What the modes of all blocks have, for loops.
struct BendingView {
  const double *stiffness, *x[bendings], *y[bendings], *less[bendings];
};
inline BendingView view_of(const Bending& b) {
  BendingView v{b.stiffness.data(), {}, {}, {}};
  for (std::size_t k = 0; k < bendings; ++k) {
    v.x[k] = b.axis[k].x.data();
    v.y[k] = b.axis[k].y.data();
    v.less[k] = b.less[k].data();
  }
  return v;
}

/// Numbers of modes along the bendings of their block.
template <class T>
struct BentParts {
  T along[bendings];
};
/// sum_a e_ba . v_a.
template <class T>
EDDA_INLINE BentParts<T> bent_parts(const BendingView& b, ModePlaces modes, const ModeArray<T>& v) {
  BentParts<T> parts{};
  for (std::size_t a = 0; a < modes.count; ++a) {
    for (std::size_t k = 0; k < bendings; ++k)
      parts.along[k] += from<T>(b.x[k] + modes[a]) * v.x[a] + from<T>(b.y[k] + modes[a]) * v.y[a];
  }
  return parts;
}
/// Adds sum_b e_ba alpha_b to v.
template <class T>
EDDA_INLINE void add_bendings(const BendingView& b, ModePlaces modes, const BentParts<T>& alpha,
                              ModeArray<T>& v) {
  for (std::size_t a = 0; a < modes.count; ++a) {
    for (std::size_t k = 0; k < bendings; ++k) {
      v.x[a] += alpha.along[k] * from<T>(b.x[k] + modes[a]);
      v.y[a] += alpha.along[k] * from<T>(b.y[k] + modes[a]);
    }
  }
}

/// K s of block i, or of the group of which it is the first, in place of s.
template <class T>
EDDA_INLINE void mode_stress(const BendingView& b, ModePlaces modes, std::size_t i,
                             ModeArray<T>& s) {
  BentParts<T> alpha = bent_parts(b, modes, s);
  for (std::size_t k = 0; k < bendings; ++k) alpha.along[k] *= -from<T>(b.less[k] + i);
  for (std::size_t a = 0; a < modes.count; ++a) {
    const T k = from<T>(b.stiffness + modes[a]);
    s.x[a] *= k;
    s.y[a] *= k;
  }
  add_bendings(b, modes, alpha, s);
}

#pragma GCC diagnostic pop

/// Polygon of a block, for its modes.
struct BendingBlock {
  const std::vector<Vec2>& corner;       ///< relative to the centroid, m
  const std::vector<Vec2>& gradient;     ///< G_v, 1/m
  const std::vector<double>& tributary;  ///< half of the lengths of both edges at the corner, m
  double sxx, syy, sxy;                  ///< central second moments of area, m4
  double lambda, mu;                     ///< Lame's constants in the plane, Pa
  double thickness;                      ///< m
};

/// e_b . K e_b of each bending of a block, and last the mean of K on what its modes have beside
/// them, N/m.
std::array<double, bendings + 1> stiffness_along(const Bending& bending, const BlockModes& modes,
                                                 std::size_t i);

/// Appends the modes of the next block, in the order of the blocks.
void add_modes(Bending& bending, const BendingBlock& block);
/// Appends a block that does not bend.
void add_no_modes(Bending& bending);

}  // namespace edda
