#include "zones/zone_set.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "base/parallel.hpp"
#include "blocks/kinematics.hpp"
#include "zones/lining_pieces.hpp"
#include "zones/pairs.hpp"
#include "zones/zone_viscosity.hpp"

namespace edda {
namespace {

constexpr std::size_t cost_of_pairs = 800;  // ns, of a group

/// The mesh of block i by itself.
Mesh mesh_of(const Meshes& m, std::size_t i) {
  Mesh mesh;
  mesh.nodes = arms_of(m, i);
  for (std::uint32_t z = m.zone_begin[i]; z < m.zone_begin[i + 1]; ++z) {
    Triangle t;
    for (std::size_t k = 0; k < corners_of_zone; ++k) t[k] = m.zone[z][k] - m.begin[i];
    mesh.triangles.push_back(t);
  }
  return mesh;
}

/// Square of the highest frequency of a pair by itself, with its lumped masses, 1/s2.
double highest_square(const ZoneModel& model, const Meshes& m, std::size_t p,
                      const ZoneMaterial& rock, double density) {
  using Matrix = Eigen::Matrix<double, 8, 8>;
  using Strains = Eigen::Matrix<double, 3, 8>;
  std::vector<std::uint32_t> nodes;
  const auto place = [&](std::uint32_t j) {
    const auto found = std::find(nodes.begin(), nodes.end(), j);
    const auto at = static_cast<Eigen::Index>(found - nodes.begin());
    if (found == nodes.end()) nodes.push_back(j);
    return 2 * at;
  };
  Eigen::Matrix<double, 8, 1> mass = Eigen::Matrix<double, 8, 1>::Zero();
  std::array<Strains, 2> strains{Strains::Zero(), Strains::Zero()};
  std::array<double, 2> volumes{};
  Eigen::Matrix<double, 1, 8> mean = Eigen::Matrix<double, 1, 8>::Zero();
  for (std::size_t q = 0; q < strains.size(); ++q) {
    const std::uint32_t z = model.pair[p][q];
    if (z == no_partner) continue;
    const ZoneShape& shape = model.shape[z];
    volumes[q] = shape.volume;
    for (std::size_t n = 0; n < corners_of_zone; ++n) {
      const Eigen::Index at = place(m.zone[z][n]);
      const Vec2 g = shape.gradient[n];
      strains[q].col(at) += Eigen::Vector3d(g.x, 0.0, g.y);
      strains[q].col(at + 1) += Eigen::Vector3d(0.0, g.y, g.x);
      for (Eigen::Index c : {at, at + 1}) mass[c] += density * shape.volume / 3.0;
    }
    mean += shape.volume * (strains[q].row(0) + strains[q].row(1));
  }
  mean /= volumes[0] + volumes[1];
  const PlaneStiffness stiffness = plane_stiffness(rock);
  const Eigen::Map<const Eigen::Matrix3d> c(stiffness.front().data());  // symmetric
  Matrix k = Matrix::Zero();
  for (std::size_t q = 0; q < strains.size(); ++q) {
    Strains b = strains[q];
    const Eigen::Matrix<double, 1, 8> more = 0.5 * (mean - strains[q].row(0) - strains[q].row(1));
    b.row(0) += more;
    b.row(1) += more;
    k += volumes[q] * b.transpose() * c * b;
  }
  for (Eigen::Index i = 0; i < 8; ++i) mass[i] = mass[i] > 0.0 ? 1.0 / std::sqrt(mass[i]) : 0.0;
  const Eigen::SelfAdjointEigenSolver<Matrix> solver(mass.asDiagonal() * k * mass.asDiagonal(),
                                                     Eigen::EigenvaluesOnly);
  return solver.eigenvalues()[7];
}

/// Fills ZoneModel::square.
void find_squares(ZoneModel& zones, const Model& model, const BlockSet& b) {
  std::vector<double> of_pair(zones.pair.size());
  const std::vector<Vec2> drawn = drawn_nodes(b.meshes);
  parallel_for(
      of_pair.size(),
      [&](std::size_t p) {
        const std::size_t i = zones.pair_block[p];
        const auto material = static_cast<std::size_t>(b.material[i]);
        if (zones.is_piece(p)) {
          of_pair[p] = highest_square_of_piece(zones, b, drawn, p);
          return;
        }
        of_pair[p] = highest_square(zones, b.meshes, p, zones.material[material],
                                    model.materials[material].density);
      },
      10000);
  zones.square.assign(b.meshes.nodes(), 0.0);
  for (std::size_t p = 0; p < of_pair.size(); ++p) {
    for (const std::uint32_t z : zones.pair[p]) {
      if (z == no_partner) continue;
      for (const std::uint32_t j : b.meshes.zone[z])
        zones.square[j] = std::max(zones.square[j], of_pair[p]);
    }
  }
}

/// The same of block i alone, a lining.
void find_squares_of(ZoneModel& zones, const BlockSet& b, std::size_t i) {
  const std::vector<Vec2> drawn = drawn_nodes(b.meshes);
  std::fill(zones.square.begin() + b.meshes.begin[i], zones.square.begin() + b.meshes.begin[i + 1],
            0.0);
  for (std::uint32_t p = zones.pair_begin[i]; p < zones.pair_begin[i + 1]; ++p) {
    const double square = highest_square_of_piece(zones, b, drawn, p);
    for (const std::uint32_t z : zones.pair[p]) {
      for (const std::uint32_t j : b.meshes.zone[z])
        zones.square[j] = std::max(zones.square[j], square);
    }
  }
}

/// Fills ZoneModel::group; the last pair fills up the last one.
void make_groups(ZoneModel& zones, const BlockSet& b) {
  zones.group.resize((zones.pair.size() + pairs_at_once - 1) / pairs_at_once);
  for (std::size_t g = 0; g < zones.group.size(); ++g) {
    for (std::size_t at = 0; at < pairs_at_once; ++at) {
      const std::size_t p = std::min(g * pairs_at_once + at, zones.pair.size() - 1);
      const auto [one, other] = zones.pair[p];
      const ZoneShape second = other == no_partner ? ZoneShape{} : zones.shape[other];
      const auto material = static_cast<std::size_t>(b.material[zones.pair_block[p]]);
      set_shape(zones.group[g], at, {zones.shape[one], second}, zones.material[material].elastic);
    }
  }
}

/// Where the mesh nodes of the blocks [begin, end) are; of velocities, theirs.
void place_nodes(const BlockSet& b, const BodyVectors& u, std::vector<Vec2>& to, std::size_t begin,
                 std::size_t end) {
  const Meshes& m = b.meshes;
  const std::size_t mode = b.bending.modes();
  for (std::size_t i = begin; i < end; ++i) {
    const AffineMotion affine = affine_motion(b, vectors_of(u, i), i);
    for (std::size_t j = m.begin[i]; j < m.begin[i + 1]; ++j)
      to[j] = affine.of(m.arm_x[j], m.arm_y[j]) + u.modes[mode + j];
  }
}

void place_all_nodes(const BlockSet& b, const State& s, Zones& zones) {
  zones.place.resize(b.meshes.nodes());
  zones.rate.resize(b.meshes.nodes());
  parallel_blocks(b.size(), 40, [&](std::size_t, std::size_t begin, std::size_t end) {
    place_nodes(b, s.position, zones.place, begin, end);
    place_nodes(b, s.velocity, zones.rate, begin, end);
  });
}

/// The work h v . (f - f before) of the new forces on zone z, J, which become those in force.
double replace_force(const BlockSet& b, double h, Zones& all, std::uint32_t z,
                     const std::array<Vec2, corners_of_zone>& force) {
  const std::array<Vec2, corners_of_zone> v = at_corners(b.meshes, all.rate, z);
  double change = 0.0;
  for (std::size_t k = 0; k < corners_of_zone; ++k)
    change += dot(force[k] - all.force[z][k], h * v[k]);
  all.force[z] = force;
  return change;
}

/// The stress of zone z, in which water in its pores acts out of plane, too.
void set_stress(Zones& all, std::uint32_t z, const std::array<double, 4>& stress) {
  all.stress[z] = stress;
  if (!all.pore.empty()) all.stress[z][2] -= all.pore[z] * std::exp(-all.swelling[z]);
}

void replace_stored(Zones& all, std::size_t p, double stored, double change) {
  all.stored_between[p] = 0.5 * (all.stored[p] + stored) + 0.25 * change;
  all.stored[p] = stored;
}

void evaluate_pair(const ZoneModel& model, const BlockSet& b, double h, Zones& all, std::size_t p) {
  const std::size_t i = model.pair_block[p];
  const std::array<std::uint32_t, 2> zone = model.pair[p];
  const std::size_t many = zone[1] == no_partner ? 1 : 2;
  std::array<ZoneShape, 2> shape{};
  std::array<ZoneState, 2> state;
  std::array<std::array<Vec2, 3>, 2> x{};
  for (std::size_t q = 0; q < many; ++q) {
    shape[q] = model.shape[zone[q]];
    state[q] = all.state[zone[q]];
    x[q] = at_corners(b.meshes, all.place, zone[q]);
  }
  const ZoneMaterial& rock = all.material[static_cast<std::size_t>(b.material[i])];
  const std::array<ZoneResult, 2> result = evaluate_zones(shape, rock, x, state);
  double stored = 0.0, change = 0.0;
  for (std::size_t q = 0; q < many; ++q) {
    const std::uint32_t z = zone[q];
    change += replace_force(b, h, all, z, result[q].force);
    all.state[z] = state[q];
    set_stress(all, z, result[q].stress);
    all.yielding[z] = static_cast<std::uint8_t>(result[q].yielding);
    stored += result[q].stored;
    all.dissipated[p] += result[q].dissipated;
  }
  replace_stored(all, p, stored, change);
}

/// Takes over what the pair `at` of a group, which is pair p, is as nothing flows in it.
void take_elastic(const PairResults& r, std::size_t at, const ZoneModel& model, const BlockSet& b,
                  double h, Zones& all, std::size_t p) {
  double change = 0.0;
  for (std::size_t q = 0; q < 2; ++q) {
    const std::uint32_t z = model.pair[p][q];
    if (z == no_partner) break;
    std::array<Vec2, corners_of_zone> force;
    for (std::size_t k = 0; k < corners_of_zone; ++k)
      force[k] = {r.force_x[q][k][at], r.force_y[q][k][at]};
    change += replace_force(b, h, all, z, force);
    std::array<double, 4> stress;
    for (std::size_t c = 0; c < stress.size(); ++c) {
      all.state[z].stress[c] = r.remembered[q][c][at];
      stress[c] = r.stress[q][c][at];
    }
    set_stress(all, z, stress);
    all.yielding[z] = static_cast<std::uint8_t>(Yielding::nowhere);
  }
  replace_stored(all, p, r.stored[at], change);
}

/// The stress of a fibre of a lining, along its chord c.
std::array<double, 4> along_chord(double stress, Vec2 c) {
  const Vec2 t = unit(c);
  return {stress * t.x * t.x, stress * t.y * t.y, 0.0, stress * t.x * t.y};
}

/// The piece of a lining that pair p is. Its zones have the stresses of its outer and inner fibre.
void evaluate_piece(const ZoneModel& model, const BlockSet& b, double h, Zones& all,
                    std::size_t p) {
  const std::uint32_t q = model.piece_of_pair[p];
  const LiningPiece& piece = model.piece[q];
  BeamState& state = all.piece[q];
  const auto [outer, inner] = model.pair[p];
  const BeamCorners x = corners_of(b.meshes, model.pair[p], all.place);
  const BeamResult r = evaluate_beam(piece.shape, model.strength[piece.strength], x, state,
                                     model.residual[piece.strength]);
  const double change = replace_force(b, h, all, outer, {r.force[0], r.force[1], r.force[2]}) +
                        replace_force(b, h, all, inner, {Vec2{}, Vec2{}, r.force[3]});
  const double mean = state.forces.axial / piece.area,
               bent = 0.5 * (state.forces.moment[0] + state.forces.moment[1]) / piece.modulus;
  const Vec2 chord = x[1] + x[2] - x[0] - x[3];
  all.stress[outer] = along_chord(mean + bent, chord);
  all.stress[inner] = along_chord(mean - bent, chord);
  for (const auto& [zone, stress] :
       {std::pair{outer, mean + bent}, std::pair{inner, mean - bent}}) {
    const Yielding as = stress > 0.0 ? Yielding::in_tension : Yielding::in_shear;
    all.yielding[zone] = static_cast<std::uint8_t>(r.yields ? as : Yielding::nowhere);
  }
  all.dissipated[p] += r.dissipated;
  replace_stored(all, p, r.stored, change);
}

bool may_flow(const PairResults& r, std::size_t at, const ZoneModel& model, const BlockSet& b,
              const Zones& all, std::size_t p) {
  const ZoneMaterial& rock =
      all.material[static_cast<std::size_t>(b.material[model.pair_block[p]])];
  if (!(r.within[at] > 0.0)) return true;
  for (std::size_t q = 0; q < 2; ++q) {
    const std::uint32_t z = model.pair[p][q];
    if (z == no_partner) break;
    if (may_flow(r, at, q, rock, model.shape[z].width * all.state[z].plastic_shear)) return true;
  }
  return false;
}

/// The pieces of linings among a group of pairs. Returns whether all of them are.
bool evaluate_pieces(const ZoneModel& model, const BlockSet& b, const State& s, double h,
                     Zones& all, std::size_t first) {
  if (model.piece.empty()) return false;
  bool pieces_alone = true;
  for (std::size_t p = first; p < std::min(first + pairs_at_once, model.pair.size()); ++p) {
    if (!model.is_piece(p)) {
      pieces_alone = false;
    } else if (s.alive[model.pair_block[p]] != 0) {
      evaluate_piece(model, b, h, all, p);
    }
  }
  return pieces_alone;
}

/// The pairs of group g.
void evaluate_group(const ZoneModel& model, const BlockSet& b, const State& s, double h, Zones& all,
                    std::size_t g) {
  const std::size_t first = g * pairs_at_once;
  const auto pair_at = [&](std::size_t at) { return std::min(first + at, model.pair.size() - 1); };
  if (evaluate_pieces(model, b, s, h, all, first)) return;
  PairInputs in;
  for (std::size_t at = 0; at < pairs_at_once; ++at) {
    auto [one, other] = model.pair[pair_at(at)];
    if (other == no_partner) other = one;
    set_inputs(in, at,
               {at_corners(b.meshes, all.place, one), at_corners(b.meshes, all.place, other)},
               {&all.state[one], &all.state[other]});
  }
  PairResults r;
  evaluate_pairs(model.group[g], in, r);
  for (std::size_t at = 0; first + at < model.pair.size() && at < pairs_at_once; ++at) {
    const std::size_t p = first + at;
    if (s.alive[model.pair_block[p]] == 0 || model.is_piece(p)) continue;
    if (may_flow(r, at, model, b, all, p)) {
      evaluate_pair(model, b, h, all, p);
    } else {
      take_elastic(r, at, model, b, h, all, p);
    }
  }
}

/// u of the zone that wet[q] is the first entry of, Pa.
double pore_pressure(const PoreWater& water, const BlockSet& b, const Zones& all, std::size_t q) {
  const std::vector<WetZone>& wet = *water.zones;
  const std::array<Vec2, corners_of_zone> x = at_corners(b.meshes, all.place, wet[q].zone);
  const double y = (x[0].y + x[1].y + x[2].y) / corners_of_zone;
  double sum = 0.0;
  for (std::size_t p = q; p < wet.size() && wet[p].zone == wet[q].zone; ++p) {
    const std::size_t row = wet[p].water;
    sum += water.weight[row] * std::max(0.0, wet[p].level + water.rise[row] - y);
  }
  return sum;
}

/// Calls body(zone, pressure) for the zones with water in their pores, of blocks that are alive.
template <class Body>
void for_wet_zones(const PoreWater& water, const BlockSet& b, const State& s, const Zones& all,
                   Body body) {
  if (!water.any()) return;
  const std::vector<WetZone>& wet = *water.zones;
  constexpr std::size_t cost = 20;  // ns
  parallel_for(
      wet.size(),
      [&](std::size_t q) {
        if (s.alive[wet[q].block] == 0 || (q > 0 && wet[q - 1].zone == wet[q].zone)) return;
        body(wet[q].zone, pore_pressure(water, b, all, q));
      },
      cost);
}

/// The water in the pores at the places of the nodes.
void change_pores(const ZoneModel& model, const BlockSet& b, const State& s, const PoreWater& water,
                  Zones& all) {
  for_wet_zones(water, b, s, all, [&](std::uint32_t z, double pressure) {
    const double more = pressure - all.pore[z], before = all.swelling[z],
                 now = swelling_of(model.shape[z], at_corners(b.meshes, all.place, z));
    all.pore[z] = pressure;
    all.swelling[z] = now;
    all.state[z].locked -= more;
    // Half of it belongs to the next step, as energies are those between two positions.
    const double half = -0.25 * model.shape[z].volume * more * (before + now);
    all.pore_work[z] += all.pore_work_due[z] + half;
    all.pore_work_due[z] = half;
  });
}

/// Stress at the start: xx, yy, zz, xy.
std::array<double, 4> stress_at(const Model& model, const Material& material,
                                const StressField& field, Vec2 at) {
  const Tensor t = field.at(at);
  return {t.xx, t.yy, out_of_plane_stress(model, material, t), t.xy};
}

/// The effective stresses of the model's initial stress, and what pairs lock of them.
void begin_under_stress(const ZoneModel& zones, const Model& model, const BlockSet& b, Zones& all) {
  const StressField field(model, b.origin);
  for (std::size_t i = 0; i < b.size(); ++i) {
    if (b.is_added(i)) continue;
    const Vec2 centre{b.centroid_x[i], b.centroid_y[i]};
    for (std::uint32_t z = b.meshes.zone_begin[i]; z < b.meshes.zone_begin[i + 1]; ++z) {
      const auto material = static_cast<std::size_t>(b.material[i]);
      std::array<double, 4> stress =
          stress_at(model, model.materials[material], field, centre + centre_of_zone(b.meshes, z));
      for (std::size_t c = 0; c < 3 && !all.pore.empty(); ++c) stress[c] += all.pore[z];
      all.state[z] = zone_at_start(zones.material[material], stress);
    }
  }
  for (const auto& [one, other] : zones.pair) {
    if (other == no_partner) continue;
    std::array<ZoneState, 2> both{all.state[one], all.state[other]};
    lock_pressures({zones.shape[one], zones.shape[other]}, both);
    all.state[one] = both[0];
    all.state[other] = both[1];
  }
}

}  // namespace

ZoneModel make_zones(const Model& model, const BlockSet& b) {
  const Meshes& m = b.meshes;
  ZoneModel zones;
  if (!m.any()) return zones;
  for (const Material& material : model.materials)
    zones.material.push_back(zone_material(material));
  zones.pair_begin.push_back(0);
  std::vector<std::uint32_t> count(m.nodes() + 1, 0);
  for (std::size_t i = 0; i < b.size(); ++i) {
    const Mesh mesh = mesh_of(m, i);
    for (const Triangle& t : mesh.triangles)
      zones.shape.push_back(
          zone_shape(mesh.nodes[t[0]], mesh.nodes[t[1]], mesh.nodes[t[2]], b.thickness));
    const std::uint32_t first = m.zone_begin[i];
    for (const auto& [one, other] : b.is_lining(i) ? neighbours(mesh) : pair_triangles(mesh)) {
      zones.pair.push_back({first + one, other == no_partner ? no_partner : first + other});
      zones.pair_block.push_back(static_cast<std::uint32_t>(i));
    }
    if (b.is_lining(i)) add_pieces(zones, model, b, i);
    zones.pair_begin.push_back(static_cast<std::uint32_t>(zones.pair.size()));
  }
  if (!zones.piece.empty()) zones.piece_of_pair.resize(zones.pair.size(), no_piece);
  make_groups(zones, b);
  for (const auto& zone : m.zone) {
    for (const std::uint32_t j : zone) ++count[j + 1];
  }
  for (std::size_t j = 0; j < m.nodes(); ++j) count[j + 1] += count[j];
  zones.around_begin = count;
  zones.around.resize(3 * m.zone.size());
  for (std::uint32_t z = 0; z < m.zone.size(); ++z) {
    for (std::uint32_t k = 0; k < corners_of_zone; ++k)
      zones.around[count[m.zone[z][k]]++] = 3 * z + k;
  }
  find_squares(zones, model, b);
  return zones;
}

std::vector<ZoneMaterial> divided_strength(const ZoneModel& zones, double factor) {
  std::vector<ZoneMaterial> materials;
  for (const ZoneMaterial& rock : zones.material) materials.push_back(divided(rock, factor));
  return materials;
}

Zones zones_at_start(const ZoneModel& zones, const Model& model, const BlockSet& b,
                     const State& state, const PoreWater& water, double factor) {
  Zones all;
  all.material = divided_strength(zones, factor);
  const std::size_t many = zones.shape.size(), pairs = zones.pair.size();
  if (many == 0) return all;
  all.state.resize(many);
  all.force.resize(many);
  all.stress.resize(many);
  all.yielding.resize(many);
  place_all_nodes(b, state, all);
  for (const LiningPiece& piece : zones.piece)
    all.piece.push_back(beam_at_start(corners_of(b.meshes, zones.pair[piece.pair], all.place)));
  for (auto* of : {&all.stored, &all.stored_between, &all.dissipated}) of->assign(pairs, 0.0);
  if (water.any()) {
    for (auto* of : {&all.pore, &all.swelling, &all.pore_work, &all.pore_work_due})
      of->assign(many, 0.0);
  }
  if (model.initial_stress) {
    for_wet_zones(water, b, state, all, [&](std::uint32_t z, double u) { all.pore[z] = u; });
    begin_under_stress(zones, model, b, all);
    for (std::size_t z = 0; z < all.pore.size(); ++z) all.state[z].locked -= all.pore[z];
  }
  evaluate_zones(zones, b, state, {}, 0.0, all);
  all.stored_between = all.stored;
  return all;
}

void change_lining(ZoneModel& zones, const Model& model, const BlockSet& b, std::size_t i) {
  set_pieces(zones, model, b, i);
  find_squares_of(zones, b, i);
}

void begin_lining(const ZoneModel& model, const BlockSet& b, const State& s, std::size_t i,
                  Zones& zones) {
  place_nodes(b, s.position, zones.place, i, i + 1);
  place_nodes(b, s.velocity, zones.rate, i, i + 1);
  for (std::uint32_t p = model.pair_begin[i]; p < model.pair_begin[i + 1]; ++p) {
    zones.piece[model.piece_of_pair[p]] =
        beam_at_start(corners_of(b.meshes, model.pair[p], zones.place));
    for (const std::uint32_t z : model.pair[p]) zones.force[z] = {};
    zones.stored[p] = zones.stored_between[p] = 0.0;
    begin_viscosity(model, p, zones);
  }
}

bool begin_fill(const ZoneModel& model, const BlockSet& b, const State& s, std::size_t i,
                Zones& zones) {
  place_nodes(b, s.position, zones.place, i, i + 1);
  place_nodes(b, s.velocity, zones.rate, i, i + 1);
  for (std::uint32_t p = model.pair_begin[i]; p < model.pair_begin[i + 1]; ++p) {
    std::array<ZoneShape, 2> shape{};
    std::array<std::array<Vec2, corners_of_zone>, 2> x{};
    std::array<ZoneState, 2> state;
    for (std::size_t q = 0; q < 2; ++q) {
      const std::uint32_t z = model.pair[p][q];
      if (z == no_partner) continue;
      shape[q] = model.shape[z];
      x[q] = at_corners(b.meshes, zones.place, z);
      if (!(cross(x[q][1] - x[q][0], x[q][2] - x[q][0]) > 0.0)) return false;
    }
    begin_without_stress(shape, x, state);
    for (std::size_t q = 0; q < 2; ++q) {
      const std::uint32_t z = model.pair[p][q];
      if (z == no_partner) continue;
      zones.state[z] = state[q];
      zones.force[z] = {};
      zones.stress[z] = {};
      zones.yielding[z] = 0;
    }
    zones.stored[p] = zones.stored_between[p] = 0.0;
    begin_viscosity(model, p, zones);
  }
  return true;
}

void evaluate_zones(const ZoneModel& model, const BlockSet& b, const State& s,
                    const PoreWater& water, double h, Zones& zones,
                    const std::vector<double>& viscosity) {
  if (model.pair.empty()) return;
  place_all_nodes(b, s, zones);
  change_pores(model, b, s, water, zones);
  parallel_for(
      model.group.size(), [&](std::size_t g) { evaluate_group(model, b, s, h, zones, g); },
      cost_of_pairs);
  evaluate_viscosity(model, b, s, viscosity, h, zones);
}

void start_zones(const ZoneModel& model, const BlockSet& b, const State& s, double h,
                 Zones& zones) {
  if (model.pair.empty()) return;
  place_all_nodes(b, s, zones);
  for (std::size_t p = 0; p < model.pair.size(); ++p) {
    double power = 0.0;
    for (const std::uint32_t z : model.pair[p]) {
      if (z == no_partner) continue;
      const std::array<Vec2, corners_of_zone> v = at_corners(b.meshes, zones.rate, z);
      for (std::size_t k = 0; k < corners_of_zone; ++k) power += dot(zones.force[z][k], v[k]);
    }
    zones.stored_between[p] = zones.stored[p] + 0.5 * h * power;
    if (!zones.viscous.empty()) zones.damped_due[p] = -0.5 * h * viscous_power(model, b, zones, p);
  }
}

void set_zone_forces(const ZoneModel& model, const BlockSet& b, const Zones& zones, Vec2 gravity,
                     BodyVectors& forces, std::size_t begin, std::size_t end) {
  const Meshes& m = b.meshes;
  for (std::size_t i = begin; m.any() && i < end; ++i) {
    if (!b.is_meshed(i)) continue;
    AffinePart common;
    for (std::uint32_t j = m.begin[i]; j < m.begin[i + 1]; ++j) {
      Vec2 sum;
      for (std::uint32_t q = model.around_begin[j]; q < model.around_begin[j + 1]; ++q) {
        const std::uint32_t corner = model.around[q];
        sum += zones.force[corner / 3][corner % 3];
        if (!zones.viscous.empty()) sum += zones.viscous[corner / 3][corner % 3];
      }
      forces.modes.set(b.bending.modes() + j, sum);
      m.add(common, j, sum);
    }
    // w_kj = 1/3 + G_k . (X_j - C), and forces of zones have no resultant.
    NodeVectors f =
        nodal_forces_of(b, Deformation{common.x.x, common.y.x, common.x.y, common.y.y}, 1.0, i);
    for (Vec2& of_node : f) of_node += (b.mass[i] / nodes_per_block) * gravity;
    store(f, forces, i);
  }
}

double stored_in_zones(const ZoneModel& model, const Zones& zones, std::size_t i) {
  double sum = 0.0;
  for (std::uint32_t p = model.pair_begin[i]; p < model.pair_begin[i + 1]; ++p)
    sum += zones.stored_between[p];
  return sum;
}

double dissipated_in_zones(const Zones& zones) {
  return ordered_sum(zones.dissipated.size(), [&](std::size_t p) { return zones.dissipated[p]; });
}

double work_of_pores(const Zones& zones) {
  return ordered_sum(zones.pore_work.size(), [&](std::size_t z) { return zones.pore_work[z]; });
}

std::array<double, 4> mean_stress(const BlockSet& b, const ZoneModel& model, const Zones& zones,
                                  std::size_t i) {
  std::array<double, 4> sum{};
  double volume = 0.0;
  for (std::uint32_t z = b.meshes.zone_begin[i]; z < b.meshes.zone_begin[i + 1]; ++z) {
    const double v = model.shape[z].volume;
    for (std::size_t c = 0; c < sum.size(); ++c) sum[c] += v * zones.stress[z][c];
    volume += v;
  }
  for (double& component : sum) component /= volume;
  return sum;
}

}  // namespace edda
