// Linings as pairs of triangles: each piece is a pair, (outer 1, outer 2, inner 2) and (outer 1,
// inner 2, inner 1).
#pragma once

#include <utility>
#include <vector>

#include "cutting/mesh.hpp"
#include "zones/zone_set.hpp"

namespace edda {

/// The corners of a piece, each with its value in `of`, [mesh nodes].
BeamCorners corners_of(const Meshes& meshes, const std::array<std::uint32_t, 2>& pair,
                       const std::vector<Vec2>& of);
/// Where the mesh nodes are at the start, from the centroids of their blocks, [mesh nodes] m.
std::vector<Vec2> drawn_nodes(const Meshes& meshes);

/// Of a section of this lining while it is of this material, of the thickness of the model; the
/// residual one is empty where the strength does not fall.
SectionStrength strength_of(const Model& model, const Lining& lining, const Material& material,
                            bool residual);

/// The triangles 0 and 1, 2 and 3, and so on.
std::vector<std::pair<std::uint32_t, std::uint32_t>> neighbours(const Mesh& mesh);

/// Adds the pieces of block i, a lining, whose pairs are the last of `zones`.
void add_pieces(ZoneModel& zones, const Model& model, const BlockSet& blocks, std::size_t i);

/// Gives the pieces of block i, a lining, the stiffness and strength of its material.
void set_pieces(ZoneModel& zones, const Model& model, const BlockSet& blocks, std::size_t i);

/// Square of the highest frequency of the piece that pair p is, 1/s2.
double highest_square_of_piece(const ZoneModel& zones, const BlockSet& blocks,
                               const std::vector<Vec2>& drawn, std::size_t p);

}  // namespace edda
