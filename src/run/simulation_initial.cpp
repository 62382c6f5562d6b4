// How a simulation takes up the stress that is in the ground at the start.
#include "attachments/initial_forces.hpp"
#include "contacts/preload.hpp"
#include "forces/contact_forces.hpp"
#include "run/initial_stress_report.hpp"

namespace edda {

/// Stress in the blocks, and what their outer faces feel of it, on the boundaries.
void Simulation::hold_boundaries() {
  const StressField field(model, blocks.origin);
  set_initial_stress(blocks, model, field);
  const LoadsNow at_start = loads_at(model, loads, 0.0);
  const FaceForces faces(blocks, field, at_start);
  hold_initial_stress(springs, model, blocks, faces);
  load_initial_stress(loads, model, blocks, faces);
}

/// What touches carries from the start: the initial stress of the blocks, where there is one.
void Simulation::close_contacts() {
  if (!model.initial_stress) {
    settle_contacts(contacts, blocks, pose, laws, 0, true, transitions_);
    return;
  }
  const StressField field(model, blocks.origin);
  const LoadsNow at_start = loads_at(model, loads, 0.0);
  const FaceForces faces(blocks, field, at_start);
  const auto traction = [&](Id edge, double from, double to) {
    return faces.on(edge, {from, to});
  };
  initial.emplace();
  initial->joints = preload_contacts(contacts, blocks, pose, laws, traction, transitions_);
  break_overloaded(contacts, blocks, laws);
  cut_preload(contacts);
  judge_initial_stress(*this);
}

}  // namespace edda
