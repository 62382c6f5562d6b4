// Contact laws as the step needs them, and which law a contact has.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "model/model.hpp"

namespace edda {

/// One joint law, angles as tangents. Stresses in Pa, stiffness in Pa/m.
struct Law {
  double peak_friction, peak_cohesion, peak_tension;
  double residual_friction, residual_cohesion, residual_tension;
  double kn, ks;  ///< each 0: the default of [contact] applies
  bool glued;
  // Dashpots and springs of its own, where it asks for a restitution (run/restitution.hpp).
  bool dashpots = false;
  double damping = 0.0, shear_damping = 0.0;  ///< fractions of critical
  double spring = 0.0;  ///< N/m per metre of thickness, where there is no kn; 0: the default
  // What goes with slip (contacts/joint_laws.hpp).
  bool changes = false;  ///< its strength or opening does
  LawType type = LawType::coulomb;
  double slip_distance = 0.0;                         ///< m; infinite where dilation has no end
  double dilation = 0.0;                              ///< tangent of its angle
  double jrc = 0.0, jcs = 0.0, residual_angle = 0.0;  ///< -, Pa, degrees
};

/// Whether a joint of this law opens as it slips. How far it has opened is a closure of its faces
/// as drawn (FaceSet::offset_a, offset_b).
inline bool dilates(const Law& law) {
  return law.dilation > 0.0 || law.type == LawType::barton_bandis;
}

struct LawTable {
  std::vector<Law> rows;  ///< in the order of Model::joints, then the built-in glued law
  std::vector<std::uint16_t>
      rank;  ///< of each row: lower friction angle, then cohesion, tension, name
  std::vector<double>
      divided_by;  ///< [rows] what the strength in `rows` was divided by (contacts/strength.hpp)
  bool any_changes = false;                   ///< a row has `changes`
  bool any_dashpots = false;                  ///< a row has `dashpots`
  double default_kn = 0.0, default_ks = 0.0;  ///< N/m per metre of thickness
  double thickness = 1.0;
  Index default_law = none;
  /// [[contact_pair]]: two joints or two materials, the smaller index first, with their law;
  /// sorted.
  struct Pair {
    std::pair<Index, Index> between;
    std::uint16_t law;
  };
  std::vector<Pair> joint_pairs, material_pairs;

  /// Law of a face between edges of these joints and materials: that of their pair of joints (an
  /// edge that names none counts as contact.joint), else of their pair of materials, else resolve()
  /// of the joints alone.
  std::uint16_t resolve(Index edge, Index facing, Index edge_material, Index facing_material) const;
  /// The same of edges that did not lie against each other as drawn: glue holds what was one rock,
  /// an edge of it that meets another counts as one that names no joint.
  std::uint16_t resolve_met(Index edge, Index facing, Index edge_material,
                            Index facing_material) const;

  /// Law of a face (method.md section 4): that of the edge that names one; else contact.joint.
  /// Where both name one and they differ, the one of lower friction angle, then cohesion, then
  /// tension, then name.
  std::uint16_t resolve(Index edge, Index facing) const;

  /// k and ks of a face times the thickness, N/m per m of overlap: those of the joint, or twice the
  /// spring of each end over its `shorter` edge (m).
  double normal_stiffness(const Law& law, double shorter) const;
  double shear_stiffness(const Law& law, double shorter) const;
  /// Dashpots of its contacts, where all others have `damping`.
  double damping_of(const Law& law, double damping) const {
    return law.dashpots ? law.damping : damping;
  }
};

LawTable build_laws(const Model& model);

}  // namespace edda
