// The paper's model: steps of the leapfrog, contacts of vertices on edges (paper/points.hpp).
#include <algorithm>

#include "contacts/find_faces.hpp"
#include "step/contact_search.hpp"
#include "step/leapfrog_step.hpp"
#include "step/simulation.hpp"
#include "step/step.hpp"

namespace edda {
namespace {

void sum_contacts(Simulation& sim) {
  sum_points(sim.motion.on_contacts, sim.scene->blocks, sim.point_contacts, sim.motion.pose);
}

void search_points(Simulation& sim, const Reach& reach) {
  const BlockSet& blocks = sim.scene->blocks;
  Motion& motion = sim.motion;
  find_points(sim.point_contacts, blocks, motion.state, motion.pose, motion.laws, reach.apart);
  complete_faces(motion.contacts, blocks, motion.laws);  // of which there are none
  note_list(motion.contacts, motion.pose, reach);
  sum_contacts(sim);
}

/// Energies need the state a step before, which is the same at rest.
void begin_points(Simulation& sim) {
  for (int n = 0; n < 2; ++n)
    move_points(sim.point_contacts, sim.scene->blocks, sim.motion.pose, sim.motion.laws);
  sum_contacts(sim);
}

void leave_as_they_are(Simulation&) {}

void evaluate_points(Simulation& sim, double) {
  move_points(sim.point_contacts, sim.scene->blocks, sim.motion.pose, sim.motion.laws);
  sum_contacts(sim);
  sim.accounts.penetration = sim.point_contacts.deepest;
}

std::optional<Failure> step_paper(Simulation& sim) {
  return leap(sim, {.begin = leave_as_they_are, .evaluate = evaluate_points});
}

/// The smaller of the bounds with the contacts that are near, and with faces all round.
void set_paper_limit(Simulation& sim) {
  scale_masses(sim);
  StiffnessInputs inputs = stiffness_inputs(sim);
  StepBound bound = step_bound(inputs, &sim.control.step_cache);
  inputs.near = &sim.point_contacts.springs;
  const StepBound near = step_bound(inputs);
  limit_leap(sim, near.critical_step < bound.critical_step ? near : bound);
}

std::optional<Failure> deep_overlap(const Simulation& sim) {
  const BlockSet& b = sim.scene->blocks;
  const PointSet& c = sim.point_contacts;
  const Pose& pose = sim.motion.pose;
  for (std::size_t k = 0; k < c.size(); ++k) {
    const Id i = b.vertex_block[c.vertex[k]], j = b.vertex_block[c.edge[k]];
    const double depth = gap_of(c, b, pose, k).depth;
    if (c.closed[k] > 0.0 && depth > std::min(b.inradius[i], b.inradius[j]))
      return overlap_failure(i, j, depth, at(pose.x, pose.y, c.vertex[k]), b, sim.motion.state,
                             step_in_use(sim));
  }
  return std::nullopt;
}

Stepper with_points() {
  Stepper stepper = leapfrog_stepper;
  stepper.set_limit = set_paper_limit;
  stepper.step = step_paper;
  stepper.search = search_points;
  stepper.begin_contacts = begin_points;
  stepper.sum_contacts = sum_contacts;
  stepper.deep_overlap = deep_overlap;
  return stepper;
}

}  // namespace

const Stepper paper_stepper = with_points();

}  // namespace edda
