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
  Loads& loads = sim.attached.loads;
  if (!sim.scene->model.flow) return;
  if (loads.flow != JointFlow::steady) {
    put_flow(sim.attached.joint_water, flow_scene(sim),
             waters_at(sim.scene->model, loads, sim.motion.state.time), loads);
    return;
  }
  if (!loads.gradual.at) sim.attached.joint_water.before.clear();
  flow_through(sim.attached.joint_water, flow_scene(sim),
               waters_at(sim.scene->model, loads, sim.motion.state.time), loads);
}

void begin_timed_flow(Simulation& sim) {
  JointWater& water = sim.attached.joint_water;
  water.before.clear();
  take_contents(water, flow_scene(sim),
                waters_at(sim.scene->model, sim.attached.loads, sim.motion.state.time));
  sim.attached.loads.flow = JointFlow::timed;
}

void flow_within_step(Simulation& sim, double h_old) {
  Loads& loads = sim.attached.loads;
  const State& state = sim.motion.state;
  const BlockSet& blocks = sim.scene->blocks;
  const SteppedValue& time = loads.slow.flow;
  const WaterInStep step{sim.motion.masses, 0.5 * (h_old + state.step) * state.step,
                         time.at(state.time, loads.gradual) - time.before};
  const LoadsNow now = waters_at(sim.scene->model, loads, state.time);
  const std::vector<CornerForce> more =
      flow_in_step(sim.attached.joint_water, flow_scene(sim), now, step, loads);
  for (auto f = more.begin(); f != more.end();) {
    BlockForces on{blocks, f->block};
    for (; f != more.end() && f->block == on.block; ++f) on.at_corner(f->corner, f->force);
    add(on.sum, blocks, sim.motion.forces, on.block);
  }
}

}  // namespace edda
