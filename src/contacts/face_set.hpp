// Faces: the list of contacts and what is decided of each, [nf] rows, sorted by their two edges.
// Their states are in tiles (contacts/face_tiles.hpp).
// Element and notation: contacts/face.hpp; docs/contacts.md.
#pragma once

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <vector>

#include "base/columns.hpp"
#include "blocks/block_set.hpp"
#include "contacts/face.hpp"

namespace edda {

/// Properties of a face, its current strength, and its history.
template <class C>
struct FaceProperties {
  C stiffness, shear_stiffness;  ///< k, ks times thickness, N/m per m of overlap
  C inverse_e, inverse_f, gate_from, gate_scale, passing;  ///< as in FacePair
  C at_ends;  ///< 1: the stiffness is a penalty: the integral is taken at the ends

  // Decided while the face stores no energy; valid as long as it exists.
  C acts;   ///< 1: the face acts; 0: its edges are far sides of blocks, which do not meet
  C leans;  ///< 1: no third block lies beside the corner that leans

  C friction;  ///< tan(phi)
  C cohesion;  ///< c times thickness, N per m of overlap
  C locked_closure_a,
      locked_closure_b;  ///< o, closure added at the ends to that of the surfaces as drawn, m
  C carries_tension;     ///< 1: carries tension
  C bonded;              ///< 1: has its peak strength; its shear is not cut end by end
  C zeta, shear_zeta;    ///< dashpots, as fractions of critical: set_face_dashpots()
  C rebound;             ///< of dashpots in proportion to the pressure; 0: they are linear

  C tension;  ///< tensile strength times thickness, N per m of overlap; used where carries_tension
              ///< is 1
  C glued;    ///< 1: never opens or slides
  C slip_so_far;    ///< accumulated slip, m, for slip-dependent laws; infinite: has its residual
                    ///< strength
  C dilation_left;  ///< m by which dilation has yet to open the joint
  C saved_bond;  ///< state of a temporarily glued face before that, 1 + bonded + 2 carries_tension;
                 ///< else 0
  C failure;  ///< 1: fails in tension in the current step, 2: its bond breaks; the energy released
              ///< is fracture energy
  C opened;   ///< 1: has opened after having been closed
  C slipped;  ///< 1: has slid at least once
  C friction_work, damping_work, fracture_work, transfer;  ///< accumulated, J
};

/// The columns of FaceProperties. kept: carried over a search and into a checkpoint; the others are
/// computed again.
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
    {"locked_closure_a", "m", &FaceProperties<C>::locked_closure_a, true},
    {"locked_closure_b", "m", &FaceProperties<C>::locked_closure_b, true},
    {"carries_tension", "1", &FaceProperties<C>::carries_tension, true},
    {"bonded", "1", &FaceProperties<C>::bonded, true},
    {"zeta", "1", &FaceProperties<C>::zeta, false},
    {"shear_zeta", "1", &FaceProperties<C>::shear_zeta, false},
    {"rebound", "1", &FaceProperties<C>::rebound, false},
    {"tension", "N/m", &FaceProperties<C>::tension, true},
    {"glued", "1", &FaceProperties<C>::glued, true},
    {"slip_so_far", "m", &FaceProperties<C>::slip_so_far, true},
    {"dilation_left", "m", &FaceProperties<C>::dilation_left, true},
    {"saved_bond", "1", &FaceProperties<C>::saved_bond, true},
    {"failure", "1", &FaceProperties<C>::failure, true},
    {"opened", "1", &FaceProperties<C>::opened, true},
    {"slipped", "1", &FaceProperties<C>::slipped, true},
    {"friction_work", "J", &FaceProperties<C>::friction_work, true},
    {"damping_work", "J", &FaceProperties<C>::damping_work, true},
    {"fracture_work", "J", &FaceProperties<C>::fracture_work, true},
    {"transfer", "J", &FaceProperties<C>::transfer, true}};
inline constexpr auto& face_properties = face_property_list<RowColumn>;

/// Value of FaceSet::failure where a bond breaks.
inline constexpr double bond_breaks = 2.0;

struct FaceSet : RowTable<FaceProperties<RowColumn>, face_property_list<RowColumn>> {
  std::size_t size() const { return edge.size(); }

  // Identity. Filled by find_faces(); fixed between two searches.
  std::vector<Id> edge, facing;          ///< e < f, of two blocks
  std::vector<Id> edge_end, facing_end;  ///< their second corners
  std::vector<std::uint16_t> law;        ///< row of the LawTable

  bool dashpots = false;  ///< some face has dashpots, or had them in the current step
  bool slip_laws =
      false;  ///< a joint's strength or opening depends on its slip (LawTable::any_changes)

  /// The faces of each edge: [nv + 1] offsets, and [2 nf] for each face 8 k, or 8 k + 4 where
  /// the edge is `facing`: where the four numbers on it begin in a list of eight for each face, the
  /// forces on its corners. Sorted by the edge on the other side, so that sums do not depend on the
  /// order of the faces.
  std::vector<Id> begin_of_edge, on_edge;

  static constexpr std::size_t chunk = 16;  ///< faces that share a mark of `chunk_fails`
  std::size_t chunks() const { return (size() + chunk - 1) / chunk; }
  std::vector<std::uint8_t> chunk_fails;  ///< [chunks] 1: `failure` is set for a face in it

  /// Marks face k as failing in the current step.
  void mark_failure(std::size_t k, double how) {
    failure[k] = how;
    std::atomic_ref<std::uint8_t>(chunk_fails[k / chunk]).store(1, std::memory_order_relaxed);
  }
  /// Calls visit(k) for the faces that fail in the current step.
  template <class Visit>
  void for_failures(Visit visit) const {
    for (std::size_t q = 0; q < chunk_fails.size(); ++q) {
      if (chunk_fails[q] == 0) continue;
      for (std::size_t k = q * chunk; k < std::min((q + 1) * chunk, size()); ++k) {
        if (failure[k] != 0.0) visit(k);
      }
    }
  }

  /// [nf] What dilation has done in the step from n to n + 1: the opening, m, and the energy taken
  /// from friction for it, J. Empty where no joint changes.
  std::vector<double> risen, risen_by;

  std::vector<double> locked_start, locked_end;  ///< [nv] pressure of the initial stress at the two
                                                 ///< corners of an edge, N per m; empty: none

  // When the list was made, and how long it is valid.
  std::vector<double> built_x, built_y;  ///< [nv] positions of the vertices then, m
  double noise = 0.0;         ///< m: closures up to this size are rounding of the coordinates
  double reach = 0.0;         ///< m: the list contains edges nearer to each other than this
  double reach_behind = 0.0;  ///< m, Reach::behind: and of those behind each other also deeper ones
  double travel = 0.0;  ///< m: upper bound of how far two edges have approached each other since
  std::uint64_t rebuilds = 0;
  double removed_friction = 0.0, removed_damping = 0.0, removed_fracture = 0.0,
         removed_transfer = 0.0;  ///< J, of faces that have left the list

  bool gluing = false;         ///< a stage glues its joints, also those that come into contact
  double bond_strength = 1.0;  ///< bonds have so many times their cohesion and tensile strength
                               ///< while loads come on (Relaxation::Hold)
  std::uint64_t broken = 0;    ///< number of bonded faces that have failed so far

  /// Calls visit(k, of_edge) for the faces of the edges [first, end), per edge in the order of the
  /// edges on the other side; of_edge: the edge is `edge` of face k, not `facing`.
  template <class Visit>
  void for_faces(Id first, Id end, Visit visit) const {
    for (Id q = begin_of_edge[first]; q < begin_of_edge[end]; ++q) {
      visit(on_edge[q] / 8, on_edge[q] % 8 == 0);
    }
  }
};

/// The properties of face k.
inline FaceProperties<double> properties_of(const FaceSet& c, std::size_t k) {
  FaceProperties<double> row;
  for (std::size_t i = 0; i < std::size(face_properties); ++i)
    row.*face_property_list<double>[i].values = (c.*face_properties[i].values)[k];
  return row;
}
inline void set_properties(FaceSet& c, std::size_t k, const FaceProperties<double>& row) {
  for (std::size_t i = 0; i < std::size(face_properties); ++i)
    (c.*face_properties[i].values)[k] = row.*face_property_list<double>[i].values;
}

/// FacePair::length_ratio of face k.
template <class Faces>
EDDA_INLINE double length_ratio(const Faces& c, std::size_t k) {
  return c.inverse_e[k] / c.inverse_f[k];
}

/// The element data of face k in its current state.
template <class Faces>
EDDA_INLINE FacePair face_pair(const Faces& c, const double* exterior_cosine,
                               const double* exterior_sine, std::size_t k) {
  FacePair p;
  p.stiffness = c.stiffness[k] * c.acts[k];
  p.offset = {c.locked_closure_a[k], c.locked_closure_b[k]};
  p.ends = c.at_ends[k] * c.leans[k];
  p.carries_tension = c.carries_tension[k];
  p.inverse_e = c.inverse_e[k];
  p.inverse_f = c.inverse_f[k];
  p.length_ratio = length_ratio(c, k);
  p.gate_from = c.gate_from[k];
  p.gate_scale = c.gate_scale[k];
  p.passing = c.passing[k];
  const Id p1 = c.edge[k], p2 = c.edge_end[k], q1 = c.facing[k], q2 = c.facing_end[k];
  p.turn_p1 = {exterior_cosine[p1], exterior_sine[p1]};
  p.turn_p2 = {exterior_cosine[p2], exterior_sine[p2]};
  p.turn_q1 = {exterior_cosine[q1], exterior_sine[q1]};
  p.turn_q2 = {exterior_cosine[q2], exterior_sine[q2]};
  return p;
}

/// Gap, as a part of the smaller block's size, up to which blocks touch; and up to which they do so
/// as drawn, with coordinates that were rounded, and keep the strength of that as they gape.
inline constexpr double touching_gap = 1e-6, drawn_gap = 1e-3;

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

/// Coordinates of the corners of face k in its frame at these positions.
template <class Faces, class Values>
EDDA_INLINE EdgeCoordinates coordinates_at(const Faces& c, const Values& x, const Values& y,
                                           std::size_t k) {
  return coordinates_of(face_points(c, x, y, k), c.inverse_e[k], c.inverse_f[k]);
}

}  // namespace edda
