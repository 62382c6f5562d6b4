// Stored energy and work of faces, in the leapfrog's terms (theory, sections 6.2 and 10.1).
#pragma once

#include "blocks/pose.hpp"
#include "contacts/face.hpp"
#include "contacts/face_set.hpp"

namespace edda {

/// sum of f . (x - y) over the corners, J.
EDDA_INLINE double work_of(const CornerForces& force, const FacePoints& to,
                           const FacePoints& from) {
  return dot(force.p1, to.p1 - from.p1) + dot(force.p2, to.p2 - from.p2) +
         dot(force.q1, to.q1 - from.q1) + dot(force.q2, to.q2 - from.q2);
}

/// Energy between two steps, (U_0 + U_1)/2 - (F_0 - F_1).(x_1 - x_0)/4, J; for a linear spring this
/// is p d_0 d_1/2. It is zero where the face is open at one of the two steps. A face that carries
/// tension is never open; its energy is negative in a step from compression to tension or back.
EDDA_INLINE double stored_between(const Face& face0, const FacePoints& at0, const Face& face1,
                                  const FacePoints& at1, bool carries_tension) {
  const bool open = (face0.energy == 0.0) | (face1.energy == 0.0);
  const double both = 0.5 * (face0.energy + face1.energy) -
                      0.25 * (work_of(face0.force, at1, at0) - work_of(face1.force, at1, at0));
  return carries_tension ? both : open ? 0.0 : positive_part(both);
}

/// What the energy of a face follows from beside its corners: its shear springs at n - 1 (stiffness
/// of each end, N/m; slip of the ends, m), and whether it stores energy at n.
struct SpringsOfFace {
  double spring;
  FaceEnds slip;
  bool stores;
};
/// Energy that a face stores between steps n - 1 and n, normal and shear, J; normal: that of the
/// pressure, stored_between(); moved: the motion of its ends along it in the step, m.
EDDA_INLINE double face_energy(double normal, const SpringsOfFace& old, FaceEnds moved,
                               bool carries_tension) {
  const FaceEnds had = old.slip;
  const bool slips = (old.spring > 0.0) & ((had.a != 0.0) | (had.b != 0.0));
  const double shear =
      slips ? old.spring * (had.a * (had.a + moved.a) + had.b * (had.b + moved.b)) : 0.0;
  const bool counts = old.stores | carries_tension | slips;
  return counts ? normal + 0.5 * shear : 0.0;
}

/// stored_between() of face k, J.
double normal_energy(const FaceSet& faces, const BlockSet& blocks, const Pose& pose, std::size_t k);

}  // namespace edda
