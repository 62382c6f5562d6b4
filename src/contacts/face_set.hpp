// Faces: the contacts of the model, and their memory. [nf] rows each: first those that
// carried when the list was made, then those that were near, then the others. Elements and
// notation: contacts/face.hpp; docs/contacts.md.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "base/columns.hpp"
#include "blocks/block_set.hpp"
#include "contacts/face.hpp"

namespace edda {

/// What a face is at a step. All of it follows from the positions, but for the slip.
template <class C>
struct FaceFields {
  C closure_a, closure_b;      ///< d at the ends, m
  C energy;                    ///< U of the normal pressure, J
  C normal_a, normal_b;        ///< normal force at the ends, N
  C shear_a, shear_b;          ///< T at the ends, N
  C slip_a, slip_b;            ///< elastic slip u, m: T = -spring u
  C trial_a, trial_b;          ///< the same before Coulomb's limit, m
  C spring;                    ///< shear spring of each end, N/m
  C length;                    ///< L, m; 0: no overlap
  C overlap;                   ///< length that the shear springs stand for, m
  C cohesive;                  ///< length along which cohesion acts, m
  C gate;                      ///< w W
  C xi_a, xi_b, eta_a, eta_b;  ///< where the ends are on the edges
  C switched;                  ///< 1: other ends are closed than at the step before
  C friction_work;             ///< taken by friction in the step before, J
  C transfer;              ///< taken in it by what is no physics: overlaps and ends that move on, J
  C damping_a, damping_b;  ///< of the dashpots across the face, N
  C drag_a, drag_b;        ///< of those along it, N
  C damping_work;          ///< by dashpots at n in the step behind
  C damping_due;           ///< by those at n - 1 in it: they have done with the blocks
};

/// Its columns, once: name, unit, and where they are.
template <class C>
struct FaceField {
  const char* name;
  const char* unit;
  C FaceFields<C>::*values;
};
template <class C>
inline constexpr FaceField<C> face_fields[] = {
    {"closure_a", "m", &FaceFields<C>::closure_a},
    {"closure_b", "m", &FaceFields<C>::closure_b},
    {"energy", "J", &FaceFields<C>::energy},
    {"normal_a", "N", &FaceFields<C>::normal_a},
    {"normal_b", "N", &FaceFields<C>::normal_b},
    {"shear_a", "N", &FaceFields<C>::shear_a},
    {"shear_b", "N", &FaceFields<C>::shear_b},
    {"slip_a", "m", &FaceFields<C>::slip_a},
    {"slip_b", "m", &FaceFields<C>::slip_b},
    {"trial_a", "m", &FaceFields<C>::trial_a},
    {"trial_b", "m", &FaceFields<C>::trial_b},
    {"spring", "N/m", &FaceFields<C>::spring},
    {"length", "m", &FaceFields<C>::length},
    {"overlap", "m", &FaceFields<C>::overlap},
    {"cohesive", "m", &FaceFields<C>::cohesive},
    {"gate", "1", &FaceFields<C>::gate},
    {"xi_a", "1", &FaceFields<C>::xi_a},
    {"xi_b", "1", &FaceFields<C>::xi_b},
    {"eta_a", "1", &FaceFields<C>::eta_a},
    {"eta_b", "1", &FaceFields<C>::eta_b},
    {"switched", "1", &FaceFields<C>::switched},
    {"friction_work", "J", &FaceFields<C>::friction_work},
    {"transfer", "J", &FaceFields<C>::transfer},
    {"damping_a", "N", &FaceFields<C>::damping_a},
    {"damping_b", "N", &FaceFields<C>::damping_b},
    {"drag_a", "N", &FaceFields<C>::drag_a},
    {"drag_b", "N", &FaceFields<C>::drag_b},
    {"damping_work", "J", &FaceFields<C>::damping_work},
    {"damping_due", "J", &FaceFields<C>::damping_due}};
inline constexpr auto& face_columns = face_fields<ChunkColumn>;

struct FaceMemory : ChunkTable<FaceFields<ChunkColumn>, face_fields<ChunkColumn>> {
  std::vector<std::uint8_t> idle;  ///< [chunks] 1: none in it carries, or did at the step before
};

/// What a face is made of, its strength in force, and what has become of it. First what a step
/// reads.
template <class C>
struct FaceProperties {
  C stiffness, shear_stiffness;  ///< k, ks times thickness, N/m per m of overlap
  C inverse_e, inverse_f, gate_from, gate_scale, passing;  ///< as in FacePair
  C at_ends;  ///< 1: the stiffness is a penalty: the integral is taken at the ends

  // What holds for a face until it dies, decided while it stores nothing.
  C acts;   ///< 1: the blocks meet there; 0: their far sides do
  C leans;  ///< 1: beside the corner that leans there is no third block

  C friction;            ///< tan(phi)
  C cohesion;            ///< c times thickness, N per m of overlap
  C offset_a, offset_b;  ///< o, closure at the ends of the surfaces as drawn, m
  C pulls;               ///< 1: bears tension
  C bonded;              ///< 1: has its peak strength: its shear is not cut
  C zeta, shear_zeta;    ///< dashpots, as fractions of critical: set_face_dashpots()

  C tension;  ///< tensile strength times thickness, N per m; of those that pull
  C glued;    ///< 1: never opens or slides
  C slid;     ///< m: slip so far; infinite: has its residual strength; of laws that change with it
  C owed;     ///< m that the joint has still to open by its dilation
  C lent;     ///< what a glued face had before, 1 + bonded + 2 pulls; else 0
  C breaks;   ///< 1: torn in the step in hand, 2: its bond breaks: what goes is fracture energy
  C opened;   ///< 1: has opened after having been closed
  C slipped;  ///< 1: has slid at least once
  C friction_work, damping_work, fracture_work, transfer;  ///< so far, J
};

/// Its columns, once. kept: over a search and in a checkpoint; the others are made anew.
template <class C>
struct FaceProperty {
  const char* name;
  const char* unit;
  C FaceProperties<C>::*values;
  bool kept;
};
template <class C>
inline constexpr FaceProperty<C> face_property_list[] = {
    {"stiffness", "N/m2", &FaceProperties<C>::stiffness, false},
    {"shear_stiffness", "N/m2", &FaceProperties<C>::shear_stiffness, false},
    {"inverse_e", "1/m", &FaceProperties<C>::inverse_e, false},
    {"inverse_f", "1/m", &FaceProperties<C>::inverse_f, false},
    {"gate_from", "1", &FaceProperties<C>::gate_from, false},
    {"gate_scale", "1", &FaceProperties<C>::gate_scale, false},
    {"passing", "m", &FaceProperties<C>::passing, false},
    {"at_ends", "1", &FaceProperties<C>::at_ends, false},
    {"acts", "1", &FaceProperties<C>::acts, true},
    {"leans", "1", &FaceProperties<C>::leans, true},
    {"friction", "1", &FaceProperties<C>::friction, true},
    {"cohesion", "N/m", &FaceProperties<C>::cohesion, true},
    {"offset_a", "m", &FaceProperties<C>::offset_a, true},
    {"offset_b", "m", &FaceProperties<C>::offset_b, true},
    {"pulls", "1", &FaceProperties<C>::pulls, true},
    {"bonded", "1", &FaceProperties<C>::bonded, true},
    {"zeta", "1", &FaceProperties<C>::zeta, false},
    {"shear_zeta", "1", &FaceProperties<C>::shear_zeta, false},
    {"tension", "N/m", &FaceProperties<C>::tension, true},
    {"glued", "1", &FaceProperties<C>::glued, true},
    {"slid", "m", &FaceProperties<C>::slid, true},
    {"owed", "m", &FaceProperties<C>::owed, true},
    {"lent", "1", &FaceProperties<C>::lent, true},
    {"breaks", "1", &FaceProperties<C>::breaks, true},
    {"opened", "1", &FaceProperties<C>::opened, true},
    {"slipped", "1", &FaceProperties<C>::slipped, true},
    {"friction_work", "J", &FaceProperties<C>::friction_work, true},
    {"damping_work", "J", &FaceProperties<C>::damping_work, true},
    {"fracture_work", "J", &FaceProperties<C>::fracture_work, true},
    {"transfer", "J", &FaceProperties<C>::transfer, true}};
inline constexpr auto& face_properties = face_property_list<ChunkColumn>;

/// FaceSet::breaks of a bond.
inline constexpr double bond_breaks = 2.0;

struct FaceSet : ChunkTable<FaceProperties<ChunkColumn>, face_property_list<ChunkColumn>> {
  std::size_t size() const { return edge.size(); }

  // Identity. Filled by find_faces(); fixed between two searches.
  std::vector<Id> edge, facing;          ///< e < f, of two blocks
  std::vector<Id> edge_end, facing_end;  ///< their second corners
  std::vector<Id> corners;               ///< the four of them, [chunk][4][16]
  std::vector<std::uint16_t> law;        ///< row of the LawTable

  bool dashpots = false;  ///< some face has them, or had them in the step in hand

  FaceMemory now;     ///< at step n
  FaceMemory before;  ///< at n - 1; while n + 1 is tried: at n

  /// Forces on the corners at n, N, of face k from 8 k on: x and y at start and end of `edge`, at
  /// start and end of `facing`. For whole chunks.
  std::vector<double> force;

  /// The faces of each edge: [nv + 1], and [2 nf] where in `force` its four numbers begin. By the
  /// edges that face it, so that sums do not depend on the order of the faces.
  std::vector<Id> begin_of_edge, on_edge;

  static constexpr std::size_t chunk = chunk_rows;
  static constexpr std::size_t run = 32 * chunk;  ///< what a thread takes at once
  std::size_t chunks() const { return (size() + chunk - 1) / chunk; }
  std::size_t force_size() const { return 8 * chunk * chunks(); }
  std::vector<std::uint8_t> stirs;  ///< [chunks] 1: ends of a face in it open or close
  std::vector<double> deepest;      ///< [chunks] largest closure of a face that carries, m
  std::vector<std::uint8_t> bonds;  ///< [chunks] 1: a face in it is bonded or pulls
  std::vector<std::uint8_t> plain;  ///< [chunks] 1: its faces were plain (is_plain()), or may be
  std::vector<std::uint8_t> tears;  ///< [chunks] 1: one of them `breaks`

  /// Of a face that is torn in the step in hand.
  void tear(std::size_t k, double how) {
    breaks[k] = how;
    tears[k / chunk] = 1;
  }

  std::vector<double> locked_start, locked_end;  ///< [nv] of an edge, at its two corners: pressure
                                                 ///< of the initial stress, N per m; empty: none

  // When the list was made, and how long it lives.
  std::vector<double> built_x, built_y;  ///< [nv] vertices then, m
  double noise = 0.0;                    ///< m: closures this small are rounding of the coordinates
  double reach = 0.0;                    ///< m: edges nearer than this are in the list
  double travel = 0.0;                   ///< m: bound of what any vertex has moved since
  std::uint64_t rebuilds = 0;
  double retired_friction = 0.0, retired_damping = 0.0, retired_fracture = 0.0,
         retired_transfer = 0.0;  ///< J, of faces let go

  bool gluing = false;       ///< a stage glues its joints: what comes to touch, too
  std::uint64_t broken = 0;  ///< bonded faces that have gone to their residual law so far

  /// Calls visit(k, of_edge) for the faces of the edges [first, end), in the order of the edges
  /// that face them: of_edge where it is `edge`.
  template <class Visit>
  void for_faces(Id first, Id end, Visit visit) const {
    for (Id q = begin_of_edge[first]; q < begin_of_edge[end]; ++q) {
      visit(on_edge[q] / 8, on_edge[q] % 8 == 0);
    }
  }
};

/// The pair of face k, as it is now.
template <class Faces>
EDDA_INLINE FacePair face_pair(const Faces& c, const double* turn_cosine, const double* turn_sine,
                               std::size_t k) {
  FacePair p;
  p.stiffness = c.stiffness[k] * c.acts[k];
  p.offset = {c.offset_a[k], c.offset_b[k]};
  p.ends = c.at_ends[k] * c.leans[k];
  p.pulls = c.pulls[k];
  p.inverse_e = c.inverse_e[k];
  p.inverse_f = c.inverse_f[k];
  p.gate_from = c.gate_from[k];
  p.gate_scale = c.gate_scale[k];
  p.passing = c.passing[k];
  p.p1 = c.edge[k];
  p.p2 = c.edge_end[k];
  p.q1 = c.facing[k];
  p.q2 = c.facing_end[k];
  p.turn_cosine = turn_cosine;
  p.turn_sine = turn_sine;
  return p;
}

/// Size of the smaller of the two blocks: the square root of its area, m.
inline double smaller_size(const FaceSet& c, const BlockSet& b, std::size_t k) {
  return std::sqrt(
      std::min(b.area[b.vertex_block[c.edge[k]]], b.area[b.vertex_block[c.facing[k]]]));
}

template <class Faces, class Values>
EDDA_INLINE FacePoints face_points(const Faces& c, const Values& x, const Values& y,
                                   std::size_t k) {
  const Id p1 = c.edge[k], p2 = c.edge_end[k], q1 = c.facing[k], q2 = c.facing_end[k];
  return {{x[p1], y[p1]}, {x[p2], y[p2]}, {x[q1], y[q1]}, {x[q2], y[q2]}};
}

}  // namespace edda
