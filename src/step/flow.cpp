// Water in the joints of a simulation.
#include "step/changes.hpp"
#include "step/simulation.hpp"

namespace edda {

void begin_flow(const Model& model, const BlockSet& blocks, Attached& attached) {
  Loads& loads = attached.loads;
  attached.joint_water.ground = flow_ground(model, blocks, std::move(loads.wet));
  loads.in_joints = model.waters.front().unit_weight * model.thickness;
  put_water(blocks, {}, loads);
}

void update_flow(Simulation& sim) {
  const Scene& scene = *sim.scene;
  if (!scene.model.flow) return;
  Loads& loads = sim.attached.loads;
  if (!loads.gradual.at) sim.attached.joint_water.before.clear();
  const LoadsNow now = waters_at(scene.model, loads, sim.motion.state.time);
  flow_through(sim.attached.joint_water,
               {scene.model, scene.blocks, sim.motion.state, sim.motion.pose, sim.motion.contacts},
               now, loads);
}

}  // namespace edda
