// Stored energy and work of faces, in the leapfrog's terms (theory, sections 6.2 and 10.1).
#pragma once

#include "blocks/pose.hpp"
#include "contacts/face_set.hpp"

namespace edda {

/// sum of f . (x - y) over the corners, J.
double work_of(const CornerForces& force, const FacePoints& to, const FacePoints& from);

/// Energy between two steps, (U_0 + U_1)/2 - (F_0 - F_1).(x_1 - x_0)/4, J; for a linear spring this
/// is p d_0 d_1/2. It is zero where the face is open at one of the two steps. A face that carries
/// tension is never open; its energy is negative in a step from compression to tension or back.
double stored_between(const Face& face0, const FacePoints& at0, const Face& face1,
                      const FacePoints& at1, bool carries_tension);

/// What the energy of a face follows from beside its corners: its shear springs at n - 1 (stiffness
/// of each end, N/m; slip of the ends, m), and whether it stores energy at n.
struct SpringsOfFace {
  double spring;
  FaceEnds slip;
  bool stores;
  bool have_slip() const { return spring > 0.0 && (slip.a != 0.0 || slip.b != 0.0); }
};
/// Energy that face k stores between steps n - 1 and n, normal and shear, J.
/// at_n: the face at n, which needs to be right where it stores energy or its springs have slip.
double face_energy(const FaceSet& faces, const BlockSet& blocks, const Pose& pose,
                   const SpringsOfFace& springs, const Face& at_n, std::size_t k);

/// The part of face_energy() that is due to the normal pressure, J.
double normal_energy(const FaceSet& faces, const BlockSet& blocks, const Pose& pose, std::size_t k);

}  // namespace edda
