// The list of possible contacts, and when it is renewed.
#include "step/contact_search.hpp"

#include <algorithm>
#include <limits>

#include "base/parallel.hpp"
#include "contacts/approach.hpp"
#include "contacts/evaluate_face.hpp"
#include "contacts/face_bonds.hpp"
#include "contacts/face_reading.hpp"
#include "contacts/tile_rows.hpp"
#include "contacts/tile_trials.hpp"
#include "step/changes.hpp"
#include "step/faces_now.hpp"
#include "step/simulation.hpp"
#include "step/step.hpp"
#include "step/tile_step.hpp"

namespace edda {

void place_all(Simulation& sim) {
  const BlockSet& blocks = sim.scene->blocks;
  State& state = sim.motion.state;
  Pose& pose = sim.motion.pose;
  parallel_for(blocks.size(), [&](std::size_t i) {
    if (state.alive[i]) place_vertices(blocks, state.position, i, pose.x, pose.y);
  });
}

void search(Simulation& sim, const Reach& reach) {
  sim.stepper->search(sim, reach);
}

void sum_contact_forces(Simulation& sim) {
  sim.stepper->sum_contacts(sim);
}

/// Faces at the start: bonds, and the forces of the initial stress where there is one.
void begin_faces(Simulation& sim) {
  Motion& motion = sim.motion;
  FaceSet& faces = motion.contacts;
  FaceTiles& tiles = motion.tiled.tiles;
  FaceStates states(faces.size());
  bond_faces(faces, states, sim.scene->blocks, motion.pose, motion.laws);
  if (sim.scene->model.initial_stress) load_contacts_with_initial_stress(sim, states);
  put_faces(sim, states);
  reevaluate_at_n(sim, 1.0);
  end_at_rest(faces, tiles, sim.scene->blocks, motion.pose);
  for (auto* work : {&faces.friction_work, &faces.transfer}) work->fill(0.0);
  keep_trial(tiles, faces);
}

FaceScene face_scene(const Simulation& sim) {
  return {sim.scene->blocks, sim.motion.masses, sim.motion.pose, sim.motion.laws};
}

void sum_face_forces(Simulation& sim) {
  const Motion& motion = sim.motion;
  const BlockSet& b = sim.scene->blocks;
  sum_faces(sim.motion.on_contacts, b, motion.contacts,
            corner_forces(motion.contacts, motion.tiled.tiles, b, motion.pose));
}

std::optional<Failure> deep_overlap_of_faces(const Simulation& sim) {
  const BlockSet& b = sim.scene->blocks;
  const DeepestNow deepest = deepest_now(sim, 1.0);
  if (deepest.ratio == 0.0) return std::nullopt;
  const FaceSet& c = sim.motion.contacts;
  return overlap_failure(block_of_edge(b, c, deepest.face), block_of_facing(b, c, deepest.face),
                         deepest.depth, deepest.place, b, sim.motion.state, step_in_use(sim));
}

void reevaluate_faces(Simulation& sim) {
  if (sim.control.step_before > 0.0) {
    reevaluate_at_n(sim, sim.control.step_before);
    sum_contact_forces(sim);
  }
}

namespace {

/// Upper bound of the overlap of edges that lie behind each other, m: blocks that penetrate by d
/// overlap by d/sin(alpha) along the edges beside a corner alpha, 2 d for 30 degrees and more.
double overlap_of_next_edges(const Simulation& sim) {
  constexpr double per_sine = 2.0;
  return per_sine * sim.accounts.penetration;
}

}  // namespace

/// With room for penetration that grows before the next list.
Reach next_reach(const Simulation& sim) {
  const double reach = std::max(sim.scene->base_reach, 20.0 * sim.control.last_displacement);
  return {reach, std::max(0.25 * reach, 1.5 * overlap_of_next_edges(sim))};
}

namespace {

bool list_is_due(Simulation& sim) {
  FaceSet& contacts = sim.motion.contacts;
  StepControl& control = sim.control;
  // What two vertices may approach each other by before the next check, m.
  const double ahead = 2.0 * sim.stepper->ahead(sim);
  contacts.travel += 2.0 * control.last_displacement;
  const bool deeper = overlap_of_next_edges(sim) > contacts.reach_behind;
  if (!deeper && contacts.travel + ahead <= contacts.reach) return false;
  // The sum of displacements is an upper bound; the positions decide.
  contacts.travel = largest_approach(control.neighbours, sim.scene->blocks, sim.motion.state,
                                     sim.motion.pose, origin_of(contacts));
  if (!(contacts.travel <= 200.0 * (contacts.reach + sim.scene->displacement_limit))) {
    control.last_displacement = std::numeric_limits<double>::infinity();  // inspect() ends the run
    return false;
  }
  return deeper || contacts.travel + sim.stepper->margin * ahead > contacts.reach;
}

}  // namespace

void search_if_due(Simulation& sim) {
  if (!list_is_due(sim)) return;
  search(sim, next_reach(sim));
  set_limit(sim);
}

}  // namespace edda
