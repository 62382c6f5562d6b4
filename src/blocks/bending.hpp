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
//   K = (1 - E) D (1 - E) + sum_b kappa_b e_b e_b^T,  E = sum_b e_b e_b^T:
// e_b are the motions that stresses make which are linear over the block, as in bending, of which
// kappa_b is exact, and D = diag(k_a) is the stiffness of a boundary that moves by itself
// (bending.cpp).
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/vec2.hpp"
#include "base/vector_loop.hpp"

namespace edda {

/// Numbers of the modes of all blocks, one block after the other.
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
  std::vector<std::uint32_t> begin;      ///< [nb + 1] first mode of each block
  std::vector<std::size_t> shape_begin;  ///< [nb + 1] where its shapes begin
  std::vector<double> shape;             ///< h_av: of each mode of a block, of each of its corners
  std::vector<double> stiffness;         ///< [modes] k_a, N/m
  std::array<ModeVectors, bendings> axis;           ///< [4][modes] e_b; 0: none
  std::array<std::vector<double>, bendings> kappa;  ///< [4][nb] kappa_b, N/m
  std::vector<double> rest_stiffness;               ///< [nb] mean of k_a beside the bendings, N/m

  std::size_t modes() const { return stiffness.size(); }
  bool any() const { return !stiffness.empty(); }
  /// The number of modes of block i.
  std::size_t modes_of(std::size_t i) const { return begin.empty() ? 0 : begin[i + 1] - begin[i]; }
};

/// The most corners of a block that bends. A block with more is uniform: its shapes take the square
/// of their number.
inline constexpr std::size_t most_corners_that_bend = 48;
inline constexpr std::size_t most_modes = most_corners_that_bend - 3;

/// The modes of one block, and their shapes at its corners.
struct BlockModes {
  std::size_t first, count;  ///< its modes
  const double* shape;       ///< [count][corners]
  std::size_t corners;
  /// h_a at the corner `at`, counted from the block's first.
  double of(std::size_t a, std::size_t at) const { return shape[a * corners + at]; }
  /// sum_a h_a v_a at a corner.
  Vec2 at(const ModeVectors& v, std::size_t corner) const {
    Vec2 sum;
    for (std::size_t a = 0; a < count; ++a) sum += of(a, corner) * v[first + a];
    return sum;
  }
  /// Adds a force on a corner to those on the modes.
  void spread(ModeVectors& on, std::size_t corner, Vec2 force) const {
    for (std::size_t a = 0; a < count; ++a) on.add(first + a, of(a, corner) * force);
  }
  /// The sum of the squares of the shapes at a corner, and their product at two.
  double product(std::size_t corner, std::size_t other) const {
    double sum = 0.0;
    for (std::size_t a = 0; a < count; ++a) sum += of(a, corner) * of(a, other);
    return sum;
  }
};
inline BlockModes modes_of(const Bending& b, std::size_t i, std::size_t corners) {
  if (b.begin.empty()) return {0, 0, nullptr, corners};
  return {b.begin[i], b.begin[i + 1] - b.begin[i], b.shape.data() + b.shape_begin[i], corners};
}

/// Numbers of the modes of one block along its bendings, and what they are beside these.
struct BentParts {
  double along[bendings];
};
/// sum_a e_ba . v_a.
template <class Values>
inline BentParts bent_parts(const Bending& b, const BlockModes& modes, const Values& v) {
  BentParts parts{};
  for (std::size_t a = 0; a < modes.count; ++a) {
    for (std::size_t k = 0; k < bendings; ++k)
      parts.along[k] += dot(b.axis[k][modes.first + a], v(a));
  }
  return parts;
}
/// sum_b e_ba alpha_b.
inline Vec2 of_bendings(const Bending& b, const BentParts& parts, std::size_t mode) {
  Vec2 sum;
  for (std::size_t k = 0; k < bendings; ++k) sum += parts.along[k] * b.axis[k][mode];
  return sum;
}

/// K s of block i into `out`, with s(a) of its modes.
template <class Values>
inline void mode_stress(const Bending& b, const BlockModes& modes, std::size_t i, const Values& s,
                        Vec2* out) {
  BentParts alpha = bent_parts(b, modes, s);
  for (std::size_t a = 0; a < modes.count; ++a) {
    const std::size_t m = modes.first + a;
    out[a] = b.stiffness[m] * (s(a) - of_bendings(b, alpha, m));
  }
  const BentParts gamma = bent_parts(b, modes, [out](std::size_t a) { return out[a]; });
  for (std::size_t k = 0; k < bendings; ++k)
    alpha.along[k] = b.kappa[k][i] * alpha.along[k] - gamma.along[k];
  for (std::size_t a = 0; a < modes.count; ++a) out[a] += of_bendings(b, alpha, modes.first + a);
}

/// Polygon of a block, for its modes.
struct BendingBlock {
  const std::vector<Vec2>& corner;       ///< relative to the centroid, m
  const std::vector<Vec2>& gradient;     ///< G_v, 1/m
  const std::vector<double>& tributary;  ///< half of the lengths of both edges at the corner, m
  double sxx, syy, sxy;                  ///< central second moments of area, m4
  double lambda, mu;                     ///< Lame's constants in the plane, Pa
  double thickness;                      ///< m
};

/// Appends the modes of the next block.
void add_modes(Bending& bending, const BendingBlock& block);
/// Appends a block that does not bend.
void add_no_modes(Bending& bending);

}  // namespace edda
