// The equations of motion of one block for the critical step: its mass, its own stiffness, and the
// springs of all contacts that it may have. Theory, section 7.2.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "attachments/bolts.hpp"
#include "attachments/boundary_springs.hpp"
#include "blocks/masses.hpp"
#include "blocks/state.hpp"
#include "contacts/face_set.hpp"
#include "contacts/laws.hpp"
#include "contacts/points.hpp"
#include "forces/block_matrices.hpp"

namespace edda {

/// Everything that determines stiffness and damping of the blocks.
struct StiffnessInputs {
  const BlockSet& blocks;
  const Masses& masses;
  const State& state;
  const FaceSet& contacts;
  const BoundarySprings& springs;
  const LawTable& laws;
  const Damping& damping;
  const Bolts* bolts = nullptr;      ///< null: none
  const PointSet* points = nullptr;  ///< point contacts that are near, in place of faces all round;
                                     ///< null: contacts are faces
  bool alone = std::count(blocks.fixed.begin(), blocks.fixed.end(), 0) == 1;  ///< only one block is
                                                                              ///< free
};

/// Contribution of a contact at one corner to the equations of a block. All with the factor 2, or 1
/// against a fixed block (step_bound.hpp).
struct SpringOnBlock {
  Id face;  ///< in the list of faces, or no_id
  NodalVector normal,
      tangent;  ///< unit forces at the corner, spread on the nodes (q_c in theory 7.2)
  double kn, ks, dashpot, shear_dashpot;  ///< normal and shear spring, N/m; dashpots across and
                                          ///< along the joint, N s/m
};

/// Equations M a + (C + D) v + K x = f of one block in its own frame, for the
/// components of its nodes; they determine the step that it allows.
struct BlockEquations {
  NodalMatrix mass;     ///< M
  NodalMatrix viscous;  ///< D of the strain damping, taken with the new velocity
  NodalMatrix dashpots = NodalMatrix::Zero();  ///< C of contacts, taken with the old velocity
  NodalMatrix elastic, boundary, bolts;        ///< parts of K
  NodalMatrix contacts = NodalMatrix::Zero();  ///< the part of K due to contacts
  std::vector<SpringOnBlock> parts;  ///< contacts of which `contacts` and `dashpots` are the sum

  NodalMatrix stiffness() const { return elastic + boundary + bolts + contacts; }
  void add(const SpringOnBlock& p) {
    contacts += p.kn * p.normal * p.normal.transpose() + p.ks * p.tangent * p.tangent.transpose();
    if (p.dashpot > 0.0) dashpots += p.dashpot * p.normal * p.normal.transpose();
    if (p.shear_dashpot > 0.0) dashpots += p.shear_dashpot * p.tangent * p.tangent.transpose();
  }
};

BlockEquations equations_of(const StiffnessInputs& inputs, std::size_t i);

/// A hash of everything in the equations of block i that may change with the list of faces, stages
/// or masses; 0: the equations change with the state, too.
std::uint64_t equations_hash(const StiffnessInputs& inputs, std::size_t i);

}  // namespace edda
