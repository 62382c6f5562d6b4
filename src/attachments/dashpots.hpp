// Boundaries that let waves out: dashpots between block edges and the ground beyond (Lysmer and
// Kuhlemeyer 1969).
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "attachments/loads.hpp"
#include "base/fault.hpp"
#include "blocks/block_set.hpp"
#include "model/model.hpp"

namespace edda {

/// A dashpot on a material point of a block: force -C (v - r) on the point, v its velocity, r that
/// of what it is held to. The traction of a viscous boundary, -rho c_p (v - r)_n - rho c_s (v -
/// r)_s, is integrated over the part of an edge that lies on it by two such points (Gauss):
/// exactly, as the velocity is linear along an edge.
struct Dashpot {
  Id block;
  std::array<double, 3> weight;  ///< area coordinates of the point
  double cxx, cyy, cxy;          ///< N s/m; with the normal that the edge had at the start
  Index boundary;                ///< row of Model::boundaries
  double length;                 ///< of the face that the point stands for, m
  Vec2 normal;                   ///< outward, at the start
};

/// All of them, sorted by block.
struct Dashpots {
  std::vector<Dashpot> points;
  std::vector<Id> blocks;          ///< that have any, ascending
  std::vector<Id> begin;           ///< [blocks + 1] first point of each
  std::vector<std::uint8_t> acts;  ///< [rows of Model::boundaries]
  std::vector<Id> damped;          ///< blocks with a dashpot that acts, ascending
  /// Says which boundaries act.
  void set_acting(const std::vector<Spell>& boundaries);
};

inline bool has_dashpots(BoundaryType type) {
  return type == BoundaryType::viscous || type == BoundaryType::free_field;
}

/// Dashpots of all boundaries of type viscous and free-field, on open faces of blocks that are not
/// held. A boundary that finds no face is a fault. Wave speeds are those of each block's own rock,
/// c_p = sqrt((lambda + 2 mu)/rho), c_s = sqrt(mu/rho) with the Lame constants of the model's
/// plane, or those given: joints make the mass softer than its rock.
Result<Dashpots> attach_dashpots(const Model& model, const BlockSet& blocks);

}  // namespace edda
