// Boundaries of type fixed and roller: linear springs from block vertices to where they started.
#pragma once

#include <cstddef>
#include <vector>

#include "base/fault.hpp"
#include "blocks/block_set.hpp"
#include "blocks/pose.hpp"
#include "blocks/state.hpp"
#include "model/model.hpp"

namespace edda {

/// Springs sorted by (block, vertex, boundary). Force on the vertex: -K (x - x_start), K symmetric.
struct BoundarySprings {
  std::vector<Id> vertex;                ///< [ns]
  std::vector<Index> boundary;           ///< [ns] row of Model::boundaries
  std::vector<double> kxx, kyy, kxy;     ///< [ns] N/m
  std::vector<double> start_x, start_y;  ///< [ns] m
  std::vector<Id> block_begin;           ///< [nb + 1]
  std::size_t size() const { return vertex.size(); }
};

/// Springs of all boundaries on vertices of blocks that are not held. A vertex is on a boundary
/// when it lies within the snap distance of the side or polyline. A boundary that finds no vertex
/// is a fault.
Result<BoundarySprings> attach_boundaries(const Model& model, const BlockSet& blocks);

/// Their stored energy in the ledger's terms, sum of u_{n-1} K u_n / 2, J.
double boundary_energy(const BoundarySprings& springs, const Pose& pose);

}  // namespace edda
