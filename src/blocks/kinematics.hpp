// Quantities that follow from the nodes of a block: vertices, centroid, deformation,
// rotation.
#pragma once

#include <cmath>

#include "blocks/block_set.hpp"
#include "blocks/nodes.hpp"
#include "blocks/state.hpp"

namespace edda {

/// Whether block i moves: neither fixed nor excavated.
inline bool is_free(const BlockSet& b, const State& s, std::size_t i) {
  return b.fixed[i] == 0 && s.alive[i] != 0;
}

/// Deformation gradient F = sum x_k G_k^T.
struct Deformation {
  double xx, xy, yx, yy;
};

/// sum u_k G_k^T. The gradients of a block sum to 0, so the first node counts by the differences of
/// the others from it. Blocks: BlockSet or a view with its gradients.
template <class Blocks>
EDDA_INLINE Deformation gradient_of(const Blocks& b, const NodeVectors& u, std::size_t i) {
  Deformation f{};
  for (std::size_t k = 1; k < nodes_per_block; ++k) {
    const double ux = u[k].x - u[0].x, uy = u[k].y - u[0].y;
    const double gx = b.grad_x[k][i], gy = b.grad_y[k][i];
    f = {f.xx + ux * gx, f.xy + ux * gy, f.yx + uy * gx, f.yy + uy * gy};
  }
  return f;
}

/// Deformation gradient of block i. Values: Nodes or pointers to them.
template <class Blocks, class Values>
EDDA_INLINE Deformation deformation(const Blocks& b, const Values& x, const Values& y,
                                    std::size_t i) {
  return gradient_of(b, vectors_of(x, y, i), i);
}

/// Nodal forces `factor` P G_k of a stress P; they have no resultant.
template <class Blocks, class Stress>
EDDA_INLINE NodeVectors nodal_forces_of(const Blocks& b, const Stress& p, double factor,
                                        std::size_t i) {
  NodeVectors f{};
  for (std::size_t k = 1; k < nodes_per_block; ++k) {
    const double gx = factor * b.grad_x[k][i], gy = factor * b.grad_y[k][i];
    f[k] = {p.xx * gx + p.xy * gy, p.yx * gx + p.yy * gy};
    f[0] -= f[k];
  }
  return f;
}

/// Rotation R = [c -s; s c] of the polar decomposition F = R U: a = F11 + F22, b = F21 - F12, (c,
/// s) = (a, b)/sqrt(a^2 + b^2). `strength` is that root, 2 for an undeformed block; near 0 the
/// rotation is undefined and the run has diverged. `inverse` is 1/strength.
struct Rotation {
  double c, s, strength, inverse;
};

EDDA_INLINE Rotation rotation(const Deformation& f) {
  const double a = f.xx + f.yy, b = f.yx - f.xy;
  const double r = std::sqrt(a * a + b * b), inverse = 1.0 / r;
  return {a * inverse, b * inverse, r, inverse};
}

/// Weights of the block's centroid: every cover is centred on it.
inline constexpr NodeWeights centroid_weights = [] {
  NodeWeights w{};
  w.fill(1.0 / nodes_per_block);
  return w;
}();

inline Vec2 centroid(const Nodes& x, const Nodes& y, std::size_t i) {
  return resultant(vectors_of(x, y, i)) / nodes_per_block;
}

/// Area coordinates w_k of the material point that was at `point` (local coordinates) at the start.
inline NodeWeights weights_at(const BlockSet& b, std::size_t i, Vec2 point) {
  const Vec2 arm = point - Vec2{b.centroid_x[i], b.centroid_y[i]};
  NodeWeights w = centroid_weights;
  for (std::size_t k = 0; k < nodes_per_block; ++k) {
    w[k] = w[k] + b.grad_x[k][i] * arm.x + b.grad_y[k][i] * arm.y;
  }
  return w;
}

/// Weights of the point at the fraction xi of the way from one vertex of a block to another.
inline NodeWeights weights_between(const BlockSet& b, Id from, Id to, double xi) {
  NodeWeights w;
  for (std::size_t k = 0; k < nodes_per_block; ++k) {
    w[k] = (1.0 - xi) * b.weight[k][from] + xi * b.weight[k][to];
  }
  return w;
}

/// Adds a force on vertex v to the nodes of its block.
inline void spread(NodeVectors& on_nodes, const BlockSet& b, Id v, Vec2 force) {
  spread(on_nodes, weights_of(b.weight, v), force);
}

/// Forces on one block, from those at its corners and at other points of it.
struct BlockForces {
  const BlockSet& blocks;
  std::size_t block;
  NodeVectors nodes{};
  ModeVectors* modes = nullptr;  ///< to which those on its modes are added; null: on nodes alone
  std::size_t first = 0;         ///< the mode of all blocks with which `modes` begins

  void at_corner(Id v, Vec2 force) {
    spread(nodes, blocks, v, force);
    bend_at(v, force);
  }
  /// On the modes alone.
  void bend_at(Id v, Vec2 force) {
    if (modes == nullptr) return;
    BlockModes own = blocks.modes(block);
    own.first -= first;
    own.spread(*modes, v - blocks.vertex_begin[block], force);
  }
  /// On the block as its nodes move it.
  void at_point(const NodeWeights& w, Vec2 force, double factor = 1.0) {
    spread(nodes, w, force, factor);
  }
};

inline Vec2 vertex_at(const BlockSet& b, const Nodes& x, const Nodes& y, std::size_t v) {
  return weighted(weights_of(b.weight, v), x, y, b.vertex_block[v]);
}

/// Where the modes and nodes take vertex v; of velocities, its velocity.
inline Vec2 corner_at(const BlockSet& b, const Nodes& x, const Nodes& y, const ModeVectors& bend,
                      std::size_t v) {
  const std::size_t i = b.vertex_block[v];
  const BlockModes modes = b.modes(i);
  const Vec2 affine = vertex_at(b, x, y, v);
  return modes.count == 0 ? affine : affine + modes.at(bend, v - b.vertex_begin[i]);
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
