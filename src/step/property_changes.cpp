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
namespace {

std::vector<std::uint8_t> linings_there(const Simulation& sim) {
  const BlockSet& b = sim.scene->blocks;
  std::vector<std::uint8_t> there(sim.scene->model.linings.size(), 0);
  for (std::size_t i = 0; i < b.size(); ++i) {
    if (b.is_lining(i) && sim.motion.state.alive[i] != 0)
      there[static_cast<std::size_t>(b.lining[i])] = 1;
  }
  return there;
}

/// Gives the linings the elasticity and strength of their materials where these are others than
/// before, [nb], and returns them.
std::vector<std::size_t> change_linings(const std::vector<Index>& before, Scene& scene) {
  std::vector<std::size_t> changed;
  const BlockSet& b = scene.blocks;
  for (std::size_t i = 0; i < b.size(); ++i) {
    if (!b.is_lining(i) || b.material[i] == before[i]) continue;
    change_lining(scene.zones, scene.model, b, i);
    changed.push_back(i);
  }
  return changed;
}

}  // namespace

void repeat_change(Scene& scene, const PropertyChange& change,
                   const std::vector<std::uint8_t>& linings) {
  const std::vector<Index> before = scene.blocks.material;
  change_properties(scene.blocks, scene.model, change, linings);
  change_linings(before, scene);
}

void change_properties(Simulation& sim, const PropertyChange& change) {
  const AsExternalWork work(sim);
  const CopyOnWrite<Scene> old = sim.scene;
  const std::vector<std::uint8_t> changed =
      change_properties(sim.scene.edit().blocks, old->model, change, linings_there(sim));
  if (changed.empty()) return;
  const BodyVectors before = forces_now(sim);
  for (const std::size_t i : change_linings(old->blocks.material, sim.scene.edit()))
    carry_on(old->zones, sim.scene->zones, sim.scene->blocks, sim.motion.state, i,
             sim.motion.zones);
  change_faces(sim, [&](FaceSet& faces, FaceStates& states) {
    change_laws(faces, states, old->blocks, sim.scene->blocks, sim.motion.pose, sim.motion.laws,
                changed);
  });
  reevaluate_faces(sim);
  note_jump(sim, before);
}

}  // namespace edda
