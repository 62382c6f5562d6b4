// What the three nodes of a block say: vertices, centroid, deformation, rotation. Small and inline,
// so that every stage says it in the same way.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

#include "base/vec2.hpp"
#include "base/vector_loop.hpp"
#include "blocks/block_set.hpp"
#include "blocks/state.hpp"

namespace edda {

using Nodes = std::array<std::vector<double>, 3>;

/// The same for the loops over all blocks (base/vector_loop.hpp).
using NodeValues = std::array<double*, 3>;
using ConstNodeValues = std::array<const double*, 3>;
inline NodeValues values_of(Nodes& n) {
  return {n[0].data(), n[1].data(), n[2].data()};
}
inline ConstNodeValues values_of(const Nodes& n) {
  return {n[0].data(), n[1].data(), n[2].data()};
}

/// Whether block i moves: neither held nor taken out.
inline bool is_free(const BlockSet& b, const State& s, std::size_t i) {
  return b.fixed[i] == 0 && s.alive[i] != 0;
}

/// Mass that moves block i as a whole, kg: more than its weight says where inertia has been raised.
/// (Of `consistent`, M^-1 of a uniform acceleration: the cover is centred on the centroid.)
inline double inertia_of(const BlockSet& b, std::size_t i) {
  if (b.mass_kind != MassKind::consistent) {
    return b.node_mass[0][i] + b.node_mass[1][i] + b.node_mass[2][i];
  }
  const auto& m = b.inverse_mass;
  return 9.0 / (m[0][i] + m[3][i] + m[5][i] + 2.0 * (m[1][i] + m[2][i] + m[4][i]));
}

/// Deformation gradient F = sum x_k G_k^T.
struct Deformation {
  double xx, xy, yx, yy;
};

/// sum u_k w_k: a row of F times a column of the gradients.
template <class Values, class Weights>
EDDA_INLINE double sum_over_nodes(const Values& u, const Weights& w, std::size_t i) {
  return u[0][i] * w[0][i] + u[1][i] * w[1][i] + u[2][i] * w[2][i];
}

/// Of block i. Blocks: BlockSet or what has its gradients; Values: Nodes or pointers to them.
template <class Blocks, class Values>
EDDA_INLINE Deformation deformation(const Blocks& b, const Values& x, const Values& y,
                                    std::size_t i) {
  return {sum_over_nodes(x, b.grad_x, i), sum_over_nodes(x, b.grad_y, i),
          sum_over_nodes(y, b.grad_x, i), sum_over_nodes(y, b.grad_y, i)};
}

/// Rotation R = [c -s; s c] of the polar decomposition F = R U: a = F11 + F22, b = F21 - F12,
/// (c, s) = (a, b)/sqrt(a^2 + b^2). `strength` is that root, 2 for an undeformed block; near 0 the
/// rotation is undefined and the run has diverged.
struct Rotation {
  double c, s, strength;
};

EDDA_INLINE Rotation rotation(const Deformation& f) {
  const double a = f.xx + f.yy, b = f.yx - f.xy;
  const double r = std::sqrt(a * a + b * b);
  return {a / r, b / r, r};
}

/// Material point of weights (1/3, 1/3, 1/3): every cover is centred on the block's centroid.
inline Vec2 centroid(const Nodes& x, const Nodes& y, std::size_t i) {
  return {(x[0][i] + x[1][i] + x[2][i]) / 3.0, (y[0][i] + y[1][i] + y[2][i]) / 3.0};
}

/// Area coordinates w_k of the material point that was at `point` (local coordinates) at the start.
inline std::array<double, 3> weights_at(const BlockSet& b, std::size_t i, Vec2 point) {
  const Vec2 arm = point - Vec2{b.centroid_x[i], b.centroid_y[i]};
  std::array<double, 3> w;
  for (std::size_t k = 0; k < 3; ++k) {
    w[k] = 1.0 / 3.0 + b.grad_x[k][i] * arm.x + b.grad_y[k][i] * arm.y;
  }
  return w;
}

inline Vec2 weighted(const std::array<double, 3>& w, const Nodes& x, const Nodes& y,
                     std::size_t i) {
  return {w[0] * x[0][i] + w[1] * x[1][i] + w[2] * x[2][i],
          w[0] * y[0][i] + w[1] * y[1][i] + w[2] * y[2][i]};
}

/// Adds a force on vertex v to the nodes of its block, with the vertex's weights.
inline void spread(std::array<Vec2, 3>& on_nodes, const BlockSet& b, Id v, Vec2 force) {
  for (std::size_t k = 0; k < 3; ++k) on_nodes[k] += b.weight[k][v] * force;
}

inline Vec2 vertex_at(const BlockSet& b, const Nodes& x, const Nodes& y, std::size_t v) {
  const std::size_t i = b.vertex_block[v];
  return weighted({b.weight[0][v], b.weight[1][v], b.weight[2][v]}, x, y, i);
}

/// Symmetric 2 x 2 tensor.
struct Tensor {
  double xx = 0.0, yy = 0.0, xy = 0.0;
};

/// Corotated strain R^T F - I (symmetric by the choice of R).
inline Tensor corotated_strain(const Deformation& f, const Rotation& r) {
  return {r.c * f.xx + r.s * f.yx - 1.0, r.c * f.yy - r.s * f.xy - 1.0, r.c * f.xy + r.s * f.yy};
}

}  // namespace edda
