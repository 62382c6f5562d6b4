// All nodal forces of a step, block by block, in a fixed order.
#pragma once

#include <vector>

#include "attachments/boundary_springs.hpp"
#include "attachments/loads.hpp"
#include "blocks/kinematics.hpp"
#include "contacts/face_set.hpp"

namespace edda {

/// Nodal forces [nodes][nb], N. Filled by gather_forces(); read by the integrator.
struct NodalForces {
  Nodes x, y;
  ModeVectors modes = {};  ///< [modes] on the modes of blocks that bend, N
};

/// Sums the forces of the faces on each block, in the order of FaceSet::for_faces(). Fixed blocks
/// have theirs, too. forces: corner_forces() of all faces.
void sum_faces(NodalForces& on_faces, const BlockSet& blocks, const FaceSet& contacts,
               const std::vector<double>& forces);

/// Sizes forces for blocks, all 0.
NodalForces no_forces(const BlockSet& blocks);

/// Gravity, elasticity, boundary springs, loads, bolts and contacts of every free block (Eq. 15);
/// on_faces: what the faces exert on it, N, [nodes][nb];
/// locked: forces on modes that balance the initial stress (forces/bending_forces.hpp). Blocks that
/// have lost their shape (det F < 0.2, or no rotation is defined) get NaN; block_out_of_bounds()
/// finds them.
void gather_forces(NodalForces& forces, const BlockSet& blocks, const State& state,
                   const Pose& pose, const NodalForces& on_faces, const BoundarySprings& springs,
                   Vec2 gravity, const LoadsNow& loads = {}, const ModeVectors& locked = {});

/// The same for the blocks [begin, end), not more than blocks_at_once.
void gather_forces(NodalForces& forces, const BlockSet& blocks, const State& state,
                   const Pose& pose, const NodalForces& on_faces, const BoundarySprings& springs,
                   Vec2 gravity, const LoadsNow& loads, const ModeVectors& locked,
                   std::size_t begin, std::size_t end);

/// All of them but those of the contacts, which are to be added (add_to_free()): until then blocks
/// that are not free have forces, too.
void gather_own_forces(NodalForces& forces, const BlockSet& blocks, const State& state,
                       const Pose& pose, const BoundarySprings& springs, Vec2 gravity,
                       const LoadsNow& loads, const ModeVectors& locked, std::size_t begin,
                       std::size_t end);

}  // namespace edda
