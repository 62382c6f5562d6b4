#include "contacts/face_energy.hpp"

#include "contacts/evaluate_face.hpp"

namespace edda {

double normal_energy(const FaceSet& c, const BlockSet& b, const Pose& pose, std::size_t k) {
  return stored_between(face_at(c, b, pose.x1, pose.y1, k), face_points(c, pose.x1, pose.y1, k),
                        face_at(c, b, pose.x, pose.y, k), face_points(c, pose.x, pose.y, k),
                        c.carries_tension(k));
}

}  // namespace edda
