// Blocks that are meshed: their deviations from the affine motion of the three nodes are those of
// the nodes of a mesh of triangles, the zones (theory, section 3.5).
//
// Node j of a mesh is at x_j = sum_k w_kj x_k + d_j: where the block's three nodes take it, and its
// own deviation d_j. Of a force f_j on it the three nodes take P_j f_j, P_j = (1, X_j - C), and the
// deviations the rest,
//   d_j'' = f_j/m_j - P_j . G^-1 sum_i P_i f_i,   G = sum_i m_i P_i P_i^T,
// so that sum_j m_j P_j d_j = 0 stays as it is. m_j are lumped masses; the block as a whole has its
// exact mass and moments of inertia, those of the three nodes. Together this is the mass matrix
//   M^-1 = M_L^-1 + P (I^-1 - G^-1) P^T,  I the exact moments: P^T M P = I.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "base/vec2.hpp"

namespace edda {

inline constexpr std::size_t corners_of_zone = 3;

/// Water in the pores of a zone of a block, under the table of a row of Model::waters at y = level,
/// m.
struct WetZone {
  std::uint32_t zone = 0, block = 0, water = 0;
  double level = 0.0;
};

/// What the forces on the nodes of a mesh have in common with affine motion: sum_j P_j f_j.
struct AffinePart {
  Vec2 one, x, y;
};

/// Constant during a run. All empty where no block is meshed.
struct Meshes {
  std::vector<std::uint32_t> begin;  ///< [nb + 1] first mesh node of each block; its corners first
  std::vector<double> arm_x, arm_y;  ///< [mesh nodes] X_j - C at the start, m
  std::vector<double> share;         ///< [mesh nodes] m_j over the mass of the block
  std::vector<std::array<double, 6>>
      inverse;  ///< [nb] (G/mass)^-1, entries 11 12 13 22 23 33; 0 where it is not meshed
  std::vector<std::uint32_t> zone_begin;  ///< [nb + 1] first zone of each block
  std::vector<std::array<std::uint32_t, corners_of_zone>>
      zone;  ///< [zones] nodes, counter-clockwise

  bool any() const { return !share.empty(); }
  std::size_t nodes() const { return share.size(); }
  /// The number of mesh nodes of block i.
  std::size_t nodes_of(std::size_t i) const { return begin.empty() ? 0 : begin[i + 1] - begin[i]; }

  /// Adds the force on node j (of all meshes).
  void add(AffinePart& sum, std::size_t j, Vec2 force) const {
    sum.one += force;
    sum.x += arm_x[j] * force;
    sum.y += arm_y[j] * force;
  }
  /// (G/mass)^-1 times it, for block i.
  AffinePart solve(std::size_t i, const AffinePart& p) const {
    const std::array<double, 6>& g = inverse[i];
    return {g[0] * p.one + g[1] * p.x + g[2] * p.y, g[1] * p.one + g[3] * p.x + g[4] * p.y,
            g[2] * p.one + g[4] * p.x + g[5] * p.y};
  }
  /// P_j . p.
  Vec2 at(const AffinePart& p, std::size_t j) const {
    return p.one + arm_x[j] * p.x + arm_y[j] * p.y;
  }
  /// u . M_d^-1 w of the deviations for unit forces at the nodes j and k of block i, times its
  /// mass.
  double inverse_product(std::size_t i, std::size_t j, std::size_t k) const;
};

/// Gradients of the area coordinates of a triangle, counter-clockwise, 1/m.
std::array<Vec2, corners_of_zone> area_gradients(Vec2 a, Vec2 b, Vec2 c);

/// A point in a zone, by its area coordinates.
struct InZone {
  std::size_t zone = 0;  ///< of all meshes
  std::array<double, corners_of_zone> weight{};
};
/// Point p in the zone of block i in which the least of its area coordinates is largest: that which
/// holds p, or one next to it. node: where the nodes of the block's mesh are, m.
InZone in_its_zone(const Meshes& meshes, std::size_t i, std::span<const Vec2> node, Vec2 p);

/// A mesh of a block, relative to its centroid.
struct BlockMesh {
  std::span<const Vec2> node;  ///< first the corners of the block, m
  std::span<const std::array<std::uint32_t, 3>> triangle;
  std::span<const double>
      area{};  ///< of its nodes, m2; empty: a third of each triangle at a corner
};

/// Where the nodes of the mesh of block i were at the start, from its centroid, m.
std::vector<Vec2> arms_of(const Meshes& meshes, std::size_t i);

/// Where the centre of a zone was at the start, from the centroid of its block, m.
inline Vec2 centre_of_zone(const Meshes& meshes, std::size_t zone) {
  Vec2 sum;
  for (const std::uint32_t j : meshes.zone[zone]) sum += Vec2{meshes.arm_x[j], meshes.arm_y[j]};
  return sum / corners_of_zone;
}

/// Appends the mesh of the next block, in the order of the blocks.
void add_mesh(Meshes& meshes, const BlockMesh& mesh);
/// Appends a block that is not meshed.
void add_no_mesh(Meshes& meshes);

}  // namespace edda
