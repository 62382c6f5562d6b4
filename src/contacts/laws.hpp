// Joint laws in the form that the step needs, and the choice of law for each contact.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "blocks/block_set.hpp"
#include "model/contact_springs.hpp"
#include "model/model.hpp"

namespace edda {

/// One joint law, angles as tangents. Stresses in Pa, stiffness in Pa/m.
struct Law {
  double peak_friction, peak_cohesion, peak_tension;
  double residual_friction, residual_cohesion, residual_tension;
  double kn, ks;  ///< each 0: the default of [contact] applies
  bool glued;
  // Dashpots and penalty of its own, where the law gives a restitution (step/restitution.hpp).
  bool dashpots = false;
  double damping = 0.0, shear_damping = 0.0;  ///< fractions of critical
  double spring = 0.0;   ///< N/m per metre of thickness, where there is no kn; 0: the default
  double rebound = 0.0;  ///< LawDashpots::rebound
  // Slip-dependent part (contacts/joint_laws.hpp).
  bool changes = false;  ///< its strength or its opening depends on slip
  LawType type = LawType::coulomb;
  double slip_distance = 0.0;                         ///< m; infinite: dilation has no end
  double dilation = 0.0;                              ///< tangent of the dilation angle
  double jrc = 0.0, jcs = 0.0, residual_angle = 0.0;  ///< -, Pa, degrees
  // Fracture energy (contacts/face_softening.hpp).
  bool softens = false;
  bool loses_peak = false;  ///< may_weaken() of one of the laws between which it changes
  double crack_opening = 0.0, crack_slip = 0.0;  ///< w_c and s_c, m
};

/// Whether a joint of this law opens as it slips. The opening so far is part of the locked closure
/// of its faces (FaceSet::locked_closure_a, locked_closure_b).
inline bool dilates(const Law& law) {
  return law.dilation > 0.0 || law.type == LawType::barton_bandis;
}

/// Whether faces of this law that touch have a strength that they may lose: a bond, or that of slip
/// weakening.
inline bool may_weaken(const Law& law) {
  return law.loses_peak || law.type == LawType::slip_weakening || law.glued ||
         law.peak_cohesion > 0.0 || law.peak_tension > 0.0 ||
         law.peak_friction > law.residual_friction;
}

/// The two edges of a face, as far as its penalty stiffness depends on them.
struct FaceSides {
  double shorter;  ///< length of the shorter one, m
  double
      compliance;  ///< mean of BlockSet::compliance of the two, where a fixed block and a
                   ///< lining, which is thin, count as the other, but four times the smaller one at
                   ///< most, so that a small block between large ones does not sink into them, m/Pa
};
FaceSides sides_of(const BlockSet& blocks, Id edge, Id facing);
/// The same against a much larger block, with the largest compliance that sides_of() allows.
FaceSides beside_much_larger(const BlockSet& blocks, Id edge);

/// How far the laws have come that change in time (LawChange, JointLaw::decay_time).
struct LawProgress {
  double time = 0.0;          ///< s, that joints have had so far
  std::vector<double> part;   ///< [rows of Model::joints] of the change, 0 to 1
  std::vector<double> since;  ///< the same: `time` when the change began, s
  bool operator==(const LawProgress&) const = default;
};

struct LawTable {
  std::vector<Law> rows;  ///< those of Model::joints, and last the intact rock, which no face has
  std::vector<std::uint16_t>
      rank;  ///< [rows] order: lower friction angle first, then cohesion, tension, name
  std::vector<double> divided_by;  ///< [rows] strength factor by which the strength in `rows` is
                                   ///< divided (contacts/strength.hpp)
  double rock_divided_by() const { return divided_by.back(); }
  bool any_changes = false;   ///< a row has `changes`
  bool any_dashpots = false;  ///< a row has `dashpots`
  bool any_softens = false;   ///< a row has `softens`
  ContactSprings penalty{};   ///< of joints without kn
  double thickness = 1.0;
  Index default_law = none;
  std::vector<std::uint16_t>
      named;             ///< [rows] the law that the model gives and that it has, or is to have
  LawProgress progress;  ///< in `rows`
  /// A [[contact_pair]]: two joints or two materials, the smaller index first, with their law;
  /// sorted.
  struct Pair {
    std::pair<Index, Index> between;
    std::uint16_t law;
  };
  std::vector<Pair> joint_pairs, material_pairs;

  /// Law of a face between edges of these joints and materials: that of the pair of joints (an edge
  /// that names none counts as contact.joint), else that of the pair of materials, else resolve()
  /// of the joints alone.
  std::uint16_t resolve(Index edge, Index facing, Index edge_material, Index facing_material) const;
  /// The same for edges that did not lie against each other as drawn. Bonds of intact rock never
  /// form again: a glued edge in contact with another one counts as one that names no joint.
  std::uint16_t resolve_met(Index edge, Index facing, Index edge_material,
                            Index facing_material) const;

  /// Law of a face (theory, section 4.7): that of the edge that names one; else contact.joint.
  /// Where both name one and they differ, the one of lower friction angle, then cohesion, then
  /// tension, then name.
  std::uint16_t resolve(Index edge, Index facing) const;

  /// k and ks of a face times the thickness, N/m per m of overlap: those of the joint, or, for a
  /// penalty, twice the given spring of one end over the shorter edge. Where none is given, 20 over
  /// the compliance of the blocks, so that joints add a twentieth to the deformation of the rock,
  /// however it is cut (theory, section 4.2).
  double normal_stiffness(const Law& law, const FaceSides& sides) const;
  double shear_stiffness(const Law& law, const FaceSides& sides) const;
  /// Fraction of critical damping of contacts of this law, where those without their own have
  /// `damping`.
  double damping_of(const Law& law, double damping) const {
    return law.dashpots ? law.damping : damping;
  }
};

/// With the strength that the laws have had time to lose, or have by their changes (theory, section
/// 5.10): s strength, T decay_time, t the time since the joints have had the law, f the part of the
/// change.
///  s_residual + (s_peak - s_residual) exp(-t/T),  s_from + f (s_to - s_from)
LawTable build_laws(const Model& model, const LawProgress& progress = {});

/// Law of a face between two edges that lie against each other as drawn, or have met since: that
/// which a lining or fill names for itself, whatever the other names; else resolve() or
/// resolve_met().
std::uint16_t law_between(const LawTable& laws, const BlockSet& blocks, Id edge, Id facing,
                          bool drawn);

}  // namespace edda
