#include "step/changes.hpp"

#include <algorithm>
#include <limits>

#include "contacts/face_bonds.hpp"
#include "contacts/face_law_change.hpp"
#include "contacts/strength.hpp"
#include "step/contact_search.hpp"
#include "step/energy_balance.hpp"
#include "step/force_jumps.hpp"
#include "step/law_progress.hpp"
#include "step/simulation.hpp"
#include "step/tile_step.hpp"

namespace edda {

void change_damping(Simulation& sim, const Damping& now, bool carry_velocities) {
  Damping& damping = sim.motion.damping;
  damping = now;
  sim.motion.dynamic = carry_velocities;
  set_viscosity(sim);
  change_faces(sim, [&](FaceSet& faces, FaceStates&) {
    set_face_dashpots(faces, sim.motion.laws, damping.contact);
  });
  sim.control.limit = std::numeric_limits<double>::infinity();
  set_limit(sim);
}

namespace {

bool in_force(const Simulation& sim, const std::vector<double>& factors) {
  const LawTable& laws = sim.motion.laws;
  return factors == laws.divided_by && progress_now(sim) == laws.progress;
}

}  // namespace

void set_strength_factors(Simulation& sim, const std::vector<double>& factors) {
  if (in_force(sim, factors)) return;
  const BodyVectors before = forces_now(sim);
  take_strength_factors(sim, factors);
  note_jump(sim, before);
}

void take_strength_factors(Simulation& sim, const std::vector<double>& factors) {
  if (in_force(sim, factors)) return;
  LawTable& laws = sim.motion.laws;
  LawTable divided = divided_laws(sim.scene->model, factors, progress_now(sim));
  const bool stiffness = !is_as_stiff(laws, divided);
  std::optional<AsExternalWork> work;
  if (stiffness) work.emplace(sim);
  change_faces(sim, [&](FaceSet& faces, FaceStates& states) {
    if (divided.progress != laws.progress)
      follow_laws(faces, states, sim.scene->blocks, sim.motion.pose, laws, divided);
    put_in_force(faces, states, divided);
  });
  laws = std::move(divided);
  sim.motion.zones.material = divided_strength(sim.scene->zones, laws.rock_divided_by());
  reevaluate_faces(sim);
  if (stiffness) set_limit(sim);
}

void set_strength_factor(Simulation& sim, double factor) {
  set_strength_factors(sim, std::vector<double>(sim.motion.laws.rows.size(), factor));
}

void reset_displacements(Simulation& sim) {
  sim.motion.state.reference = sim.motion.state.position;
}

}  // namespace edda
