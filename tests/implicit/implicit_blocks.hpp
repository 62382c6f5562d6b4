// A model of a few blocks, and all that a step of the implicit method needs.
#pragma once

#include "blocks/build_blocks.hpp"
#include "contacts/face_bonds.hpp"
#include "contacts/find_faces.hpp"
#include "contacts/tile_trials.hpp"
#include "cutting/build_polygons.hpp"
#include "implicit/assemble.hpp"
#include "model/read_model.hpp"

namespace edda::test {

struct ImplicitBlocks {
  Model model;
  PolygonSet polygons;
  BlockSet blocks;
  Masses masses;
  LawTable laws;
  BoundarySprings springs;
  State state;
  Pose pose;
  FaceSet contacts;
  TiledFaces tiled;
  BodyVectors forces;
  ImplicitSolver solver;
  ImplicitSettings settings;

  explicit ImplicitBlocks(const std::string& toml) {
    model = read_model_text(toml, "scene.toml", {}).value();
    polygons = build_polygons(model).value();
    blocks = build_blocks(model, polygons);
    masses = given_masses(blocks);
    laws = build_laws(model);
    springs = attach_boundaries(model, blocks).value();
    state = initial_state(blocks, polygons);
    forces = zero_vectors(blocks);
    pose.x = blocks.vertex_x;
    pose.y = blocks.vertex_y;
    place();
    pose.x1 = pose.x;
    pose.y1 = pose.y;
    settings.step = 2e-3;
    settings.damping.mass = 3.0;
    settings.contact_damping = 0.1;
    NearEdges near;
    find_faces(contacts, blocks, state, pose, laws, {0.05}, near, {});
    const auto load = [&](const FaceStates& states) {
      load_tiles(tiled, contacts, states, blocks, state, pose, false, blocks.size());
    };
    load(FaceStates(contacts.size()));
    FacesInStep at_rest(contacts, tiled, scene().faces(pose), 1.0, 0.0, {forces});
    at_rest.sweep();
    at_rest.decide_and_evaluate(at_rest.undecided());
    end_at_rest(contacts, tiled.tiles, blocks, pose);  // limits of friction
    const FaceStates states = states_of(contacts, tiled.tiles, blocks, pose);
    set_face_dashpots(contacts, laws, settings.contact_damping);
    load(states);
  }

  TrialFaces trial() { return {contacts, tiled}; }
  ImplicitScene scene() const { return {blocks, masses, laws, springs, {0.0, -9.81}}; }

  void place() {
    for (std::size_t i = 0; i < blocks.size(); ++i) {
      place_vertices(blocks, state.position, i, pose.x, pose.y);
    }
  }

  /// Begins a step where the blocks stand.
  void begin_step() {
    solver.start = state.position;
    set_pattern(solver, scene(), state, pose, trial());
    begin_springs(solver.springs, trial(), scene().faces(pose));
    solver.on_faces = zero_vectors(blocks);
    solver.moved = Eigen::VectorXd::Zero(solver.matrix.lines());
  }
  /// What is out of balance with D as it stands.
  Eigen::VectorXd residual() {
    for (std::size_t row = 0; row < solver.block_of.size(); ++row) {
      const Id i = solver.block_of[row];
      const BodyColumn start = column_of(blocks, solver.start, i);
      store(BodyColumn(start + solver.matrix.part(solver.moved, row)), blocks, state.position, i);
    }
    place();
    evaluate_springs(solver.springs, trial(), scene().faces(pose), settings.step, false,
                     solver.on_faces);
    gather_forces(forces, blocks, state, pose, solver.on_faces, springs, {0.0, -9.81});
    measure_residual(solver, scene(), settings, state, tiled, forces);
    return solver.residual;
  }
};

}  // namespace edda::test
