// Initial stress on boundaries and contacts at the start of a simulation.
#include "attachments/initial_forces.hpp"
#include "contacts/face_bonds.hpp"
#include "contacts/face_preload.hpp"
#include "step/changes.hpp"
#include "step/simulation.hpp"

namespace edda {

void load_boundaries_with_initial_stress(Simulation& sim) {
  const Model& model = sim.scene->model;
  const BlockSet& blocks = sim.scene->blocks;
  Loads& loads = sim.attached.loads;
  const StressField field(model, blocks.origin);
  const LoadsNow at_start = loads_at(model, loads, 0.0);
  const FaceForces faces(blocks, field, at_start);
  const std::vector<WallForce> wall_forces =
      supported_initial_stress(model, blocks, loads.intervals, faces);
  load_initial_stress(loads, model, blocks, faces);
  for (const WallForce& f : wall_forces) {
    loads.remaining[static_cast<std::size_t>(f.owner)] = {1.0, 1.0};
  }
  if (!wall_forces.empty()) keep(sim, wall_forces);
}

bool hold_walls_of_openings(Simulation& sim) {
  const Model& model = sim.scene->model;
  const BlockSet& blocks = sim.scene->blocks;
  if (!model.initial_stress || model.openings.empty()) return false;
  const StressField field(model, blocks.origin);
  const LoadsNow at_start = loads_at(model, sim.attached.loads, 0.0);
  const std::vector<WallForce> forces =
      initial_wall_forces(model, blocks, FaceForces(blocks, field, at_start));
  if (forces.empty()) return false;
  for (const WallForce& f : forces)
    sim.attached.loads.remaining[static_cast<std::size_t>(f.owner)] = {0.0, 1.0,
                                                                       sim.motion.state.time};
  keep(sim, forces);
  return true;
}

void load_contacts_with_initial_stress(Simulation& sim, FaceStates& states) {
  const Model& model = sim.scene->model;
  const BlockSet& blocks = sim.scene->blocks;
  FaceSet& contacts = sim.motion.contacts;
  const StressField field(model, blocks.origin);
  const LoadsNow at_start = loads_at(model, sim.attached.loads, 0.0);
  const FaceForces faces(blocks, field, at_start);
  const auto traction = [&](Id edge, double from, double to) { return faces.on(edge, {from, to}); };
  sim.motion.locked = initial_mode_forces(blocks, field);
  sim.accounts.initial.emplace();
  // Joints that the first stage glues are checked against their own strength when they are unglued.
  const bool glued = !model.stages.empty() && model.stages.front().joints == StageJoints::glued;
  sim.accounts.initial->joints =
      preload_faces(contacts, states, blocks, sim.motion.pose, sim.motion.laws, traction);
  if (glued) glue_faces(contacts, states);
}

}  // namespace edda
