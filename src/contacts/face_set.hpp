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

/// Constants of a face, its current strength, and its history.
template <class C>
struct FaceProperties {
  C stiffness, shear_stiffness;  ///< k, ks times thickness, N/m per m of overlap
  C inverse_e, inverse_f, gate_from, gate_scale, passing;  ///< as in FacePair

  C friction;  ///< tan(phi)
  C cohesion;  ///< c times thickness, N per m of overlap
  C tension;  ///< tensile strength times thickness, N per m of overlap, of FaceSet::carries_tension
  C locked_closure_a,
      locked_closure_b;  ///< o, closure added at the ends to that of the surfaces as drawn, m
  C slip_so_far;    ///< accumulated slip, m, for slip-dependent laws; infinite: has its residual
                    ///< strength
  C dilation_left;  ///< m by which dilation has yet to open the joint
  C parted_a, parted_b;  ///< largest opening of its crack so far, m (contacts/face_softening.hpp)
  C gap_a, gap_b;        ///< present opening of its crack, m: part of the locked closure
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
    {"friction", "1", &FaceProperties<C>::friction, true},
    {"cohesion", "N/m", &FaceProperties<C>::cohesion, true},
    {"tension", "N/m", &FaceProperties<C>::tension, true},
    {"locked_closure_a", "m", &FaceProperties<C>::locked_closure_a, true},
    {"locked_closure_b", "m", &FaceProperties<C>::locked_closure_b, true},
    {"slip_so_far", "m", &FaceProperties<C>::slip_so_far, true},
    {"dilation_left", "m", &FaceProperties<C>::dilation_left, true},
    {"parted_a", "m", &FaceProperties<C>::parted_a, true},
    {"parted_b", "m", &FaceProperties<C>::parted_b, true},
    {"gap_a", "m", &FaceProperties<C>::gap_a, true},
    {"gap_b", "m", &FaceProperties<C>::gap_b, true},
    {"friction_work", "J", &FaceProperties<C>::friction_work, true},
    {"damping_work", "J", &FaceProperties<C>::damping_work, true},
    {"fracture_work", "J", &FaceProperties<C>::fracture_work, true},
    {"transfer", "J", &FaceProperties<C>::transfer, true}};
inline constexpr auto& face_properties = face_property_list<RowColumn>;

/// What is decided of a face, a bit each.
enum class FaceFlag : std::uint16_t {
  // Decided while the face stores no energy; valid as long as it exists.
  acts = 1u << 0,   ///< else its edges are far sides of blocks, which do not meet
  leans = 1u << 1,  ///< no third block lies beside the corner that leans
  // Its bond (BondState), and whether it transmits tension.
  intact = 1u << 2,
  cracked = 1u << 3,
  carries_tension = 1u << 4,
  glued = 1u << 5,           ///< by its law: it never opens or slides
  glued_by_stage = 1u << 6,  ///< for the time of a stage, whatever its bond
  // In the current step.
  fails = 1u << 7,        ///< its bond, or its tension: the energy released is fracture energy
  bond_breaks = 1u << 8,  ///< that of its bond
  // Since the start.
  opened = 1u << 9,  ///< after having been closed, or its bond or tension has failed
  slipped = 1u << 10,
  // Its crack, of a law that softens (contacts/face_softening.hpp).
  softens = 1u << 11,  ///< has exceeded its strength, and is decided in every step
  broken_in_tension = 1u << 12,
  broken_in_shear = 1u << 13
};

inline constexpr std::uint16_t all_face_flags =
    2u * static_cast<unsigned>(FaceFlag::broken_in_shear) - 1;

/// Bond of a face, which as a whole has its peak strength until it breaks. A face that tension has
/// cracked from one end while the other is pressed keeps the peak strength in shear, and has the
/// residual one in tension. A face without a bond has what its law gives it at its slip: the
/// residual strength, or that of slip weakening.
enum class BondState : std::uint8_t { unbonded, cracked, intact };

/// What a law gives all its faces.
struct FacesOfLaw {
  bool at_ends = false;  ///< the stiffness is a penalty: the integral is taken at the ends
  double zeta = 0.0, shear_zeta = 0.0;  ///< dashpots, as fractions of critical
  double rebound = 0.0;  ///< of dashpots in proportion to the pressure; 0: they are linear
};

struct FaceSet : RowTable<FaceProperties<RowColumn>, face_property_list<RowColumn>> {
  std::size_t size() const { return edge.size(); }

  // Identity. Filled by find_faces(); fixed between two searches.
  std::vector<Id> edge, facing;          ///< e < f, of two blocks
  std::vector<Id> edge_end, facing_end;  ///< their second corners
  std::vector<std::uint16_t> law;        ///< row of the LawTable

  std::vector<std::uint16_t> flags;  ///< bits of FaceFlag

  bool is(FaceFlag flag, std::size_t k) const {
    return (flags[k] & static_cast<std::uint16_t>(flag)) != 0;
  }
  void set(FaceFlag flag, std::size_t k, bool to = true) {
    const auto bit = static_cast<std::uint16_t>(flag);
    flags[k] = static_cast<std::uint16_t>(to ? flags[k] | bit : flags[k] & ~bit);
  }
  bool acts(std::size_t k) const { return is(FaceFlag::acts, k); }
  /// Whether it has spent its fracture energy.
  bool is_broken(std::size_t k) const {
    return is(FaceFlag::broken_in_tension, k) || is(FaceFlag::broken_in_shear, k);
  }
  bool leans(std::size_t k) const { return is(FaceFlag::leans, k); }
  BondState bond(std::size_t k) const {
    return is(FaceFlag::intact, k)    ? BondState::intact
           : is(FaceFlag::cracked, k) ? BondState::cracked
                                      : BondState::unbonded;
  }
  void set_bond(BondState to, std::size_t k) {
    set(FaceFlag::intact, k, to == BondState::intact);
    set(FaceFlag::cracked, k, to == BondState::cracked);
  }
  /// Whether the face never opens or slides.
  bool glued(std::size_t k) const {
    return is(FaceFlag::glued, k) || is(FaceFlag::glued_by_stage, k);
  }
  /// Whether it breaks as a whole instead of sliding end by end.
  bool bonded(std::size_t k) const {
    return bond(k) != BondState::unbonded || is(FaceFlag::glued_by_stage, k);
  }
  /// Whether it has strength beyond the residual one.
  bool holds(std::size_t k) const { return bonded(k) || is(FaceFlag::softens, k); }
  /// Whether it transmits tension.
  bool carries_tension(std::size_t k) const {
    return is(FaceFlag::carries_tension, k) || is(FaceFlag::glued_by_stage, k);
  }

  std::vector<FacesOfLaw> of_laws;  ///< [rows of the LawTable]
  const FacesOfLaw& of_law(std::size_t k) const { return of_laws[law[k]]; }

  bool dashpots = false;  ///< some face has dashpots, or had them in the current step
  bool slip_laws =
      false;  ///< a joint's strength or opening depends on its slip (LawTable::any_changes)

  /// The faces of each edge: [nv + 1] offsets, and [2 nf] for each face 8 k, or 8 k + 4 where
  /// the edge is `facing`: where the four numbers on it begin in a list of eight for each face, the
  /// forces on its corners. Sorted by the edge on the other side, so that sums do not depend on the
  /// order of the faces.
  std::vector<Id> begin_of_edge, on_edge;

  static constexpr std::size_t failure_group = 16;  ///< faces that share a mark of `group_fails`
  std::size_t failure_groups() const { return (size() + failure_group - 1) / failure_group; }
  std::vector<std::uint8_t> group_fails;  ///< [groups] 1: a face in it fails in the current step

  /// Marks face k as failing in the current step.
  void mark_failure(std::size_t k, bool bond_breaks) {
    set(FaceFlag::fails, k);
    set(FaceFlag::bond_breaks, k, bond_breaks);
    std::atomic_ref<std::uint8_t>(group_fails[k / failure_group])
        .store(1, std::memory_order_relaxed);
  }
  /// Calls visit(k) for the faces that fail in the current step.
  template <class Visit>
  void for_failures(Visit visit) const {
    for (std::size_t q = 0; q < group_fails.size(); ++q) {
      if (group_fails[q] == 0) continue;
      for (std::size_t k = q * failure_group; k < std::min((q + 1) * failure_group, size()); ++k) {
        if (is(FaceFlag::fails, k)) visit(k);
      }
    }
  }

  /// [nf] What dilation has done in the step from n to n + 1: the opening, m, and the energy taken
  /// from friction for it, J. Empty where no joint changes.
  std::vector<double> risen, dilation_work;

  std::vector<double> locked_start, locked_end;  ///< [nv] pressure of the initial stress at the two
                                                 ///< corners of an edge, N per m; empty: none

  // When the list was made, and how long it is valid.
  std::vector<double> built_x, built_y;  ///< [nv] positions of the vertices then, m
  double noise = 0.0;         ///< m: closures up to this size are rounding of the coordinates
  double reach = 0.0;         ///< m: the list contains edges nearer to each other than this
  double reach_behind = 0.0;  ///< m: Reach::behind
  double travel = 0.0;  ///< m: upper bound of how far two edges have approached each other since
  std::uint64_t rebuilds = 0;
  double removed_friction = 0.0, removed_damping = 0.0, removed_fracture = 0.0,
         removed_transfer = 0.0;  ///< J, of faces that have left the list

  bool gluing = false;         ///< a stage glues its joints, also those that come into contact
  double bond_strength = 1.0;  ///< bonds have so many times their cohesion and tensile strength
                               ///< while loads come on (Relaxation::Hold)
  std::uint64_t broken = 0;    ///< number of bonded faces that have failed so far
  std::uint64_t cracks_tension = 0, cracks_shear = 0;  ///< of these, by their fracture energy

  /// Calls visit(k, of_edge) for the faces of the edges [first, end), per edge in the order of the
  /// edges on the other side; of_edge: the edge is `edge` of face k, not `facing`.
  template <class Visit>
  void for_faces(Id first, Id end, Visit visit) const {
    for (Id q = begin_of_edge[first]; q < begin_of_edge[end]; ++q) {
      visit(on_edge[q] / 8, on_edge[q] % 8 == 0);
    }
  }
};

/// Face k as a value.
struct FaceRecord {
  FaceProperties<double> properties;
  std::uint16_t flags;
};
inline FaceRecord record_of(const FaceSet& c, std::size_t k) {
  FaceRecord row{{}, c.flags[k]};
  for (std::size_t i = 0; i < std::size(face_properties); ++i)
    row.properties.*face_property_list<double>[i].values = (c.*face_properties[i].values)[k];
  return row;
}
inline void set_record(FaceSet& c, std::size_t k, const FaceRecord& row) {
  c.flags[k] = row.flags;
  for (std::size_t i = 0; i < std::size(face_properties); ++i)
    (c.*face_properties[i].values)[k] = row.properties.*face_property_list<double>[i].values;
}

/// The element data of face k in its current state.
inline FacePair face_pair(const FaceSet& c, const BlockSet& b, std::size_t k) {
  FacePair p;
  p.stiffness = c.acts(k) ? c.stiffness[k] : 0.0;
  p.offset = {c.locked_closure_a[k], c.locked_closure_b[k]};
  p.ends = c.of_law(k).at_ends && c.leans(k) ? 1.0 : 0.0;
  p.carries_tension = c.carries_tension(k) ? 1.0 : 0.0;
  p.inverse_e = c.inverse_e[k];
  p.inverse_f = c.inverse_f[k];
  p.length_ratio = c.inverse_e[k] / c.inverse_f[k];
  p.gate_from = c.gate_from[k];
  p.gate_scale = c.gate_scale[k];
  p.passing = c.passing[k];
  const auto turn = [&](Id v) { return Vec2{b.exterior_cosine[v], b.exterior_sine[v]}; };
  p.turn_p1 = turn(c.edge[k]);
  p.turn_p2 = turn(c.edge_end[k]);
  p.turn_q1 = turn(c.facing[k]);
  p.turn_q2 = turn(c.facing_end[k]);
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

inline FacePoints face_points(const FaceSet& c, const std::vector<double>& x,
                              const std::vector<double>& y, std::size_t k) {
  const Id p1 = c.edge[k], p2 = c.edge_end[k], q1 = c.facing[k], q2 = c.facing_end[k];
  return {{x[p1], y[p1]}, {x[p2], y[p2]}, {x[q1], y[q1]}, {x[q2], y[q2]}};
}

/// Coordinates of the corners of face k in its frame at these positions.
inline EdgeCoordinates coordinates_at(const FaceSet& c, const std::vector<double>& x,
                                      const std::vector<double>& y, std::size_t k) {
  return coordinates_of(face_points(c, x, y, k), c.inverse_e[k], c.inverse_f[k]);
}

}  // namespace edda
