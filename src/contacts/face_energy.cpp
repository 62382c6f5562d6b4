#include "contacts/face_energy.hpp"

#include <algorithm>
#include <array>

#include "contacts/evaluate_face.hpp"

namespace edda {
namespace {

std::array<Vec2, 4> list(const FacePoints& p) {
  return {p.p1, p.p2, p.q1, p.q2};
}
std::array<Vec2, 4> list(const CornerForces& f) {
  return {f.p1, f.p2, f.q1, f.q2};
}

/// normal_energy() with the face at n given.
double normal_energy_to(const Face& face, const FaceSet& c, const BlockSet& b, const Pose& pose,
                        std::size_t k) {
  return stored_between(face_at(c, b, pose.x1, pose.y1, k), face_points(c, pose.x1, pose.y1, k),
                        face, face_points(c, pose.x, pose.y, k), c.carries_tension(k));
}

}  // namespace

double work_of(const CornerForces& force, const FacePoints& to, const FacePoints& from) {
  const auto f = list(force), x = list(to), y = list(from);
  double sum = 0.0;
  for (std::size_t k = 0; k < 4; ++k) sum += dot(f[k], x[k] - y[k]);
  return sum;
}

double stored_between(const Face& face0, const FacePoints& at0, const Face& face1,
                      const FacePoints& at1, bool carries_tension) {
  const bool open = face0.energy == 0.0 || face1.energy == 0.0;
  if (open && !carries_tension) return 0.0;
  const double both = 0.5 * (face0.energy + face1.energy) -
                      0.25 * (work_of(face0.force, at1, at0) - work_of(face1.force, at1, at0));
  return carries_tension ? both : std::max(both, 0.0);
}

double normal_energy(const FaceSet& c, const BlockSet& b, const Pose& pose, std::size_t k) {
  return normal_energy_to(face_at(c, b, pose.x, pose.y, k), c, b, pose, k);
}

double face_energy(const FaceSet& c, const BlockSet& b, const Pose& pose, const SpringsOfFace& old,
                   const Face& face, std::size_t k) {
  const FaceEnds had = old.slip;
  const bool slips = old.have_slip();
  const bool open = !old.stores && !c.carries_tension(k);
  if (open && !slips) return 0.0;
  double shear = 0.0;
  if (slips) {
    const FaceEnds slip =
        slip_of(c, face, face_points(c, pose.x, pose.y, k), face_points(c, pose.x1, pose.y1, k), k);
    shear = old.spring * (had.a * (had.a + slip.a) + had.b * (had.b + slip.b));
  }
  return normal_energy_to(face, c, b, pose, k) + 0.5 * shear;
}

}  // namespace edda
