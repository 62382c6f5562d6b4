// What the loops over the faces of a chunk (contacts/chunk_loops.hpp) read, by its columns.
#pragma once

#include "contacts/chunk_loops.hpp"
#include "contacts/face_frame.hpp"
#include "contacts/tile_columns.hpp"

namespace edda {

/// The bit of each lane; loops over lanes have no shifts by the lane.
alignas(64) inline constexpr LaneBits bit_of_lane[lanes] = {1, 2, 4, 8, 16, 32, 64, 128};

EDDA_INLINE FacePoints points_of(const Records& e, const Records& f, std::size_t k) {
  return {{e.column[0][k], e.column[1][k]},
          {e.column[2][k], e.column[3][k]},
          {f.column[0][k], f.column[1][k]},
          {f.column[2][k], f.column[3][k]}};
}

/// A chunk by its columns.
struct ChunkColumns : EdgeConstants<const double*>, StrengthConstants<const double*> {
  FaceMemoryColumns<const double*> before;
  FaceMemoryColumns<double*> memory;
  DashpotMemoryColumns<const double*> damped_before;
  DashpotMemoryColumns<double*> damped;
  FaceWorkColumns<double*> work;
  GeometryColumns<double*> stands;
  OverlapColumns<double*> overlaps;
  PressureColumns<double*> pressures;
  LimitColumns<const double*> limits;
  const Records *e, *f, *e_then, *f_then, *mass_e, *mass_f;
  LaneBits was;
  double per_step, noise, bond_strength;
};
/// What a loop reads and writes beside the constants and the edges.
enum class Tables { constants_alone, memory, memory_and_dashpots };

/// A table that a loop does not use may be missing.
template <Tables tables>
EDDA_INLINE ChunkColumns columns_of(const ChunkView& v) {
  ChunkColumns c{columns_from<EdgeConstants<const double*>>(v.edges),
                 columns_from<StrengthConstants<const double*>>(v.strengths),
                 {},
                 {},
                 {},
                 {},
                 {},
                 {},
                 {},
                 {},
                 {},
                 v.e,
                 v.f,
                 v.e_then,
                 v.f_then,
                 v.mass_e,
                 v.mass_f,
                 v.of->was[v.chunk],
                 v.of->per_step,
                 v.of->noise,
                 v.of->bond_strength};
  if constexpr (tables != Tables::constants_alone) {
    c.before = columns_from<FaceMemoryColumns<const double*>>(v.before);
    c.memory = columns_from<FaceMemoryColumns<double*>>(v.memory);
    c.work = columns_from<FaceWorkColumns<double*>>(v.work);
    c.stands = columns_from<GeometryColumns<double*>>(v.stands);
    c.overlaps = columns_from<OverlapColumns<double*>>(v.overlaps);
    c.pressures = columns_from<PressureColumns<double*>>(v.pressures);
  }
  if constexpr (tables == Tables::memory_and_dashpots) {
    c.damped_before = columns_from<DashpotMemoryColumns<const double*>>(v.damped_before);
    c.damped = columns_from<DashpotMemoryColumns<double*>>(v.damped);
  }
  return c;
}
template <bool dashpots>
EDDA_INLINE ChunkColumns columns_of(const ChunkView& v) {
  return columns_of < dashpots ? Tables::memory_and_dashpots : Tables::memory > (v);
}

EDDA_INLINE FacePair pair_of(const ChunkColumns& c, std::size_t k) {
  FacePair p;
  p.stiffness = c.stiffness[k];
  p.ends = c.ends[k];
  p.carries_tension = c.carries_tension[k];
  p.inverse_e = c.inverse_e[k];
  p.inverse_f = c.inverse_f[k];
  p.length_ratio = c.length_ratio[k];
  p.gate_from = c.gate_from[k];
  p.gate_scale = c.gate_scale[k];
  p.passing = c.passing[k];
  p.offset = {c.locked_closure_a[k], c.locked_closure_b[k]};
  p.turn_p1 = {c.cosine_p1[k], c.sine_p1[k]};
  p.turn_p2 = {c.cosine_p2[k], c.sine_p2[k]};
  p.turn_q1 = {c.cosine_q1[k], c.sine_q1[k]};
  p.turn_q2 = {c.cosine_q2[k], c.sine_q2[k]};
  return p;
}

}  // namespace edda
