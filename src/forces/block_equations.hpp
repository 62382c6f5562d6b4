// The equations of motion of one block for the critical step: its mass, its own stiffness, and the
// springs of all contacts that it may have. Theory, section 7.2.
#pragma once

#include <algorithm>
#include <cstdint>
#include <type_traits>
#include <vector>

#include "attachments/bolts.hpp"
#include "attachments/boundary_springs.hpp"
#include "blocks/masses.hpp"
#include "blocks/state.hpp"
#include "contacts/face_set.hpp"
#include "contacts/laws.hpp"
#include "forces/block_matrices.hpp"
#include "zones/zone_set.hpp"

namespace edda {

/// Contribution of a contact at one corner to the equations of a block. All with the factor 2, or 1
/// against a fixed block (step_bound.hpp).
struct SpringOnBlock {
  Id face;                                ///< in the list of faces, or no_id
  Id corner;                              ///< vertex
  NodeWeights weight;                     ///< of the nodes at the corner
  Vec2 normal, tangent;                   ///< directions
  double kn, ks, dashpot, shear_dashpot;  ///< normal and shear spring, N/m; dashpots across and
                                          ///< along the joint, N s/m
};

/// Contacts that may act on the blocks, in place of those of faces all round.
struct NearSprings {
  std::vector<SpringOnBlock> springs;  ///< by block
  std::vector<Id> begin;               ///< [nb + 1] of each block
};

/// Everything that determines stiffness and damping of the blocks.
struct StiffnessInputs {
  const BlockSet& blocks;
  const Masses& masses;
  const State& state;
  const FaceSet& contacts;
  const BoundarySprings& springs;
  const LawTable& laws;
  const Damping& damping;
  const Bolts* bolts = nullptr;       ///< null: none
  const ZoneModel* zones = nullptr;   ///< of meshed blocks; null: none
  const NearSprings* near = nullptr;  ///< null: contacts are faces
  bool alone = std::count(blocks.fixed.begin(), blocks.fixed.end(), 0) == 1;  ///< only one block is
                                                                              ///< free
};

/// Equations M a + (C + D) v + K x = f of one block in its own frame, for the components of its
/// nodes, and of its modes if it bends (Matrix: BodyMatrix); they determine the step that it
/// allows.
template <class Matrix>
struct BlockEquations {
  using Vector = std::conditional_t<std::is_same_v<Matrix, NodalMatrix>, NodalVector, BodyColumn>;
  Matrix mass;                       ///< M
  Matrix viscous;                    ///< D of the strain damping, taken with the new velocity
  Matrix dashpots;                   ///< C of contacts, taken with the old velocity
  Matrix elastic, boundary, bolts;   ///< parts of K
  Matrix contacts;                   ///< the part of K due to contacts
  std::vector<SpringOnBlock> parts;  ///< contacts of which `contacts` and `dashpots` are the sum

  Matrix stiffness() const { return elastic + boundary + bolts + contacts; }
};

/// Contacts of block i as if it were in contact all round, or those near it.
std::vector<SpringOnBlock> springs_all_round(const StiffnessInputs& inputs, std::size_t i);

/// Unit forces along `direction` at the corner of a spring, on the nodes and modes of its block
/// (q_c in theory 7.2). Vector: of BlockEquations.
template <class Vector>
Vector at_corner_of(const BlockSet& b, const SpringOnBlock& spring, Vec2 direction) {
  if constexpr (std::is_same_v<Vector, BodyColumn>) {
    return at_corner(b, spring.corner, direction);
  } else {
    return along(spring.weight, direction);
  }
}

/// Matrix: NodalMatrix, of blocks that do not bend, or BodyMatrix.
template <class Matrix>
BlockEquations<Matrix> equations_of(const StiffnessInputs& inputs, std::size_t i);
extern template BlockEquations<NodalMatrix> equations_of(const StiffnessInputs&, std::size_t);
extern template BlockEquations<BodyMatrix> equations_of(const StiffnessInputs&, std::size_t);

/// A hash of everything in the equations of block i that may change with the list of faces, stages
/// or masses; 0: the equations change with the state, too.
std::uint64_t equations_hash(const StiffnessInputs& inputs, std::size_t i);

}  // namespace edda
