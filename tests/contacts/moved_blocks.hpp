// Blocks that a test moves in a prescribed way, step by step, and the response of their faces.
#pragma once

#include <numeric>

#include "attachments/drawn_blocks.hpp"
#include "blocks/pose.hpp"
#include "contacts/face_bonds.hpp"
#include "contacts/face_energy.hpp"
#include "contacts/face_reading.hpp"
#include "contacts/find_faces.hpp"
#include "contacts/joint_laws.hpp"
#include "contacts/tile_decisions.hpp"
#include "contacts/tile_renewal.hpp"
#include "contacts/tile_sweep.hpp"
#include "contacts/tile_trials.hpp"
#include "contacts/tiled_faces.hpp"
#include "forces/nodal_forces.hpp"

namespace edda::test {

/// Position of a block: its displacement from the drawn position, and its rotation about the drawn
/// centroid.
struct Place {
  Vec2 moved;
  double turned = 0.0;
};

struct MovedBlocks : DrawnBlocks {
  State state;
  Pose pose;
  LawTable laws;
  FaceSet faces;     ///< after each step with the work accumulated until the step before
  TiledFaces tiled;  ///< their states; none sleeps
  NearEdges near;
  double step = 1e-4;
  double work = 0.0;  ///< J, done on the blocks by the forces of faces, in the leapfrog's terms

  /// Blocks as drawn, without velocity; all have the model's first joint.
  void start(double reach = 0.05) {
    build_all();
    model.contact.joint = 0;
    blocks.thickness = model.thickness;
    laws = build_laws(model);
    state = initial_state(blocks, set);
    pose = {blocks.vertex_x, blocks.vertex_y, blocks.vertex_x,
            blocks.vertex_y, blocks.vertex_x, blocks.vertex_y};
    tiled.sleep_part = 0.0;
    near = {};
    faces = {};
    find_faces(faces, blocks, state, pose, laws, {reach}, near, {});
    set_face_dashpots(faces, laws, 0.0);
    load(FaceStates(faces.size()));
  }
  void load(const FaceStates& states) {
    load_tiles(tiled, faces, states, blocks, state, pose, true, blocks.size());
  }
  FaceStates states() const { return states_of(faces, tiled.tiles, blocks, pose); }
  /// Changes the faces between two steps: change(faces, states).
  template <class Change>
  void change(Change change_faces) {
    FaceStates now = states();
    change_faces(faces, now);
    load(now);
  }
  void bond() {
    change([&](FaceSet& of, FaceStates& now) { bond_faces(of, now, blocks, pose, laws); });
  }
  /// A new list, with the reach.
  void search(double reach) {
    std::vector<std::uint8_t> carry;
    for (std::size_t k = 0; k < faces.size(); ++k)
      carry.push_back(tiled.tiles.remembers(lane_bits::stored, k) ? 1 : 0);
    recall_work(faces, tiled.tiles);
    const std::vector<Id> old = find_faces(faces, blocks, state, pose, laws, {reach}, near, carry);
    renew_tiles(tiled.tiles, faces, blocks, pose, old);
  }
  /// Places block i, now and at the steps before.
  void put(std::size_t i, const Place& place) {
    place_in(i, place);
    pose.x1 = pose.x2 = pose.x;
    pose.y1 = pose.y2 = pose.y;
  }
  FaceScene scene() const { return {blocks, masses, pose, laws}; }
  /// Evaluates the faces, which have the memory of the step before.
  void evaluate_from(double since) {
    BodyVectors on = zero_vectors(blocks);
    FacesInStep here(faces, tiled, scene(), since, 0.0, {on});
    here.sweep();
    here.decide_and_evaluate(here.undecided());
    recall_work(faces, tiled.tiles);
  }
  /// The same at rest: their memory of this step is also that of the one before.
  void evaluate() {
    evaluate_from(step);
    end_at_rest(faces, tiled.tiles, blocks, pose);
  }
  /// Places block i as put() does, and evaluates the faces there.
  void put_still(std::size_t i, const Place& place) {
    put(i, place);
    evaluate();
  }
  /// One step, at the end of which block i has this position.
  void go(std::size_t i, const Place& place) {
    std::vector<CornerForces> force;
    for (std::size_t k = 0; k < faces.size(); ++k) force.push_back(row(k).force);
    pose.x2 = pose.x1;
    pose.y2 = pose.y1;
    pose.x1 = pose.x;
    pose.y1 = pose.y;
    place_in(i, place);
    for (std::size_t k = 0; k < faces.size(); ++k) {
      work += 0.5 * work_of(force[k], face_points(faces, pose.x, pose.y, k),
                            face_points(faces, pose.x2, pose.y2, k));
    }
    begin_step(faces, tiled.tiles, blocks, pose, laws);
    evaluate_from(step);
  }
  /// Face k.
  FaceRow row(std::size_t k) const { return face_row(faces, tiled.tiles, blocks, pose, k); }
  FaceFields now(std::size_t k) const { return row(k).state; }
  FaceFields before(std::size_t k) const { return remembered(tiled.tiles, k); }
  /// Energy that faces store, J.
  double stored() const {
    std::vector<double> energy(faces.size(), 0.0), normal(faces.size(), 0.0);
    for (std::size_t tile = 0; tile < tiled.tiles.tiles.size(); ++tile)
      measure_tile(tiled.tiles, faces, blocks, pose, tile, energy, normal);
    return std::accumulate(energy.begin(), energy.end(), 0.0);
  }
  static double sum(const RowColumn& column) {
    double all = 0.0;
    for (const double value : column.values()) all += value;
    return all;
  }
  double friction() const { return sum(faces.friction_work); }
  double damping() const {
    double all = sum(faces.damping_work);
    for (std::size_t k = 0; k < faces.size(); ++k) all += now(k).damping_due;
    return all;
  }
  double fracture() const { return sum(faces.fracture_work); }
  double transfer() const { return sum(faces.transfer); }
  /// Energy that faces store and have dissipated, J.
  double balance() const { return stored() + friction() + damping() + fracture() + transfer(); }
  /// Resultant force of the faces on block i, N.
  Vec2 force_on(std::size_t i) const {
    Vec2 force;
    for (std::size_t k = 0; k < faces.size(); ++k) {
      if (block_of_facing(blocks, faces, k) == i) force += force_on_facing(row(k));
      if (block_of_edge(blocks, faces, k) == i) force -= force_on_facing(row(k));
    }
    return force;
  }
  /// The face that carries most.
  std::size_t main_face() const {
    std::size_t most = 0;
    for (std::size_t k = 0; k < faces.size(); ++k) {
      if (now(k).energy > now(most).energy) most = k;
    }
    return most;
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

/// A square of 1 m, block 1, in the middle of a fixed base whose top is 3 m long.
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

/// The same without velocity, with the penetration `depth` into its base, which is negative for a
/// gap.
inline MovedBlocks pressed_square(const JointLaw& joint, double depth, double thickness = 1.0) {
  MovedBlocks m = square_on_base(joint, thickness);
  m.start();
  m.put_still(1, {{0.0, -depth}});
  return m;
}

inline JointLaw rough_joint(double friction_angle, double cohesion = 0.0, double tension = 0.0) {
  JointLaw joint;
  joint.name = "j";
  joint.peak = joint.residual = {friction_angle, cohesion, tension};
  return joint;
}

}  // namespace edda::test
