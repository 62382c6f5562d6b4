// Quantities that follow from the nodes of a block: vertices, centroid, deformation,
// rotation.
#pragma once

#include <cassert>
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

/// sum u_k G_k^T. Gradients of area coordinates sum to 0, so the first node counts by the
/// differences of the others from it.
EDDA_INLINE Deformation gradient_of(const NodeVectors& gradient, const NodeVectors& u) {
  Deformation f{};
  for (std::size_t k = 1; k < nodes_per_block; ++k) {
    const double ux = u[k].x - u[0].x, uy = u[k].y - u[0].y;
    const double gx = gradient[k].x, gy = gradient[k].y;
    f = {f.xx + ux * gx, f.xy + ux * gy, f.yx + uy * gx, f.yy + uy * gy};
  }
  return f;
}

/// Of block i. Blocks: BlockSet or a view with its gradients.
template <class Blocks>
EDDA_INLINE Deformation gradient_of(const Blocks& b, const NodeVectors& u, std::size_t i) {
  return gradient_of(vectors_of(b.grad_x, b.grad_y, i), u);
}

/// Deformation gradient of block i. Values: Nodes or pointers to them.
template <class Blocks, class Values>
EDDA_INLINE Deformation deformation(const Blocks& b, const Values& x, const Values& y,
                                    std::size_t i) {
  return gradient_of(b, vectors_of(x, y, i), i);
}

inline Deformation deformation(const BlockSet& b, const BodyVectors& u, std::size_t i) {
  return deformation(b, u.x, u.y, i);
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

inline Vec2 centroid(const BodyVectors& u, std::size_t i) {
  return centroid(u.x, u.y, i);
}

inline Vec2 weighted(const NodeWeights& w, const BodyVectors& u, std::size_t i) {
  return weighted(w, u.x, u.y, i);
}

/// Area coordinates w_k of the material point that was at `arm` from the centroid at the start.
inline NodeWeights weights_of_arm(const BlockSet& b, std::size_t i, Vec2 arm) {
  NodeWeights w = centroid_weights;
  for (std::size_t k = 0; k < nodes_per_block; ++k) {
    w[k] = w[k] + b.grad_x[k][i] * arm.x + b.grad_y[k][i] * arm.y;
  }
  return w;
}

/// The same of the one that was at `point` (local coordinates).
inline NodeWeights weights_at(const BlockSet& b, std::size_t i, Vec2 point) {
  return weights_of_arm(b, i, point - Vec2{b.centroid_x[i], b.centroid_y[i]});
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

/// Of all blocks, all 0.
inline BodyVectors zero_vectors(const BlockSet& b) {
  BodyVectors u{zero_nodes(b.size()), zero_nodes(b.size()), {}};
  u.modes.assign(b.mode_places(), 0.0);
  return u;
}

/// Whether they are of these blocks.
inline bool fits(const BlockSet& b, const BodyVectors& u) {
  bool good = u.modes.x.size() == b.mode_places() && u.modes.y.size() == b.mode_places();
  for (const Nodes* nodes : {&u.x, &u.y}) {
    for (const std::vector<double>& values : *nodes) good = good && values.size() == b.size();
  }
  return good;
}

/// The vectors of block i.
inline BodyVector vector_of(const BlockSet& b, const BodyVectors& u, std::size_t i) {
  const BlockModes modes = b.modes(i);
  assert(modes.count == 0 || modes[modes.count - 1] < u.modes.size());
  BodyVector v(modes.count);
  v.nodes = vectors_of(u, i);
  for (std::size_t a = 0; a < v.count; ++a) v.modes.set(a, u.modes[modes[a]]);
  return v;
}
inline void store(const BodyVector& v, const BlockSet& b, BodyVectors& u, std::size_t i) {
  const BlockModes modes = b.modes(i);
  store(v.nodes, u, i);
  for (std::size_t a = 0; a < v.count; ++a) u.modes.set(modes[a], v.modes[a]);
}
inline void add(const BodyVector& v, const BlockSet& b, BodyVectors& u, std::size_t i) {
  store(vector_of(b, u, i) + v, b, u, i);
}
/// Sets those of block i to 0.
inline void set_zero(const BlockSet& b, BodyVectors& u, std::size_t i) {
  store(BodyVector(b.count_modes(i)), b, u, i);
}
/// Whether the vectors of block i are finite.
inline bool is_finite(const BlockSet& b, const BodyVectors& u, std::size_t i) {
  const BodyVector v = vector_of(b, u, i);
  Vec2 sum = resultant(v.nodes);
  for (std::size_t a = 0; a < v.count; ++a) sum += v.modes[a];
  return std::isfinite(sum.x + sum.y);
}

/// Forces on one block, from those at its corners and at other points of it.
struct BlockForces {
  const BlockSet& blocks;
  std::size_t block;
  BodyVector sum{blocks.count_modes(block)};

  void at_corner(Id v, Vec2 force) {
    spread(sum.nodes, blocks, v, force);
    bend_at(v, force);
  }
  /// On the modes alone.
  void bend_at(Id v, Vec2 force) {
    if (sum.count == 0) return;
    const BlockModes modes = blocks.modes(block);
    const std::size_t corner = v - blocks.vertex_begin[block];
    if (modes.of_mesh()) return sum.modes.set(corner, sum.modes[corner] + force);
    for (std::size_t a = 0; a < sum.count; ++a)
      sum.modes.set(a, sum.modes[a] + modes.of(a, corner) * force);
  }
  /// On the three corners of a zone of its mesh, each of which the block's three nodes take along.
  void on_zone(std::size_t zone, const NodeVectors& forces) {
    static_assert(corners_of_zone == nodes_per_block);
    const Meshes& m = blocks.meshes;
    for (std::size_t k = 0; k < corners_of_zone; ++k) {
      const std::size_t j = m.zone[zone][k], a = j - m.begin[block];
      spread(sum.nodes, weights_of_arm(blocks, block, {m.arm_x[j], m.arm_y[j]}), forces[k]);
      sum.modes.set(a, sum.modes[a] + forces[k]);
    }
  }
};

/// Deviation of vertex v from the affine motion of its block.
inline Vec2 deviation_at(const BlockSet& b, const BodyVectors& u, std::size_t v) {
  const std::size_t i = b.vertex_block[v];
  return b.modes(i).at(u.modes, v - b.vertex_begin[i]);
}

/// Root of the mean square, by their masses, of the deviations of the corners or mesh nodes of
/// block i: the shapes of its modes are orthonormal.
inline double mean_deviation(const BlockSet& b, const BodyVectors& u, std::size_t i) {
  const BlockModes modes = b.modes(i);
  if (modes.count == 0) return 0.0;
  const double mean = mode_product(modes, u.modes, u.modes);
  return std::sqrt(modes.of_mesh() ? mean : mean / static_cast<double>(modes.corners));
}

/// Where its block takes vertex v; of velocities, its velocity.
inline Vec2 corner_at(const BlockSet& b, const BodyVectors& u, std::size_t v) {
  const Vec2 affine = weighted(weights_of(b.weight, v), u, b.vertex_block[v]);
  return b.mode_places() > 0 ? affine + deviation_at(b, u, v) : affine;
}

/// The same with the vectors of its block.
inline Vec2 corner_at(const BlockSet& b, const BodyVector& u, std::size_t v) {
  const std::size_t i = b.vertex_block[v];
  Vec2 at = weighted(weights_of(b.weight, v), u.nodes);
  const BlockModes modes = b.modes(i);
  const std::size_t corner = v - b.vertex_begin[i];
  if (modes.of_mesh()) return at + u.modes[corner];
  for (std::size_t a = 0; a < u.count; ++a) at += modes.of(a, corner) * u.modes[a];
  return at;
}

/// The affine part of a block's motion: at + F arm, `arm` from the centroid at the start.
struct AffineMotion {
  Vec2 at;
  Deformation f;
  Vec2 of(double x, double y) const { return at + Vec2{f.xx * x + f.xy * y, f.yx * x + f.yy * y}; }
};
inline AffineMotion affine_motion(const BlockSet& b, const NodeVectors& u, std::size_t i) {
  return {resultant(u) / nodes_per_block, gradient_of(b, u, i)};
}

/// Where its block i takes node j (of all meshes); of velocities, its velocity.
inline Vec2 mesh_node_at(const BlockSet& b, const BodyVectors& u, std::size_t i, std::size_t j) {
  const AffineMotion affine = affine_motion(b, vectors_of(u, i), i);
  return affine.of(b.meshes.arm_x[j], b.meshes.arm_y[j]) + u.modes[b.bending.modes() + j];
}

/// Where its block i takes the corners of a zone; of velocities, theirs.
inline NodeVectors zone_at(const BlockSet& b, const BodyVectors& u, std::size_t i,
                           std::size_t zone) {
  const AffineMotion affine = affine_motion(b, vectors_of(u, i), i);
  NodeVectors at;
  for (std::size_t k = 0; k < corners_of_zone; ++k) {
    const std::size_t j = b.meshes.zone[zone][k];
    at[k] = affine.of(b.meshes.arm_x[j], b.meshes.arm_y[j]) + u.modes[b.bending.modes() + j];
  }
  return at;
}

/// Positions of a block after it has turned by `angle` (rad) about `centre`, which has moved.
inline BodyVector rigid_positions(BodyVector at, Vec2 centre, Vec2 moved, double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  const auto turned = [c, s](Vec2 v) { return c * v + s * perp(v); };
  for (Vec2& of_node : at.nodes) of_node = centre + moved + turned(of_node - centre);
  for (std::size_t a = 0; a < at.count; ++a) at.modes.set(a, turned(at.modes[a]));
  return at;
}

/// Velocities of a block at these positions that moves as a rigid body of which `centre` has this
/// velocity; spin in rad/s.
inline BodyVector rigid_velocities(BodyVector at, Vec2 centre, Vec2 velocity, double spin) {
  for (Vec2& of_node : at.nodes) of_node = velocity + spin * perp(of_node - centre);
  for (std::size_t a = 0; a < at.count; ++a) at.modes.set(a, spin * perp(at.modes[a]));
  return at;
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
