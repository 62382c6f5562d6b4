// The zones of all meshed blocks: their rock, what they remember, and their forces on mesh nodes.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "blocks/initial_stress.hpp"
#include "blocks/state.hpp"
#include "zones/beam.hpp"
#include "zones/pair_lanes.hpp"
#include "zones/zone.hpp"

namespace edda {

inline constexpr std::uint32_t no_piece = 0xffffffffu;

/// A piece of a lining, between two sections.
struct LiningPiece {
  BeamShape shape;
  std::uint32_t strength = 0;        ///< of ZoneModel::strength
  double area = 0.0, modulus = 0.0;  ///< m2 and m3, A and 2 I/t of its section
  std::uint32_t pair = 0;            ///< of zones
};

/// What does not change during a run. Zones and mesh nodes are those of BlockSet::meshes.
struct ZoneModel {
  std::vector<ZoneShape> shape;                    ///< [zones]
  std::vector<std::array<std::uint32_t, 2>> pair;  ///< [pairs] zones; second: no_partner
  std::vector<std::uint32_t> pair_begin;           ///< [nb + 1] first pair of each block
  std::vector<std::uint32_t> pair_block;           ///< [pairs]
  std::vector<PairShapes> group;                   ///< of pairs_at_once pairs each
  std::vector<ZoneMaterial> material;              ///< [materials of the model]
  std::vector<std::uint32_t> around_begin;         ///< [mesh nodes + 1]
  std::vector<double> square;  ///< [mesh nodes] largest of the squares of the highest frequencies
                               ///< that pairs around it have by themselves, 1/s2
  std::vector<std::uint32_t> around;  ///< corners of zones at each node: 3 zone + k
  // Linings: each piece is the pair of triangles that it consists of.
  std::vector<std::uint32_t> piece_of_pair;  ///< [pairs] or no_piece; empty: no linings
  std::vector<LiningPiece> piece;
  std::vector<SectionStrength> strength, residual;  ///< [blocks that are linings]; residual: empty
                                                    ///< where the strength does not fall
  bool is_piece(std::size_t p) const {
    return !piece_of_pair.empty() && piece_of_pair[p] != no_piece;
  }
};
ZoneModel make_zones(const Model& model, const BlockSet& blocks);

/// The materials with their strength divided by a factor (divided()).
std::vector<ZoneMaterial> divided_strength(const ZoneModel& zones, double factor);

/// What changes. All but `material` and `state` is of the last evaluation.
struct Zones {
  std::vector<ZoneMaterial> material;         ///< [materials of the model] with the strength in
                                              ///< force
  std::vector<ZoneState> state;               ///< [zones]
  std::vector<std::array<Vec2, 3>> force;     ///< [zones] on its nodes, N
  std::vector<std::array<double, 4>> stress;  ///< [zones] Cauchy, xx, yy, zz, xy, Pa
  std::vector<std::uint8_t> yielding;         ///< [zones] Yielding
  std::vector<BeamState> piece;               ///< [pieces of linings]
  std::vector<double> stored;                 ///< [pairs] J, at the positions
  std::vector<double> stored_between;         ///< [pairs] J, in the terms of the energy balance:
                                              ///< between the positions before and these
  std::vector<double> dissipated;             ///< [pairs] J, by plastic strain so far
  // Of the viscosity of the rock (Masses::viscosity); empty where none had any so far.
  std::vector<std::array<Vec2, 3>> viscous;  ///< [zones] force on its nodes, N
  std::vector<double> damped, damped_due;    ///< [pairs] J, dissipated by it so far, in the terms
                                             ///< of the energy balance, and what comes with the
                                             ///< next step
  // Of the water in pores; empty without any.
  std::vector<double> pore;           ///< [zones] u, Pa, part of ZoneState::locked
  std::vector<double> swelling;       ///< [zones] ln det F
  std::vector<double> pore_work;      ///< [zones] J, of the water so far, in the terms of the
                                      ///< energy balance
  std::vector<double> pore_work_due;  ///< [zones] J, which comes with the next step
  std::vector<Vec2> place, rate;      ///< [mesh nodes] m and m/s
};

/// Still water in pores at one time: on top of its effective stress a zone has the pressure
///   u = sum gamma (level + rise - y)  where that is positive, y of its centroid,
/// as a locked pressure -u that acts on ln det F (zone.hpp), so that it strains nothing by itself.
/// As u changes by du the water does the work -V du ln det F.
struct PoreWater {
  const std::vector<WetZone>* zones = nullptr;  ///< null, or by zone
  std::vector<double> rise, weight;             ///< [rows of Model::waters] m, N/m3
  bool any() const { return zones != nullptr && !zones->empty(); }
};

/// Undeformed and at rest, under the initial stress of the model, if it has one, which includes the
/// pore pressure (without one the water comes in the first step); strength divided by `factor`.
Zones zones_at_start(const ZoneModel& zones, const Model& model, const BlockSet& blocks,
                     const State& state, const PoreWater& water, double factor);

/// Gives block i, a lining, the stiffness and strength of its material.
void change_lining(ZoneModel& zones, const Model& model, const BlockSet& blocks, std::size_t i);
/// Lets its pieces, which were those of `old`, carry what they carry.
void carry_on(const ZoneModel& old, const ZoneModel& zones, const BlockSet& blocks,
              const State& state, std::size_t i, Zones& all);

/// Begins the pieces of block i, a lining, without stress where they are.
void begin_lining(const ZoneModel& model, const BlockSet& blocks, const State& state, std::size_t i,
                  Zones& zones);

/// Begins the zones of block i, of fill, without stress where they are. False: one of them is
/// turned over there.
bool begin_fill(const ZoneModel& model, const BlockSet& blocks, const State& state, std::size_t i,
                Zones& zones);

/// Where the corners of the piece that pair p is are, m.
BeamCorners corners_of_piece(const BlockSet& blocks, const ZoneModel& model, const State& state,
                             std::size_t p);

/// Evaluates the zones of the blocks that are alive at the positions x_{n+1} of a state, to which
/// they have moved by h v from those of the last evaluation. With forces f = -grad W a leapfrog
/// keeps, between x_n and x_{n+1}, what linear springs store by x_n K x_{n+1}/2,
///   (W_n + W_{n+1})/2 + (f_{n+1} - f_n) . h v/4.
/// Viscous forces are those of the velocities v: they belong to the next step. viscosity: [nb] eta,
/// s; empty: none.
void evaluate_zones(const ZoneModel& model, const BlockSet& blocks, const State& state,
                    const PoreWater& water, double h, Zones& zones,
                    const std::vector<double>& viscosity = {});

/// The same terms at the start, where velocities are those half a step h (s) before: W + f . h v/2.
void start_zones(const ZoneModel& model, const BlockSet& blocks, const State& state, double h,
                 Zones& zones);

/// Sets the forces on the meshed blocks of [begin, end) to those of their zones and their weight;
/// gravity in m/s2.
void set_zone_forces(const ZoneModel& model, const BlockSet& blocks, const Zones& zones,
                     Vec2 gravity, BodyVectors& forces, std::size_t begin, std::size_t end);

/// What the zones of block i store in the terms of the energy balance, what all zones have
/// dissipated so far by yield and by viscosity, and the work of the water in their pores, J.
double stored_in_zones(const ZoneModel& model, const Zones& zones, std::size_t i);
double dissipated_in_zones(const Zones& zones);
double damped_in_zones(const Zones& zones);
double work_of_pores(const Zones& zones);

/// Mean Cauchy stress of the zones of block i by area: xx, yy, zz, xy, Pa.
std::array<double, 4> mean_stress(const BlockSet& blocks, const ZoneModel& model,
                                  const Zones& zones, std::size_t i);

}  // namespace edda
