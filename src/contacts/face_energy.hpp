// What faces store and do, in the leapfrog's terms (docs/contacts.md).
#pragma once

#include "blocks/pose.hpp"
#include "contacts/face_set.hpp"

namespace edda {

/// sum of f . (x - y) over the corners, J.
double work_of(const CornerForces& force, const FacePoints& to, const FacePoints& from);

/// Energy between two steps, (U_0 + U_1)/2 - (F_0 - F_1).(x_1 - x_0)/4: of a linear spring
/// p d_0 d_1/2. Nothing where the face is open at one of them; one that bears tension never is, and
/// has less than nothing where it goes over from the one to the other, J.
double stored_between(const Face& face0, const FacePoints& at0, const Face& face1,
                      const FacePoints& at1, bool pulls);

/// What face k stores between steps n - 1 and n, J.
double face_energy(const FaceSet& faces, const BlockSet& blocks, const Pose& pose, std::size_t k);

/// The part of it that is of the normal pressure.
double normal_energy(const FaceSet& faces, const BlockSet& blocks, const Pose& pose, std::size_t k);

}  // namespace edda
