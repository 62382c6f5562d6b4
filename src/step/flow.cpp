// Water in the joints of a simulation.
#include "contacts/activity.hpp"
#include "step/changes.hpp"
#include "step/simulation.hpp"

namespace edda {

void begin_flow(const Model& model, const BlockSet& blocks, Attached& attached) {
  Loads& loads = attached.loads;
  attached.joint_water.ground = flow_ground(model, blocks, std::move(loads.wet));
  loads.in_joints = model.waters.front().unit_weight * model.thickness;
  put_water(blocks, {}, loads);
}

namespace {

FlowScene flow_scene(const Simulation& sim) {
  const Scene& scene = *sim.scene;
  return {scene.model,     scene.blocks,        sim.motion.state,
          sim.motion.pose, sim.motion.contacts, sim.attached.loads.intervals};
}

}  // namespace

void start_flow(Simulation& sim) {
  if (!sim.scene->model.flow) return;
  FaceSet& faces = sim.motion.contacts;
  for (std::size_t k = 0; k < faces.size(); ++k)
    decide_activity(faces, sim.scene->blocks, sim.motion.pose, {false, false}, k);
  note_open_edges(flow_scene(sim), sim.attached.joint_water.ground);
  update_flow(sim);
}

void update_flow(Simulation& sim) {
  if (!sim.scene->model.flow) return;
  Loads& loads = sim.attached.loads;
  if (!loads.gradual.at) sim.attached.joint_water.before.clear();
  flow_through(sim.attached.joint_water, flow_scene(sim),
               waters_at(sim.scene->model, loads, sim.motion.state.time), loads);
}

}  // namespace edda
