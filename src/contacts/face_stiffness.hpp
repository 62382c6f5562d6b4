// Stiffness of a face for the implicit method: the part of the Hessian of its energy that is never
// negative, with the springs of its ends in their directions. What is left out goes with the force
// over the length of the face, and makes rounds more, not another answer.
#pragma once

#include "blocks/pose.hpp"
#include "contacts/face_set.hpp"

namespace edda {

/// d2U/(dd dd) by the closures of the two ends, N/m.
struct EndStiffness {
  double aa = 0.0, ab = 0.0, bb = 0.0;
};

/// Of the element as it stands; ends that gape by less than `near` (m) count as closed.
EndStiffness end_stiffness(const Face& face, const FacePair& pair, double near);

/// Springs of a face: stiffness, and what a unit force at either end does on the corners.
struct FaceStiffness {
  EndStiffness normal;
  double shear_a = 0.0, shear_b = 0.0;  ///< N/m
  CornerForces normal_a, normal_b, along_a, along_b;
  bool any() const {
    return normal.aa != 0.0 || normal.bb != 0.0 || shear_a != 0.0 || shear_b != 0.0;
  }
};

/// How an end is taken.
struct EndsTaken {
  bool a_slides = false, b_slides = false;
  double near = 0.0;  ///< m, as above; shear springs of what is that near hold, too
};

/// Of face k at pose.x, with its dashpots in a step of `step` s.
FaceStiffness face_stiffness(const FaceSet& faces, const BlockSet& blocks, const Pose& pose,
                             double step, const EndsTaken& taken, std::size_t k);

}  // namespace edda
