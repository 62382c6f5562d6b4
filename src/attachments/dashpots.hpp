// Viscous boundaries: dashpots between block edges and the ground outside (Lysmer and Kuhlemeyer
// 1969). Theory, section 13.5.
#pragma once

#include <cstdint>
#include <vector>

#include "attachments/loads.hpp"
#include "base/fault.hpp"
#include "blocks/kinematics.hpp"
#include "model/model.hpp"

namespace edda {

/// A dashpot on a material point of a block. Its force on the point is -C (v - r), with the
/// velocity v of the point and the reference velocity r. Two such points (Gauss) integrate the
/// traction of a viscous boundary, -rho c_p (v - r)_n - rho c_s (v - r)_s, over the part of an edge
/// that lies on it; this is exact, since the velocity is linear along an edge. A meshed block has
/// them at its corners instead, which are nodes of its mesh, so that they are lumped as its mass
/// is.
struct Dashpot {
  Id block;
  NodeWeights weight;    ///< area coordinates of the point
  double cxx, cyy, cxy;  ///< N s/m; with the normal of the edge at the start
  Index boundary;        ///< row of Model::boundaries
  double length;         ///< tributary length of the point, m
  Vec2 normal;           ///< outward, at the start
  Id node = no_id;       ///< of all meshes; no_id: the block has none
  Vec2 middle{};         ///< of the tributary length of a node, at the start, m
};

/// Where its block takes the point of a dashpot; of velocities, its velocity.
inline Vec2 point_at(const BlockSet& b, const BodyVectors& u, const Dashpot& at) {
  const Vec2 affine = weighted(at.weight, u, at.block);
  return at.node == no_id ? affine : affine + u.modes[b.bending.modes() + at.node];
}

/// All dashpots, sorted by block and node.
struct Dashpots {
  std::vector<Dashpot> points;
  std::vector<Id> blocks;          ///< blocks that have any, ascending
  std::vector<Id> begin;           ///< [blocks + 1] first point of each
  std::vector<std::uint8_t> acts;  ///< [rows of Model::boundaries] 1: active
  std::vector<Id> damped;          ///< blocks with an active dashpot, ascending
  /// Sets which boundaries are active.
  void set_acting(const std::vector<ActiveInterval>& boundaries);
};

inline bool has_dashpots(BoundaryType type) {
  return type == BoundaryType::viscous || type == BoundaryType::free_field;
}

/// Dashpots of all boundaries of type viscous and free-field, on open faces of free blocks. A
/// boundary without any face is a fault. Wave speeds are those of each block's own rock, c_p =
/// sqrt((lambda + 2 mu)/rho), c_s = sqrt(mu/rho) with the Lame constants of the model's plane, or
/// those given: joints make the mass softer than its rock.
Result<Dashpots> attach_dashpots(const Model& model, const BlockSet& blocks);

}  // namespace edda
