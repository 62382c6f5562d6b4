// Blocks that a test moves by hand, step by step, and what their faces make of it.
#pragma once

#include "attachments/drawn_blocks.hpp"
#include "blocks/pose.hpp"
#include "contacts/face_bonds.hpp"
#include "contacts/face_energy.hpp"
#include "contacts/face_reading.hpp"
#include "contacts/find_faces.hpp"
#include "contacts/joint_laws.hpp"
#include "contacts/place_faces.hpp"

namespace edda::test {

/// Where a block is: moved from where it was drawn, and turned about its centroid as drawn.
struct Place {
  Vec2 moved;
  double turned = 0.0;
};

struct MovedBlocks : DrawnBlocks {
  State state;
  Pose pose;
  LawTable laws;
  FaceSet faces;
  double step = 1e-4;
  double work = 0.0;  ///< J, done on the blocks by the forces of faces, in the leapfrog's terms

  /// Blocks where they are drawn, at rest; all have the model's first joint.
  void start(double reach = 0.05) {
    build_all();
    model.contact.joint = 0;
    blocks.thickness = model.thickness;
    laws = build_laws(model);
    state = initial_state(blocks, set);
    pose = {blocks.vertex_x, blocks.vertex_y, blocks.vertex_x,
            blocks.vertex_y, blocks.vertex_x, blocks.vertex_y};
    find_faces(faces, blocks, state, pose, laws, reach);
    set_face_dashpots(faces, laws, 0.0);
  }
  /// Block i is there from now on, and has been.
  void put(std::size_t i, const Place& place) {
    place_in(i, place);
    pose.x1 = pose.x2 = pose.x;
    pose.y1 = pose.y2 = pose.y;
  }
  void settle() {
    place_faces(faces, blocks, pose, laws, step);
    stand_still(faces);
  }
  /// The same, and faces as they are after a while.
  void rest(std::size_t i, const Place& place) {
    put(i, place);
    settle();
  }
  /// One step, at whose end block i is there.
  void go(std::size_t i, const Place& place) {
    pose.x2 = pose.x1;
    pose.y2 = pose.y1;
    pose.x1 = pose.x;
    pose.y1 = pose.y;
    place_in(i, place);
    for (std::size_t k = 0; k < faces.size(); ++k) {
      work += 0.5 * work_of(corner_forces(faces, k), face_points(faces, pose.x, pose.y, k),
                            face_points(faces, pose.x2, pose.y2, k));
    }
    next_step(faces);
    if (laws.any_changes) update_joint_laws(faces, blocks, pose, laws);
    place_faces(faces, blocks, pose, laws, step);
  }
  /// What faces store and have taken, J.
  double stored() const {
    double sum = 0.0;
    for (std::size_t k = 0; k < faces.size(); ++k) sum += face_energy(faces, blocks, pose, k);
    return sum;
  }
  static double sum(const ChunkColumn& column) {
    double all = 0.0;
    for (const double value : column.values()) all += value;
    return all;
  }
  double friction() const { return sum(faces.friction_work); }
  double damping() const { return sum(faces.damping_work) + sum(faces.now.damping_due); }
  double fracture() const { return sum(faces.fracture_work); }
  double transfer() const { return sum(faces.transfer); }
  double books() const { return stored() + friction() + damping() + fracture() + transfer(); }
  /// Of faces on block i, N.
  Vec2 force_on(std::size_t i) const {
    Vec2 force;
    for (std::size_t k = 0; k < faces.size(); ++k) {
      if (block_of_facing(blocks, faces, k) == i) force += force_on_facing(faces, k);
      if (block_of_edge(blocks, faces, k) == i) force -= force_on_facing(faces, k);
    }
    return force;
  }
  /// The face that carries most.
  std::size_t main_face() const {
    const auto e = faces.now.energy.values();
    return static_cast<std::size_t>(std::max_element(e.begin(), e.end()) - e.begin());
  }

 private:
  void place_in(std::size_t i, const Place& place) {
    const Vec2 middle{blocks.centroid_x[i], blocks.centroid_y[i]};
    for (Id v = blocks.vertex_begin[i]; v < blocks.vertex_begin[i + 1]; ++v) {
      const Vec2 p = middle + place.moved + rotated(blocks.vertex(v) - middle, place.turned);
      pose.x[v] = p.x;
      pose.y[v] = p.y;
    }
  }
};

/// A square of 1 m, block 1, in the middle of a held base whose top is 3 m long.
inline MovedBlocks square_on_base(const JointLaw& joint, double thickness = 1.0) {
  MovedBlocks m;
  m.model.thickness = thickness;
  m.model.joints = {joint};
  m.model.contact.normal_stiffness = 1e9;
  m.model.contact.shear_stiffness = 0.5e9;
  m.add({{-1, -1}, {2, -1}, {2, 0}, {-1, 0}}, true);
  m.add({{0, 0}, {1, 0}, {1, 1}, {0, 1}});
  return m;
}

/// The same at rest, pressed into its base by `depth`, which is negative where it hangs above.
inline MovedBlocks pressed_square(const JointLaw& joint, double depth, double thickness = 1.0) {
  MovedBlocks m = square_on_base(joint, thickness);
  m.start();
  m.rest(1, {{0.0, -depth}});
  return m;
}

inline JointLaw rough_joint(double friction_angle, double cohesion = 0.0, double tension = 0.0) {
  JointLaw joint;
  joint.name = "j";
  joint.peak = joint.residual = {friction_angle, cohesion, tension};
  return joint;
}

}  // namespace edda::test
