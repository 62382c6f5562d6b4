// What faces carry at the start, so that they match the initial stress of the blocks.
#pragma once

#include <vector>

#include "blocks/pose.hpp"
#include "contacts/face_set.hpp"
#include "contacts/laws.hpp"
#include "contacts/preload.hpp"

namespace edda {

/// Loads each face that touches with the traction of the initial stress on it: its ends are closed
/// by what the two end forces of the same resultant and moment take, and its shear springs
/// strained, so that the blocks stay as drawn. Edges remember the pressure, for faces that they
/// make later (locked_pressure()). Fills `before` as if nothing had moved. Returns what is asked of
/// the joints, by row of the laws; bonds and friction have their say when the faces are placed.
std::vector<JointStress> preload_faces(FaceSet& faces, const BlockSet& blocks, const Pose& pose,
                                       const LawTable& laws, const FaceTraction& traction);

/// Closure at the ends of face k that the pressure locked in its edges takes, m.
FaceEnds locked_closure(const FaceSet& faces, const Face& face, std::size_t k);

}  // namespace edda
