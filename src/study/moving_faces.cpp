#include "study/moving_faces.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "contacts/evaluate_face.hpp"
#include "step/faces_now.hpp"

namespace edda {
namespace {

/// Direction in which face k slips at these positions: along the edge on which a corner of the
/// other presses.
Vec2 slip_direction(const Simulation& sim, const Pose& pose, std::size_t k) {
  const Face face = face_at(sim.motion.contacts, sim.scene->blocks, pose.x, pose.y, k);
  return unit(face.t + face.slope * outward_normal(face.t));
}

/// One end of a face: its position, and the relative displacement of its two points since then.
struct EndMoved {
  Vec2 place;
  double slip, opening;
  double apart;  ///< m, of the two points at the start
};
EndMoved end_moved(const Simulation& before, const Simulation& after, std::size_t k, double xi,
                   double eta) {
  const FaceSet& f = before.motion.contacts;
  const FacePoints p = face_points(f, before.motion.pose.x, before.motion.pose.y, k);
  const FacePoints q = face_points(f, after.motion.pose.x, after.motion.pose.y, k);
  const Vec2 t_was = slip_direction(before, before.motion.pose, k),
             t_is = slip_direction(before, after.motion.pose, k);
  const Vec2 was = from_point_of_e(p, xi, eta), is = from_point_of_e(q, xi, eta);
  return {(1.0 - xi) * p.p1 + xi * p.p2 + before.scene->blocks.origin,
          std::abs(dot(is, t_is) - dot(was, t_was)),
          dot(is, outward_normal(t_is)) - dot(was, outward_normal(t_was)), norm(was)};
}

/// The largest motion at the ends whose points are this near each other: edges that have passed
/// each other have none.
EndMoved largest_of(const EndMoved (&ends)[2], double near) {
  EndMoved most{{}, 0.0, 0.0, std::min(ends[0].apart, ends[1].apart)};
  for (const EndMoved& end : ends) {
    if (end.apart > near) continue;
    most.slip = std::max(most.slip, end.slip);
    most.opening = std::max(most.opening, end.opening);
  }
  return most;
}

}  // namespace

void collect_joints(SeenJoints& joints, const Simulation& before, const Simulation& after,
                    const std::vector<double>& rotation, double least) {
  const FaceSet& f = before.motion.contacts;
  const BlockSet& b = before.scene->blocks;
  std::map<std::pair<Id, Id>, double> largest;
  for (std::size_t k = 0; k < f.size(); ++k) {
    double& force = largest[blocks_of_face(b, f, k)];
    force = std::max(force, normal_force(face_row(before, k)));
  }
  constexpr double counts = 1e-3;  // of the face with the largest force between the two blocks
  for (std::size_t k = 0; k < f.size(); ++k) {
    const auto [i, j] = blocks_of_face(b, f, k);
    const FaceRow row = face_row(before, k);
    const FaceFields& m = row.state;
    const bool along = f.acts(k) && m.cohesive > 0.0 && closure_of(row) > -least;
    if (!along && !(normal_force(row) > counts * largest[{i, j}])) continue;
    const double length = std::min(b.edge_length[f.edge[k]], b.edge_length[f.facing[k]]);
    const double turning = std::abs(rotation[i] - rotation[j]) * length;
    const EndMoved ends[2] = {end_moved(before, after, k, m.xi_a, m.eta_a),
                              end_moved(before, after, k, m.xi_b, m.eta_b)};
    const double near = 2.0 * least + 1e-3 * length;
    const EndMoved most = largest_of(ends, near);
    if (most.apart > near || std::max({most.slip, most.opening, turning}) < least) continue;
    JointData& seen = joints[{i, j, f.law[k]}];
    MovingJoint& joint = seen.joint;
    for (const EndMoved& end : ends) {
      if (end.apart > near) continue;
      if (std::max(end.slip, end.opening) >= std::max(joint.slip, joint.opening)) {
        joint.place = end.place;
        joint.table = b.table_of(f.edge[k], f.facing[k]);
      }
      joint.slip = std::max(joint.slip, end.slip);
      joint.opening = std::max(joint.opening, end.opening);
      if (end.opening < seen.least_opening) {
        seen.least_opening = end.opening;
        seen.hinge = end.place;
      }
    }
    const FacePoints was = face_points(f, before.motion.pose.x, before.motion.pose.y, k);
    const FacePoints is = face_points(f, after.motion.pose.x, after.motion.pose.y, k);
    const auto carried = [&](double xi) {
      return (1.0 - xi) * (is.p1 - was.p1) + xi * (is.p2 - was.p2);
    };
    if (norm(ends[1].place - ends[0].place) > 1e-3 * length) {
      joint.stretches.push_back({ends[0].place, ends[1].place, carried(m.xi_a), carried(m.xi_b)});
    }
    joint.block_i = i;
    joint.block_j = j;
    joint.law = f.law[k];
    joint.joint = f.law[k] < before.scene->model.joints.size()
                      ? std::string_view(before.scene->model.joints[f.law[k]].name)
                      : std::string_view("glued");
    joint.turning = std::max(joint.turning, turning);
  }
}

}  // namespace edda
