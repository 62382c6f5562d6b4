// What faces carry at the start, so that they match the initial stress of the blocks.
#pragma once

#include <functional>
#include <vector>

#include "blocks/initial_stress.hpp"
#include "blocks/pose.hpp"
#include "contacts/face_set.hpp"
#include "contacts/laws.hpp"

namespace edda {

/// What the initial stress does over the part from s = from to s = to of an edge (0: its first
/// vertex, 1: its second).
using FaceTraction = std::function<EndForces(Id edge, double from, double to)>;

/// Of all faces of one law at the start.
struct JointStress {
  double length = 0.0;     ///< m
  double over = 0.0;       ///< m of that whose shear is above its strength
  double torn = 0.0;       ///< m of that in tension above its strength
  double mobilised = 0.0;  ///< largest shear over strength, where pressed
  double ratio = 0.0;      ///< largest shear over normal force, where pressed
};

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
