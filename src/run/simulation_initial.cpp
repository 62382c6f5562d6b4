// How a simulation takes up the stress that is in the ground at the start.
#include "attachments/initial_forces.hpp"
#include "contacts/face_bonds.hpp"
#include "contacts/face_preload.hpp"
#include "contacts/place_faces.hpp"
#include "run/initial_stress_report.hpp"

namespace edda {

/// Stress in the blocks, and what their outer faces feel of it, on the boundaries.
void Simulation::hold_boundaries() {
  const StressField field(model, blocks.origin);
  set_initial_stress(blocks, model, field);
  const LoadsNow at_start = loads_at(model, loads, 0.0);
  const FaceForces faces(blocks, field, at_start);
  const std::vector<KeptForce> borne = held_initial_stress(model, blocks, loads.spells, faces);
  load_initial_stress(loads, model, blocks, faces);
  for (const KeptForce& f : borne) {
    loads.held[static_cast<std::size_t>(f.keeper)] = {1.0, 1.0};
  }
  if (!borne.empty()) keep(borne);
}

/// What touches carries from the start: the initial stress of the blocks, where there is one.
void Simulation::close_contacts() {
  if (!model.initial_stress) return place_faces(contacts, blocks, pose, laws, 1.0);
  const StressField field(model, blocks.origin);
  const LoadsNow at_start = loads_at(model, loads, 0.0);
  const FaceForces faces(blocks, field, at_start);
  const auto traction = [&](Id edge, double from, double to) { return faces.on(edge, {from, to}); };
  initial.emplace();
  // What a first stage glues has its say when it is unglued.
  const bool glued = !model.stages.empty() && model.stages.front().joints == StageJoints::glued;
  initial->joints = preload_faces(contacts, blocks, pose, laws, traction);
  if (glued) glue_faces(contacts);
  place_faces(contacts, blocks, pose, laws, 1.0);
  judge_initial_stress(*this);
}

}  // namespace edda
