// The blocks: all their properties that are constant during a run. Structure of arrays, filled by
// build_blocks(). Coordinates are relative to `origin`.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "base/vec2.hpp"
#include "blocks/bending.hpp"
#include "blocks/meshes.hpp"
#include "blocks/nodes.hpp"
#include "model/model.hpp"

namespace edda {

/// 32 bits index blocks, vertices and edges; 4e9 vertices exceed the memory of one machine.
using Id = std::uint32_t;
inline constexpr Id no_id = 0xffffffffu;

struct BlockSet {
  std::size_t size() const { return area.size(); }                  ///< number of blocks, nb
  std::size_t vertex_count() const { return vertex_block.size(); }  ///< nv

  Vec2 origin;             ///< model coordinates of the local origin
  double thickness = 1.0;  ///< m; areas are in the plane, masses and forces include it

  // Read in every step.
  // Of the first node G and w follow from the others, and loops over all blocks do not read them.
  Nodes grad_x, grad_y;        ///< [nodes][nb] G_k, gradient of the area coordinate w_k, sum 0, 1/m
  Nodes weight;                ///< [nodes][nv] w_k of each vertex, w_0 = 1 - w_1 - w_2 (Eq. 22)
  std::vector<double> volume;  ///< [nb] area times thickness, m3
  std::vector<double> lame_lambda, lame_mu;  ///< [nb] Pa, for the model's plane
  std::vector<std::uint8_t> fixed;           ///< [nb] 1: fixed block

  std::vector<double> initial_xx, initial_yy,
      initial_xy;  ///< [nb] stress at the start, Pa; all empty without an [initial_stress]

  // Read by the contact search and at events. Vertices of a block are contiguous, ring after ring;
  // edge v runs from vertex v to next[v] and has the block on its left.
  std::vector<Id> vertex_begin;    ///< [nb + 1] first vertex of each block
  std::vector<Id> vertex_block;    ///< [nv] block of each vertex
  std::vector<Id> next, previous;  ///< [nv] neighbours along the ring
  std::vector<Index> edge_joint;   ///< [nv] law named by edge v, or none
  std::vector<Index>
      unnamed_joint;  ///< [nv] law of the edges that name none; empty: all contact.joint
  std::vector<Index> edge_table;    ///< [nv] row of `tables`, or none
  std::vector<std::string> tables;  ///< of the model, from which lines come (PolygonSet)
  std::vector<double> edge_length;  ///< [nv] at the start, m
  /// [nv] Height of the block over the edge at the start, over its Young's modulus, m/Pa.
  std::vector<double> compliance;
  std::vector<double>
      corner;  ///< [nv] interior angle at vertex v at the start, rad (> pi: reentrant)
  std::vector<double> exterior_cosine,
      exterior_sine;  ///< [nv] of the exterior angle at the vertex; of a right angle where it is
                      ///< reentrant, 1 and 0 where the outline is straight within 0.18 degrees

  Bending bending;  ///< modes of the blocks that bend
  Meshes meshes;    ///< of the blocks that are meshed

  // Read for building and output.
  Nodes node_x, node_y;  ///< [nodes][nb] the cover's nodes X_k at the start, m
  std::array<std::vector<double>, 6>
      inverse_mass;  ///< [6][nb] xx order 11 12 13 22 23 33, 1/kg; `consistent` only
  std::vector<double> vertex_x, vertex_y;  ///< [nv] vertices at the start, m
  std::vector<double> area;                ///< [nb] m2
  std::vector<double> initial_zz;          ///< [nb] out of plane, Pa; as initial_xx
  std::vector<double> mass;                ///< [nb] kg
  std::vector<double> damping;  ///< [nb] fraction of critical damping of the block's lowest own
                                ///< mode
  std::vector<std::optional<Rayleigh>> rayleigh;  ///< [nb] of its material
  std::vector<double> centroid_x, centroid_y;     ///< [nb] at the start, m
  std::vector<double> smallest_edge;              ///< [nb] m
  std::vector<double> radius;    ///< [nb] largest distance of a vertex from the centroid, m
  std::vector<double> inradius;  ///< [nb] half the smallest width of the outer ring, m
  std::vector<Index> material;   ///< [nb]
  std::vector<Index> opening;  ///< [nb] owner (Owners) as whose rock or fill a stage excavates the
                               ///< block; empty: none
  std::vector<Index> lining;   ///< [nb] row of Model::linings that the block is; empty: none is
  std::vector<Index> fill;     ///< [nb] row of Model::fills that it is part of; empty: none is
  std::map<Id, std::vector<std::array<Id, 3>>>
      triangles;                    ///< vertices of the triangles of the blocks that are not convex
  std::map<Id, std::string> names;  ///< of the blocks that have one
  MassKind mass_kind = MassKind::matched;  ///< kind of nodal masses (blocks/masses.hpp)

  /// Position of vertex v at the start, m.
  Vec2 vertex(std::size_t v) const { return {vertex_x[v], vertex_y[v]}; }
  /// Whether the corners of block i move beside its nodes.
  bool bends(std::size_t i) const { return bending.modes_of(i) > 0; }
  bool is_meshed(std::size_t i) const { return meshes.nodes_of(i) > 0; }
  bool is_lining(std::size_t i) const { return !lining.empty() && lining[i] != none; }
  bool is_fill(std::size_t i) const { return !fill.empty() && fill[i] != none; }
  /// Whether it is no rock, and is drawn where rock may be.
  bool is_added(std::size_t i) const { return is_lining(i) || is_fill(i); }
  /// The number of modes of block i: of its bending, or of its mesh.
  std::size_t count_modes(std::size_t i) const { return bending.modes_of(i) + meshes.nodes_of(i); }
  /// The number of places of modes of all blocks.
  std::size_t mode_places() const { return bending.modes() + meshes.nodes(); }
  /// The modes of block i.
  BlockModes modes(std::size_t i) const {
    const std::size_t corners = vertex_begin[i + 1] - vertex_begin[i];
    if (!is_meshed(i)) return modes_of(bending, i, corners);
    const std::size_t node = meshes.begin[i];
    return {
        {bending.modes() + node, meshes.nodes_of(i)}, nullptr, corners, meshes.share.data() + node};
  }
  /// Calls body(first, last) for the ranges of the places of the modes of the blocks [begin, end),
  /// which are whole groups.
  template <class Body>
  void for_mode_places(std::size_t begin, std::size_t end, Body body) const {
    if (bending.any()) body(bending.begin_of_group(begin), bending.begin_of_group(end));
    if (meshes.any())
      body(bending.modes() + meshes.begin[begin], bending.modes() + meshes.begin[end]);
  }
  /// Name of block i, empty where it has none.
  std::string_view name(std::size_t i) const {
    const auto found = names.find(static_cast<Id>(i));
    return found == names.end() ? std::string_view{} : found->second;
  }
  /// The table from which the line of two edges comes that lie along each other; of two tables that
  /// which takes precedence where lines coincide; may be empty.
  std::string_view table_of(Id e, Id f) const {
    const Index one = edge_table[e], other = edge_table[f];
    const Index row = one == none || (other != none && other < one) ? other : one;
    return row == none ? std::string_view{} : tables[static_cast<std::size_t>(row)];
  }
};

}  // namespace edda
