// The loops over the eight faces of a chunk (contacts/face_tiles.hpp).
#pragma once

#include <array>

#include "blocks/masses.hpp"
#include "contacts/edge_records.hpp"
#include "contacts/face_tiles.hpp"

namespace edda {

/// Relative geometry of the two edges of each face, cached: what EdgeGeometry follows from beside
/// s2, y2, r1, r2, and z2, which are remembered (FaceMemoryColumns).
template <class C>
struct GeometryColumns {
  C tx, ty, per_base, z1, per_e, per_f, slope_e, slope_f, closure_at_0;
  C length_cosine, length_sine;
};
inline constexpr std::size_t geometry_columns = sizeof(GeometryColumns<double>) / sizeof(double);
/// Where they overlap: what counts of OverlapEnds where the short formulas do not suffice.
template <class C>
struct OverlapColumns {
  C exists, sa, sb, la, lb, per_passing, near_a, near_b, pass_a,
      pass_b;                ///< CornersPassing::by_other
  C reach_a, reach_b;        ///< CornersPassing::by_reach, of pass_a and pass_b
  C reach_by_a, reach_by_b;  ///< PassingReach
};
inline constexpr std::size_t overlap_columns = sizeof(OverlapColumns<double>) / sizeof(double);

/// What the loops over the chunks of a tile read and write: tables of [chunks][columns][8].
struct SweepTables {
  std::size_t first_chunk;               ///< with which those of TileNumbers begin
  const double *edges, *strengths;       ///< EdgeConstants, StrengthConstants: by sets
  const Id *edge_set, *strength_set;     ///< [chunks]
  const double *before, *damped_before;  ///< FaceMemoryColumns, DashpotMemoryColumns
  double *memory, *damped;
  double* work;       ///< FaceWorkColumns
  double* pressures;  ///< PressureColumns; null where they are not kept
  const Id *record_e, *record_f;
  const double* limits;  ///< LimitColumns, of all chunks; null: none are given
  const LaneBits* was;   ///< [chunks]
  double* on;            ///< records of the forces on the edges
  double per_step, noise;
  double bond_strength;  ///< FaceSet::bond_strength
};
/// on: records of the forces, where they are stored. step: s.
SweepTables tables_of(FaceTiles& tiles, std::size_t tile, double* on, double step,
                      const FaceSet& faces);

/// Corners at n - 1, or masses, of faces of which they do not count: what is multiplied by them is
/// 0.
inline constexpr Records no_corners{};

/// A chunk of faces, as its loop reads and writes it. The pointers are those of its own columns.
struct ChunkView {
  const SweepTables* of;
  std::size_t chunk;
  const double *edges, *strengths, *before, *damped_before;
  double *memory, *damped, *work;
  const double* limits;                   ///< LimitColumns, or null
  double *stands, *overlaps, *pressures;  ///< GeometryColumns, OverlapColumns, PressureColumns
  const Records *e, *f;                   ///< the edges
  const Records *e_then = &no_corners, *f_then = &no_corners;
  const Records *mass_e = &no_corners, *mass_f = &no_corners;
};
/// The constants of a chunk alone.
inline ChunkView view_of_constants(const SweepTables& t, std::size_t chunk) {
  ChunkView view{};
  view.of = &t;
  view.chunk = chunk;
  view.edges = t.edges + t.edge_set[chunk] * edge_columns * lanes;
  view.strengths = t.strengths + t.strength_set[chunk] * strength_columns * lanes;
  return view;
}

/// With all that the tile holds of it. pressures: for those of a chunk where they are not kept.
inline ChunkView view_of(const SweepTables& t, std::size_t chunk, double* stands, double* overlaps,
                         double* pressures) {
  const std::size_t n = chunk - t.first_chunk, memory = n * memory_columns * lanes;
  ChunkView view = view_of_constants(t, chunk);
  view.before = t.before + memory;
  view.memory = t.memory + memory;
  view.work = t.work + n * work_columns * lanes;
  if (t.damped != nullptr) {
    view.damped_before = t.damped_before + n * dashpot_memory_columns * lanes;
    view.damped = t.damped + n * dashpot_memory_columns * lanes;
  }
  if (t.limits != nullptr) view.limits = t.limits + chunk * limit_columns * lanes;
  view.stands = stands;
  view.overlaps = overlaps;
  view.pressures = t.pressures != nullptr ? t.pressures + n * pressure_columns * lanes : pressures;
  return view;
}

/// What a loop has found: the bits to be remembered and those of the step (lane_bits), and the
/// largest depth, m.
struct ChunkFound {
  LaneBits bits, found;
  double deepest;
};

/// Reads the records of the edges of a chunk. The columns are to be read some chunks later: store
/// to load forwarding fails where a vector of eight is read that has just been stored as two of
/// four.
void read_edges(const double* from, const Id* slot_e, const Id* slot_f, Records& e, Records& f);
/// Reads EdgeInverseMass of the edges of a chunk, by their numbers. next: BlockSet::next.
void read_masses(const Masses& masses, const Id* next, const Id* edge, const Id* facing, Records& e,
                 Records& f);
/// Computes the relative geometry of the edges from their records (ChunkView::e, f).
void compute_geometry(const ChunkView& chunk);
/// Computes where they overlap, from that geometry.
void overlap_edges(const ChunkView& chunk);

/// The loops below need both. They evaluate a chunk: state, forces, and, where `with_work` is in
/// the name, work and pressures. `bonded`: by all formulas; `plain`: by those of plain faces; else
/// by those of faces without bonds (Formulas). Forces are stored unless the chunk turns out to need
/// another of these loops: it is not plain (lane_bits::rare), or does work (lane_bits::busy).
ChunkFound evaluate_bonded_without_work(const ChunkView& chunk);
ChunkFound evaluate_bonded_with_work(const ChunkView& chunk);
ChunkFound evaluate_without_work(const ChunkView& chunk);
ChunkFound evaluate_with_work(const ChunkView& chunk);
ChunkFound evaluate_plain_without_work(const ChunkView& chunk);
ChunkFound evaluate_plain_with_work(const ChunkView& chunk);
/// The same with dashpots, which always do work.
ChunkFound evaluate_bonded_damped(const ChunkView& chunk);
ChunkFound evaluate_damped(const ChunkView& chunk);
ChunkFound evaluate_plain_damped(const ChunkView& chunk);
/// By all formulas, with work, and with given limits of shear.
ChunkFound evaluate_limited(const ChunkView& chunk);
ChunkFound evaluate_limited_damped(const ChunkView& chunk);

/// Tests faces that have carried nothing for two steps. `decides` of what is found: a face may
/// close or needs a decision, and the chunk must be evaluated.
ChunkFound test_open_faces(const ChunkView& chunk);

/// What a row of results needs of the faces of a chunk: the energy that is stored between n - 1 and
/// n, J, and the normal force at n, N.
struct ChunkMeasures {
  alignas(64) double energy[lanes], normal[lanes];
};
/// The chunk's `was` must hold the bits of n, and its e_then and f_then the edges at n - 1.
void measure_faces(const ChunkView& chunk, ChunkMeasures& to);

/// Margins by which the corners of faces that rest, and that sleep, may stray, m.
using RestMargins = std::array<double, rest_levels>;

/// What can happen to the faces of a chunk that have carried nothing for two steps; bits of lanes.
struct OpenLanes {
  LaneBits near;  ///< a corner touches the other edge
  LaneBits stay;  ///< a field of bits for each margin: nothing changes that counts, no state but
                  ///< that of the corners, and no force
};
/// The chunk's `was` must hold the bits of n - 1, and its e_then and f_then the motion of the ends
/// of the edges in a step, m. `stay` holds for `steps` steps in which they move at that pace and
/// deviate from these paths by the margin at most.
OpenLanes open_lanes(const ChunkView& chunk, const RestMargins& margins, double steps);

}  // namespace edda
