// All forces on the blocks in a step, block by block, in a fixed order.
#pragma once

#include <vector>

#include "attachments/boundary_springs.hpp"
#include "attachments/loads.hpp"
#include "blocks/kinematics.hpp"
#include "contacts/face_set.hpp"
#include "zones/zone_set.hpp"

namespace edda {

/// Sums the forces of the faces on each block, in the order of FaceSet::for_faces(). Fixed blocks
/// have theirs, too. forces: corner_forces() of all faces.
void sum_faces(BodyVectors& on_faces, const BlockSet& blocks, const FaceSet& contacts,
               const std::vector<double>& forces);

/// What the rock of blocks has beside their uniform strain.
struct RockInside {
  const ModeVectors* locked = nullptr;  ///< forces on modes that balance the initial stress
                                        ///< (forces/bending_forces.hpp); null or empty: none
  const ZoneModel* model = nullptr;     ///< of meshed blocks; null: there are none
  const Zones* zones = nullptr;         ///< theirs, evaluated at the positions

  const ModeVectors& locked_forces() const {
    static const ModeVectors nothing;
    return locked == nullptr ? nothing : *locked;
  }
};

/// Gravity, elasticity, boundary springs, loads, bolts and contacts of every free block (Eq. 15);
/// on_faces: what the faces exert on it, N. Blocks that have lost their shape (det F < 0.2, or no
/// rotation is defined) get NaN; block_out_of_bounds() finds them.
void gather_forces(BodyVectors& forces, const BlockSet& blocks, const State& state,
                   const Pose& pose, const BodyVectors& on_faces, const BoundarySprings& springs,
                   Vec2 gravity, const LoadsNow& loads = {}, const RockInside& rock = {});

/// The same for the blocks [begin, end), not more than blocks_at_once.
void gather_forces(BodyVectors& forces, const BlockSet& blocks, const State& state,
                   const Pose& pose, const BodyVectors& on_faces, const BoundarySprings& springs,
                   Vec2 gravity, const LoadsNow& loads, const RockInside& rock, std::size_t begin,
                   std::size_t end);

/// All of them but those of the contacts, which are to be added (add_to_free()): until then blocks
/// that are not free have forces, too.
void gather_own_forces(BodyVectors& forces, const BlockSet& blocks, const State& state,
                       const Pose& pose, const BoundarySprings& springs, Vec2 gravity,
                       const LoadsNow& loads, const RockInside& rock, std::size_t begin,
                       std::size_t end);

}  // namespace edda
