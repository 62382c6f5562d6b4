// Boundaries of type fixed, roller, velocity and displacement (theory, section 13.3): linear
// springs between block vertices and their positions at the start, moved with the boundary.
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
  std::vector<double> kxx, kyy, kxy;            ///< [ns] N/m; 0 while the boundary is not active
  std::vector<std::array<double, 3>> acting_k;  ///< [ns] kxx, kyy, kxy while the boundary is active
  std::vector<double> start_x, start_y;         ///< [ns] m
  std::vector<Id> block_begin;                  ///< [nb + 1]
  std::vector<Vec2> shift, shift_1;  ///< [rows of Model::boundaries] displacement of the boundary
                                     ///< at step n and at step n - 1, m
  std::size_t size() const { return vertex.size(); }
  /// Deactivates the springs of one boundary.
  void release(Index row);
  /// Activates the springs of one boundary, free of force where their vertices are at x, y.
  void engage(Index row, const std::vector<double>& x, const std::vector<double>& y);
  /// Those on a block that was not there begin without force where it is.
  void engage_block(Id block, const std::vector<double>& x, const std::vector<double>& y);
  /// Spring q is without force where its vertex is at x, y.
  void start_at(std::size_t q, const std::vector<double>& x, const std::vector<double>& y);
};

inline bool has_springs(BoundaryType type) {
  return type == BoundaryType::fixed || type == BoundaryType::roller ||
         type == BoundaryType::velocity || type == BoundaryType::displacement;
}

/// Force of spring q on its vertex at x, y, N.
inline Vec2 spring_force(const BoundarySprings& s, std::size_t q, const std::vector<double>& x,
                         const std::vector<double>& y) {
  const Id v = s.vertex[q];
  const Vec2 shift = s.shift[static_cast<std::size_t>(s.boundary[q])];
  const double ux = x[v] - s.start_x[q] - shift.x, uy = y[v] - s.start_y[q] - shift.y;
  return {-(s.kxx[q] * ux + s.kxy[q] * uy), -(s.kxy[q] * ux + s.kyy[q] * uy)};
}

/// Springs of all boundaries that have them, on vertices of free blocks. A vertex is on a boundary
/// if it lies within the snap distance of the side or polyline. A boundary without any vertex is a
/// fault.
Result<BoundarySprings> attach_boundaries(const Model& model, const BlockSet& blocks);

/// Stored energy in the terms of the energy balance, sum of u_{n-1} K u_n / 2, J.
double boundary_energy(const BoundarySprings& springs, const Pose& pose);

}  // namespace edda
