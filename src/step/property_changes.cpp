// Joints and rock with other properties, between two steps.
#include "blocks/property_change.hpp"
#include "contacts/face_law_change.hpp"
#include "step/changes.hpp"
#include "step/contact_search.hpp"
#include "step/energy_balance.hpp"
#include "step/force_jumps.hpp"
#include "step/simulation.hpp"
#include "step/tile_step.hpp"

namespace edda {

void change_properties(Simulation& sim, const PropertyChange& change) {
  const AsExternalWork work(sim);
  const CopyOnWrite<Scene> old = sim.scene;
  const std::vector<std::uint8_t> changed =
      change_properties(sim.scene.edit().blocks, old->model, change);
  if (changed.empty()) return;
  const BodyVectors before = forces_now(sim);
  change_faces(sim, [&](FaceSet& faces, FaceStates& states) {
    change_laws(faces, states, old->blocks, sim.scene->blocks, sim.motion.pose, sim.motion.laws,
                changed);
  });
  reevaluate_faces(sim);
  note_jump(sim, before);
}

}  // namespace edda
