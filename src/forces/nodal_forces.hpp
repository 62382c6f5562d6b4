// All forces of a step on the nodes, block by block, in a fixed order.
#pragma once

#include <array>
#include <vector>

#include "attachments/boundary_springs.hpp"
#include "attachments/loads.hpp"
#include "blocks/kinematics.hpp"
#include "contacts/face_set.hpp"

namespace edda {

/// Nodal forces [3][nb], N. Filled by gather_forces(); read by the integrator.
struct NodalForces {
  Nodes x, y;
};

/// Gravity, elasticity, boundary springs, loads, bolts and contacts of every free block (Eq. 15),
/// contacts in the order of FaceSet::for_faces(). Blocks whose deformation has gone out of
/// bounds (det F < 0.2 or no rotation left) get NaN; block_out_of_bounds() finds them.
void gather_forces(NodalForces& forces, const BlockSet& blocks, const State& state,
                   const Pose& pose, const FaceSet& contacts, const BoundarySprings& springs,
                   Vec2 gravity, const LoadsNow& loads = {});

/// The same for the blocks [begin, end), not more than blocks_at_once.
void gather_forces(NodalForces& forces, const BlockSet& blocks, const State& state,
                   const Pose& pose, const FaceSet& contacts, const BoundarySprings& springs,
                   Vec2 gravity, const LoadsNow& loads, std::size_t begin, std::size_t end);

/// Force of the contacts alone on the whole of block i (for reactions).
Vec2 contact_resultant(const BlockSet& blocks, const FaceSet& contacts, std::size_t i);

}  // namespace edda
