// Forces of the faces at the start, in equilibrium with the initial stress of the blocks (theory,
// sections 3.3 and 4.6).
#pragma once

#include <functional>
#include <vector>

#include "blocks/initial_stress.hpp"
#include "blocks/pose.hpp"
#include "contacts/face_set.hpp"
#include "contacts/face_states.hpp"
#include "contacts/laws.hpp"

namespace edda {

/// Force of the initial stress on the part from s = from to s = to of an edge (0: its first vertex,
/// 1: its second).
using FaceTraction = std::function<EndForces(Id edge, double from, double to)>;

/// Summary of all faces of one joint law at the start.
struct JointStress {
  double length = 0.0;     ///< m of faces
  double over = 0.0;       ///< m of faces whose shear exceeds their strength
  double torn = 0.0;       ///< m of faces whose tension exceeds their tensile strength
  double mobilised = 0.0;  ///< largest shear force over shear strength, of faces in compression
  double ratio = 0.0;      ///< largest shear force over normal force, of faces in compression
};

/// Loads each face that touches with the traction of the initial stress on it. Its ends receive the
/// locked closure, and its shear springs the elastic slip, of the two end forces that have the
/// resultant and the moment of the traction, so that the blocks stay as drawn. Edges remember the
/// pressure for faces that they form later (locked_closure()). Fills their states as if nothing had
/// moved. Returns the demand on the joints, by row of the laws; whether bonds fail or friction
/// limits the shear is decided when the faces are evaluated.
std::vector<JointStress> preload_faces(FaceSet& faces, FaceStates& states, const BlockSet& blocks,
                                       const Pose& pose, const LawTable& laws,
                                       const FaceTraction& traction);

/// Closure at the ends of face k that the pressure locked into its two edges requires, m.
FaceEnds locked_closure(const FaceSet& faces, const Face& face, std::size_t k);

}  // namespace edda
