// Boundaries of type fixed, roller and velocity: linear springs from block vertices to where they
// started, or to where the boundary has moved since.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "base/fault.hpp"
#include "blocks/block_set.hpp"
#include "blocks/pose.hpp"
#include "blocks/state.hpp"
#include "model/model.hpp"

namespace edda {

/// Springs sorted by (block, vertex, boundary). Force on the vertex: -K (x - x_start - shift), K
/// symmetric.
struct BoundarySprings {
  std::vector<Id> vertex;                       ///< [ns]
  std::vector<Index> boundary;                  ///< [ns] row of Model::boundaries
  std::vector<double> kxx, kyy, kxy;            ///< [ns] N/m; 0 while the boundary does not act
  std::vector<std::array<double, 3>> acting_k;  ///< [ns] kxx, kyy, kxy of those that act
  std::vector<double> start_x, start_y;         ///< [ns] m
  std::vector<Id> block_begin;                  ///< [nb + 1]
  std::vector<Vec2> shift, shift_1;  ///< [rows of Model::boundaries] how far the boundary has
                                     ///< moved by step n and by step n - 1, m
  std::size_t size() const { return vertex.size(); }
  /// Springs of one boundary act no more.
  void release(Index row);
  /// Springs of one boundary act from where their vertices are at x, y.
  void engage(Index row, const std::vector<double>& x, const std::vector<double>& y);
};

inline bool has_springs(BoundaryType type) {
  return type == BoundaryType::fixed || type == BoundaryType::roller ||
         type == BoundaryType::velocity;
}

/// What spring q does to its vertex at x, y, N.
inline Vec2 spring_force(const BoundarySprings& s, std::size_t q, const std::vector<double>& x,
                         const std::vector<double>& y) {
  const Id v = s.vertex[q];
  const Vec2 shift = s.shift[static_cast<std::size_t>(s.boundary[q])];
  const double ux = x[v] - s.start_x[q] - shift.x, uy = y[v] - s.start_y[q] - shift.y;
  return {-(s.kxx[q] * ux + s.kxy[q] * uy), -(s.kxy[q] * ux + s.kyy[q] * uy)};
}

/// Springs of all boundaries that have them, on vertices of blocks that are not held. A vertex is
/// on a boundary when it lies within the snap distance of the side or polyline. A boundary that
/// finds no vertex is a fault.
Result<BoundarySprings> attach_boundaries(const Model& model, const BlockSet& blocks);

/// Their stored energy in the ledger's terms, sum of u_{n-1} K u_n / 2, J.
double boundary_energy(const BoundarySprings& springs, const Pose& pose);

}  // namespace edda
