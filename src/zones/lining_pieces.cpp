#include "zones/lining_pieces.hpp"

#include <cmath>

namespace edda {
namespace {

/// Young's modulus in the plane: of shotcrete and concrete that does not strain out of it.
double young_of(const Model& model, const Lining& lining, const Material& material) {
  const bool plane_strain = model.plane == Plane::strain && lining.thickness;
  return plane_strain ? material.young / (1.0 - material.poisson * material.poisson)
                      : material.young;
}

/// A quarter of the mass of piece p.
double corner_mass(const ZoneModel& zones, const BlockSet& b, std::uint32_t p) {
  const std::size_t i = zones.pair_block[p];
  const auto [one, other] = zones.pair[p];
  return 0.25 * b.mass[i] / b.volume[i] * (zones.shape[one].volume + zones.shape[other].volume);
}

}  // namespace

BeamCorners corners_of(const Meshes& m, const std::array<std::uint32_t, 2>& pair,
                       const std::vector<Vec2>& of) {
  const auto& [a, b, c] = m.zone[pair[0]];
  return {of[a], of[b], of[c], of[m.zone[pair[1]][2]]};
}

std::vector<Vec2> drawn_nodes(const Meshes& m) {
  std::vector<Vec2> node(m.nodes());
  for (std::size_t j = 0; j < node.size(); ++j) node[j] = {m.arm_x[j], m.arm_y[j]};
  return node;
}

SectionStrength strength_of(const Model& model, const Lining& lining, const Material& material,
                            bool residual) {
  const bool own = lining.compressive_strength.has_value();
  if ((!own && !material.strength) || (residual && !lining.residual)) return {};
  double compressive = own ? *lining.compressive_strength : material.strength->ucs,
         tensile = own ? lining.tensile_strength.value_or(lining.area ? compressive : 0.0)
                       : material.strength->tension;
  const double t = lining.drawn_thickness(), area = model.thickness * t * lining.solidity(),
               both = compressive + tensile;
  // The rectangle with that plastic moment under the thrust at which it is largest.
  const double thick = lining.plastic_moment ? 8.0 * *lining.plastic_moment * model.thickness /
                                                   lining.spacing / (both * area)
                                             : t;
  if (residual) {  // of young concrete no more than it has
    compressive =
        std::min(compressive, lining.residual->compressive_strength.value_or(compressive));
    tensile = std::min(tensile, lining.residual->tensile_strength.value_or(tensile));
  }
  return rectangle_strength(compressive, tensile, area, thick);
}

std::vector<std::pair<std::uint32_t, std::uint32_t>> neighbours(const Mesh& mesh) {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs;
  for (std::uint32_t z = 0; z < mesh.triangles.size(); z += 2) pairs.emplace_back(z, z + 1);
  return pairs;
}

void set_pieces(ZoneModel& zones, const Model& model, const BlockSet& b, std::size_t i) {
  const Lining& lining = model.linings[static_cast<std::size_t>(b.lining[i])];
  const Material& material = model.materials[static_cast<std::size_t>(b.material[i])];
  const double t = lining.drawn_thickness(), sets = b.thickness / lining.spacing;
  BeamSection section;
  section.young = young_of(model, lining, material);
  section.shear_modulus = material.young / (2.0 * (1.0 + material.poisson));
  section.area = lining.area ? sets * *lining.area : b.thickness * t;
  section.inertia = lining.inertia ? sets * *lining.inertia : b.thickness * t * t * t / 12.0;
  const std::vector<Vec2> drawn = drawn_nodes(b.meshes);
  const std::size_t pieces = b.meshes.zone_begin[i + 1] - b.meshes.zone_begin[i];
  for (std::size_t k = 0; 2 * k < pieces; ++k) {
    const auto p = static_cast<std::uint32_t>(zones.pair_begin[i] + k);
    LiningPiece& piece = zones.piece[zones.piece_of_pair[p]];
    const BeamCorners x = corners_of(b.meshes, zones.pair[p], drawn);
    piece.shape = beam_shape(section, x, corner_mass(zones, b, p));
    piece.area = section.area;
    piece.modulus = 2.0 * section.inertia / t;
    zones.strength[piece.strength] = strength_of(model, lining, material, false);
    zones.residual[piece.strength] = strength_of(model, lining, material, true);
  }
}

void add_pieces(ZoneModel& zones, const Model& model, const BlockSet& b, std::size_t i) {
  zones.piece_of_pair.resize(zones.pair.size(), no_piece);
  const auto strength = static_cast<std::uint32_t>(zones.strength.size());
  zones.strength.emplace_back();
  zones.residual.emplace_back();
  for (std::uint32_t p = zones.pair_begin[i]; p < zones.pair.size(); ++p) {
    zones.piece_of_pair[p] = static_cast<std::uint32_t>(zones.piece.size());
    LiningPiece piece;
    piece.strength = strength;
    piece.pair = p;
    zones.piece.push_back(piece);
  }
  set_pieces(zones, model, b, i);
}

double highest_square_of_piece(const ZoneModel& zones, const BlockSet& b,
                               const std::vector<Vec2>& drawn, std::size_t p) {
  const auto at = static_cast<std::uint32_t>(p);
  return highest_square(zones.piece[zones.piece_of_pair[p]].shape,
                        corners_of(b.meshes, zones.pair[p], drawn), corner_mass(zones, b, at));
}

BeamCorners corners_of_piece(const BlockSet& b, const ZoneModel& model, const State& s,
                             std::size_t p) {
  const auto& [one, other] = model.pair[p];
  const auto at = [&](std::uint32_t j) {
    return mesh_node_at(b, s.position, model.pair_block[p], j);
  };
  const auto& [a, c, d] = b.meshes.zone[one];
  return {at(a), at(c), at(d), at(b.meshes.zone[other][2])};
}

void carry_on(const ZoneModel& old, const ZoneModel& zones, const BlockSet& b, const State& s,
              std::size_t i, Zones& all) {
  for (std::uint32_t p = zones.pair_begin[i]; p < zones.pair_begin[i + 1]; ++p) {
    const std::uint32_t q = zones.piece_of_pair[p];
    const double more = change_shape(old.piece[q].shape, zones.piece[q].shape,
                                     corners_of_piece(b, zones, s, p), all.piece[q]);
    all.stored[p] += more;
    all.stored_between[p] += more;
  }
}

}  // namespace edda
