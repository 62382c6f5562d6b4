// The nodes of a block: how many there are, arrays of what belongs to them, and sums over them.
// Nothing outside src/blocks knows their number, but for the public header (library/views.cpp
// checks it).
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "base/vec2.hpp"
#include "base/vector_loop.hpp"

namespace edda {

inline constexpr std::size_t nodes_per_block = 3;
/// Of a block: x and y of its first node, then of the next.
inline constexpr std::size_t degrees_of_freedom = 2 * nodes_per_block;

/// A number of every node, [nodes][nb], or the weights of points, [nodes][points].
using Nodes = std::array<std::vector<double>, nodes_per_block>;

/// The same, for the loops over all blocks (base/vector_loop.hpp).
using NodeValues = std::array<double*, nodes_per_block>;
using ConstNodeValues = std::array<const double*, nodes_per_block>;

using NodeWeights = std::array<double, nodes_per_block>;  ///< w_k of a material point, sum 1
using NodeVectors = std::array<Vec2, nodes_per_block>;    ///< of the nodes of one block

inline NodeValues values_of(Nodes& n) {
  NodeValues values;
  for (std::size_t k = 0; k < nodes_per_block; ++k) values[k] = n[k].data();
  return values;
}
inline ConstNodeValues values_of(const Nodes& n) {
  ConstNodeValues values;
  for (std::size_t k = 0; k < nodes_per_block; ++k) values[k] = n[k].data();
  return values;
}

/// [nodes][size], all 0.
inline Nodes zero_nodes(std::size_t size) {
  Nodes n;
  for (std::vector<double>& values : n) values.assign(size, 0.0);
  return n;
}

/// Weights of the point `at`.
inline NodeWeights weights_of(const Nodes& w, std::size_t at) {
  NodeWeights weights;
  for (std::size_t k = 0; k < nodes_per_block; ++k) weights[k] = w[k][at];
  return weights;
}

/// Vectors of the nodes of block i. Values: Nodes or pointers to them.
template <class Values>
EDDA_INLINE NodeVectors vectors_of(const Values& x, const Values& y, std::size_t i) {
  NodeVectors v;
  for (std::size_t k = 0; k < nodes_per_block; ++k) v[k] = {x[k][i], y[k][i]};
  return v;
}

template <class Values>
EDDA_INLINE void store(const NodeVectors& v, Values& x, Values& y, std::size_t i) {
  for (std::size_t k = 0; k < nodes_per_block; ++k) {
    x[k][i] = v[k].x;
    y[k][i] = v[k].y;
  }
}

EDDA_INLINE NodeVectors operator+(NodeVectors u, const NodeVectors& v) {
  for (std::size_t k = 0; k < nodes_per_block; ++k) u[k] += v[k];
  return u;
}
EDDA_INLINE NodeVectors operator-(NodeVectors u, const NodeVectors& v) {
  for (std::size_t k = 0; k < nodes_per_block; ++k) u[k] -= v[k];
  return u;
}
EDDA_INLINE NodeVectors operator*(double s, NodeVectors v) {
  for (Vec2& of_node : v) of_node = s * of_node;
  return v;
}

template <class Values>
EDDA_INLINE void add(const NodeVectors& v, Values& x, Values& y, std::size_t i) {
  store(vectors_of(x, y, i) + v, x, y, i);
}

inline NodeVectors at_every_node(Vec2 v) {
  NodeVectors u;
  u.fill(v);
  return u;
}

/// sum u_k . v_k: the work of forces over displacements.
EDDA_INLINE double dot(const NodeVectors& u, const NodeVectors& v) {
  double sum = 0.0;
  for (std::size_t k = 0; k < nodes_per_block; ++k) sum += dot(u[k], v[k]);
  return sum;
}

/// sum f_k: the resultant of forces.
EDDA_INLINE Vec2 resultant(const NodeVectors& f) {
  Vec2 sum = f[0];
  for (std::size_t k = 1; k < nodes_per_block; ++k) sum += f[k];
  return sum;
}

/// sum w_k v_k: v at the point with these weights.
EDDA_INLINE Vec2 weighted(const NodeWeights& w, const NodeVectors& v) {
  Vec2 sum = w[0] * v[0];
  for (std::size_t k = 1; k < nodes_per_block; ++k) sum += w[k] * v[k];
  return sum;
}
inline Vec2 weighted(const NodeWeights& w, const Nodes& x, const Nodes& y, std::size_t i) {
  return weighted(w, vectors_of(x, y, i));
}

/// Adds `factor` times a force at the point with these weights to the nodes.
inline void spread(NodeVectors& on_nodes, const NodeWeights& w, Vec2 force, double factor = 1.0) {
  for (std::size_t k = 0; k < nodes_per_block; ++k) on_nodes[k] += (factor * w[k]) * force;
}

}  // namespace edda
