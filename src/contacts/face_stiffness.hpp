// Stiffness of a face for the implicit method: the positive semidefinite part of the Hessian of its
// energy, with the springs of its ends in their directions. The part that is left out is of the
// order of force over face length; it costs iterations, not accuracy (theory, section 12.2).
#pragma once

#include "blocks/pose.hpp"
#include "contacts/evaluate_face.hpp"
#include "contacts/face_set.hpp"

namespace edda {

/// d2U/(dd dd) by the closures of the two ends, N/m.
struct EndStiffness {
  double aa = 0.0, ab = 0.0, bb = 0.0;
};

/// Of the element in its present state; ends that gape by less than `near` (m) count as closed.
EndStiffness end_stiffness(const Face& face, const FacePair& pair, double near);

/// Springs of a face: stiffness, and the corner forces of a unit force at either end.
struct FaceStiffness {
  EndStiffness normal;
  double shear_a = 0.0, shear_b = 0.0;  ///< N/m
  CornerForces normal_a, normal_b, along_a, along_b;
  bool any() const {
    return normal.aa != 0.0 || normal.bb != 0.0 || shear_a != 0.0 || shear_b != 0.0;
  }
};

/// Assumed contact state of the ends.
struct EndStates {
  bool a_slides = false, b_slides = false;
  double near = 0.0;  ///< m, as above; within it shear springs act, too
};

/// Stiffness of face k at Pose::x, with its dashpots for a step of `step` s.
FaceStiffness face_stiffness(const FaceSet& faces, const FaceScene& scene, double step,
                             const EndStates& taken, std::size_t k);

}  // namespace edda
