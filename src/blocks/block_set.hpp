// The blocks: everything about them that a run never changes. Flat arrays, structure of arrays.
// Filled by build_blocks(). Coordinates are relative to `origin`.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "base/vec2.hpp"
#include "model/model.hpp"

namespace edda {

/// 32 bits index blocks, vertices and edges: 4e9 vertices are out of reach of one machine.
using Id = std::uint32_t;
inline constexpr Id no_id = 0xffffffffu;

struct BlockSet {
  std::size_t size() const { return area.size(); }                  ///< number of blocks, nb
  std::size_t vertex_count() const { return vertex_block.size(); }  ///< nv

  Vec2 origin;             ///< model coordinates of the local origin
  double thickness = 1.0;  ///< m; areas are in the plane, masses and forces include it

  // Hot: read in every step.
  std::array<std::vector<double>, 3> grad_x,
      grad_y;  ///< [3][nb] G_k, gradient of the area coordinate w_k, 1/m
  std::array<std::vector<double>, 3> weight;  ///< [3][nv] w_k of each vertex, sum 1 (Eq. 22)
  std::array<std::vector<double>, 3>
      node_mass;  ///< [3][nb] lumped m_k, kg (unused by `consistent`)
  std::vector<double> point_inverse,
      edge_inverse;  ///< [nv] w_v^T M^-1 w_v and w_v^T M^-1 w_next, 1/kg (blocks/point_mass.hpp)
  std::vector<double> volume;                ///< [nb] area times thickness, m3
  std::vector<double> lame_lambda, lame_mu;  ///< [nb] Pa, for the model's plane
  std::vector<double> viscosity;    ///< [nb] eta: viscous stress over elastic stress rate, s; empty
                                    ///< where none has any. Filled by fill_viscosity()
  std::vector<std::uint8_t> fixed;  ///< [nb] 1: all nodes held

  std::vector<double> initial_xx, initial_yy,
      initial_xy;  ///< [nb] stress at the start, Pa; all empty without an [initial_stress]

  // Warm: contact search and events. Vertices of a block are contiguous, ring after ring; edge v
  // runs from vertex v to next[v] and has the block on its left.
  std::vector<Id> vertex_begin;     ///< [nb + 1] first vertex of each block
  std::vector<Id> vertex_block;     ///< [nv] block of each vertex
  std::vector<Id> next, previous;   ///< [nv] along the ring
  std::vector<Index> edge_joint;    ///< [nv] law named by edge v, or none
  std::vector<double> edge_length;  ///< [nv] at the start, m
  std::vector<double>
      corner;  ///< [nv] interior angle at vertex v at the start, rad (> pi: reentrant)
  std::vector<double> turn_cosine,
      turn_sine;  ///< [nv] of the exterior angle there; of a right angle where it is reentrant

  // Cold: building, output.
  std::array<std::vector<double>, 3> node_x,
      node_y;  ///< [3][nb] the cover's nodes X_k at the start, m
  std::array<std::vector<double>, 6>
      inverse_mass;  ///< [6][nb] xx order 11 12 13 22 23 33, 1/kg; `consistent` only
  std::vector<double> vertex_x, vertex_y;  ///< [nv] vertices at the start, m
  std::vector<double> area;                ///< [nb] m2
  std::vector<double> initial_zz;          ///< [nb] out of plane, Pa; as initial_xx
  std::vector<double> mass;                ///< [nb] kg
  std::vector<double> damping;  ///< [nb] of the block's softest own mode, a fraction of critical
  std::vector<double> centroid_x, centroid_y;  ///< [nb] at the start, m
  std::vector<double> smallest_edge;           ///< [nb] m
  std::vector<double> radius;       ///< [nb] largest distance of a vertex from the centroid, m
  std::vector<double> inradius;     ///< [nb] half the narrowest extent of the outer ring, m
  std::vector<Index> material;      ///< [nb]
  std::vector<Index> opening;       ///< [nb] that a stage takes the block out for; empty: none does
  std::map<Id, std::string> names;  ///< of the blocks that were given one
  MassKind mass_kind = MassKind::matched;

  /// At the start, m.
  Vec2 vertex(std::size_t v) const { return {vertex_x[v], vertex_y[v]}; }
  /// Empty where none was given.
  std::string_view name(std::size_t i) const {
    const auto found = names.find(static_cast<Id>(i));
    return found == names.end() ? std::string_view{} : found->second;
  }
};

}  // namespace edda
