// Faces: the contacts of the model, and their memory. Structure of arrays, [nf] each: first those
// that carried when the list was made, then the others. Elements and notation: contacts/face.hpp;
// docs/contacts.md.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "blocks/block_set.hpp"
#include "contacts/face.hpp"

namespace edda {

/// What a face is at a step. All of it follows from the positions, but for the slip.
struct FaceMemory {
  std::vector<double> closure_a, closure_b;      ///< d at the ends, m
  std::vector<double> energy;                    ///< U of the normal pressure, J
  std::vector<double> normal_a, normal_b;        ///< normal force at the ends, N
  std::vector<double> shear_a, shear_b;          ///< T at the ends, N
  std::vector<double> damping_a, damping_b;      ///< of the dashpots across the face, N
  std::vector<double> drag_a, drag_b;            ///< of those along it, N
  std::vector<double> slip_a, slip_b;            ///< elastic slip u, m: T = -spring u
  std::vector<double> trial_a, trial_b;          ///< the same before Coulomb's limit, m
  std::vector<double> spring;                    ///< shear spring of each end, N/m
  std::vector<double> length;                    ///< L, m; 0: no overlap
  std::vector<double> overlap;                   ///< length that the shear springs stand for, m
  std::vector<double> cohesive;                  ///< length along which cohesion acts, m
  std::vector<double> gate;                      ///< w W
  std::vector<double> xi_a, xi_b, eta_a, eta_b;  ///< where the ends are on the edges
  std::vector<double> switched;       ///< 1: other ends are closed than at the step before
  std::vector<double> friction_work;  ///< taken by friction in the step before, J
  std::vector<double> damping_work;   ///< by dashpots at n in the step behind
  std::vector<double> damping_due;    ///< by those at n - 1 in it: they have done with the blocks
  std::vector<double>
      transfer;  ///< taken in it by what is no physics: overlaps and ends that move on, J

  std::vector<std::uint8_t> idle;  ///< [chunks] 1: none in it carries, or did at the step before
};

/// The arrays of FaceMemory, once: name, unit, and where they are.
struct FaceColumn {
  const char* name;
  const char* unit;
  std::vector<double> FaceMemory::*values;
};
inline constexpr FaceColumn face_columns[] = {{"closure_a", "m", &FaceMemory::closure_a},
                                              {"closure_b", "m", &FaceMemory::closure_b},
                                              {"energy", "J", &FaceMemory::energy},
                                              {"normal_a", "N", &FaceMemory::normal_a},
                                              {"normal_b", "N", &FaceMemory::normal_b},
                                              {"shear_a", "N", &FaceMemory::shear_a},
                                              {"shear_b", "N", &FaceMemory::shear_b},
                                              {"slip_a", "m", &FaceMemory::slip_a},
                                              {"slip_b", "m", &FaceMemory::slip_b},
                                              {"trial_a", "m", &FaceMemory::trial_a},
                                              {"trial_b", "m", &FaceMemory::trial_b},
                                              {"spring", "N/m", &FaceMemory::spring},
                                              {"length", "m", &FaceMemory::length},
                                              {"overlap", "m", &FaceMemory::overlap},
                                              {"cohesive", "m", &FaceMemory::cohesive},
                                              {"gate", "1", &FaceMemory::gate},
                                              {"xi_a", "1", &FaceMemory::xi_a},
                                              {"xi_b", "1", &FaceMemory::xi_b},
                                              {"eta_a", "1", &FaceMemory::eta_a},
                                              {"eta_b", "1", &FaceMemory::eta_b},
                                              {"damping_a", "N", &FaceMemory::damping_a},
                                              {"damping_b", "N", &FaceMemory::damping_b},
                                              {"drag_a", "N", &FaceMemory::drag_a},
                                              {"drag_b", "N", &FaceMemory::drag_b},
                                              {"damping_work", "J", &FaceMemory::damping_work},
                                              {"damping_due", "J", &FaceMemory::damping_due},
                                              {"switched", "1", &FaceMemory::switched},
                                              {"friction_work", "J", &FaceMemory::friction_work},
                                              {"transfer", "J", &FaceMemory::transfer}};

/// FaceSet::breaks of a bond.
inline constexpr double bond_breaks = 2.0;

struct FaceSet {
  std::size_t size() const { return edge.size(); }

  // Identity. Filled by find_faces(); fixed between two searches.
  std::vector<Id> edge, facing;                    ///< e < f, of two blocks
  std::vector<Id> edge_end, facing_end;            ///< their second corners
  std::vector<std::uint16_t> law;                  ///< row of the LawTable
  std::vector<double> stiffness, shear_stiffness;  ///< k, ks times thickness, N/m per m of overlap
  std::vector<double> inverse_e, inverse_f, gate_from, gate_scale, passing;  ///< as in FacePair
  std::vector<double>
      at_ends;  ///< 1: the stiffness is a penalty: the integral is taken at the ends

  // What holds for a face until it dies, decided while it stores nothing.
  std::vector<double> acts;   ///< 1: the blocks meet there; 0: their far sides do
  std::vector<double> leans;  ///< 1: beside the corner that leans there is no third block

  // Strength in force.
  std::vector<double> friction;  ///< tan(phi)
  std::vector<double> cohesion;  ///< c times thickness, N per m of overlap
  std::vector<double> tension;   ///< tensile strength times thickness, N per m; of those that pull
  std::vector<double> pulls;     ///< 1: bears tension
  std::vector<double> bonded;    ///< 1: has its peak strength: its shear is not cut
  std::vector<double> glued;     ///< 1: never opens or slides
  std::vector<double> offset_a,
      offset_b;              ///< o, closure at the ends of the surfaces as drawn, m
  std::vector<double> slid;  ///< m: slip so far; infinite: has its residual strength; of laws that
                             ///< change with it
  std::vector<double> owed;  ///< m that the joint has still to open by its dilation
  std::vector<double> lent;  ///< what a glued face had before, 1 + bonded + 2 pulls; else 0
  std::vector<double>
      breaks;  ///< 1: torn in the step in hand, 2: its bond breaks: what goes is fracture energy
  std::vector<double> opened;   ///< 1: has opened after having been closed
  std::vector<double> slipped;  ///< 1: has slid at least once

  // Dashpots, as fractions of critical; empty where there are none. Filled by set_face_dashpots().
  std::vector<double> zeta, shear_zeta;

  FaceMemory now;     ///< at step n
  FaceMemory before;  ///< at n - 1; while n + 1 is tried: at n

  std::vector<double> friction_work, damping_work, fracture_work, transfer;  ///< so far, J

  /// Forces on the corners of both edges at n, N: by slot, x and y on the edge's start, on its end.
  std::vector<double> force;
  std::vector<Id> slot, facing_slot;  ///< [nf] of the edge and of the one that faces it
  std::vector<Id> begin_of_edge;      ///< [nv + 1] slots of an edge
  std::vector<Id> of_slot;            ///< [2 nf] its face

  static constexpr std::size_t chunk = 16;
  static constexpr std::size_t run = 32 * chunk;  ///< what a thread takes at once
  std::size_t chunks() const { return (size() + chunk - 1) / chunk; }
  std::vector<std::uint8_t> stirs;  ///< [chunks] 1: ends of a face in it open or close
  std::vector<double> deepest;      ///< [chunks] largest closure of a face that carries, m
  std::vector<std::uint8_t> bonds;  ///< [chunks] 1: a face in it is bonded or pulls

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
      visit(of_slot[q], slot[of_slot[q]] == q);
    }
  }
};

/// The arrays of FaceSet that are kept over a search and in a checkpoint, once: name and unit.
struct FaceStateColumn {
  const char* name;
  const char* unit;
  std::vector<double> FaceSet::*values;
};
inline constexpr FaceStateColumn face_state_columns[] = {
    {"acts", "1", &FaceSet::acts},
    {"leans", "1", &FaceSet::leans},
    {"friction", "1", &FaceSet::friction},
    {"cohesion", "N/m", &FaceSet::cohesion},
    {"tension", "N/m", &FaceSet::tension},
    {"pulls", "1", &FaceSet::pulls},
    {"bonded", "1", &FaceSet::bonded},
    {"glued", "1", &FaceSet::glued},
    {"lent", "1", &FaceSet::lent},
    {"opened", "1", &FaceSet::opened},
    {"slipped", "1", &FaceSet::slipped},
    {"breaks", "1", &FaceSet::breaks},
    {"offset_a", "m", &FaceSet::offset_a},
    {"offset_b", "m", &FaceSet::offset_b},
    {"slid", "m", &FaceSet::slid},
    {"owed", "m", &FaceSet::owed},
    {"friction_work", "J", &FaceSet::friction_work},
    {"damping_work", "J", &FaceSet::damping_work},
    {"fracture_work", "J", &FaceSet::fracture_work},
    {"transfer", "J", &FaceSet::transfer}};

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
  const Id p1 = c.edge[k], p2 = c.edge_end[k], q1 = c.facing[k], q2 = c.facing_end[k];
  p.p1_turn = {turn_cosine[p1], turn_sine[p1]};
  p.p2_turn = {turn_cosine[p2], turn_sine[p2]};
  p.q1_turn = {turn_cosine[q1], turn_sine[q1]};
  p.q2_turn = {turn_cosine[q2], turn_sine[q2]};
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
