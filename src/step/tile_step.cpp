#include "step/tile_step.hpp"

#include <omp.h>

#include <algorithm>

#include "contacts/face_bonds.hpp"
#include "contacts/find_faces.hpp"
#include "contacts/tile_decisions.hpp"
#include "contacts/tile_renewal.hpp"
#include "contacts/tile_rows.hpp"
#include "step/contact_search.hpp"
#include "step/face_switching.hpp"
#include "step/simulation.hpp"

namespace edda {
namespace {

/// The faces in the step to the present positions.
FacesInStep faces_in_step(Simulation& sim, double step, bool skips = true) {
  Motion& motion = sim.motion;
  return {motion.contacts,
          sim.motion.tiled,
          face_scene(sim),
          step,
          sim.control.last_displacement,
          motion.on_contacts,
          false,
          skips};
}

/// Blocks of a tile, at most. Threads that share a model have eight tiles each, or else tiles of
/// half the size, or still smaller ones in a model too small for two of these each.
std::size_t blocks_of_tile(const Simulation& sim) {
  constexpr std::size_t fewest = 24;
  const std::size_t most = sim.motion.tiled.most_blocks, blocks = sim.scene->blocks.size(),
                    threads = static_cast<std::size_t>(sim.motion.tiled.threads);
  if (threads == 1 || blocks >= 8 * threads * most) return most;
  return std::min((most + 1) / 2, std::max(fewest, blocks / (2 * threads) + 1));
}

}  // namespace

FaceSet& faces_of(Simulation& sim) {
  return sim.motion.contacts;
}

FaceStates take_faces(Simulation& sim) {
  Motion& motion = sim.motion;
  recall_work(motion.contacts, motion.tiled.tiles);
  return states_of(motion.contacts, motion.tiled.tiles, sim.scene->blocks, motion.pose);
}

void put_faces(Simulation& sim, const FaceStates& states) {
  Motion& motion = sim.motion;
  TiledFaces& own = motion.tiled;
  own.threads = std::max(own.threads, omp_get_max_threads());
  load_tiles(own, motion.contacts, states, sim.scene->blocks, motion.state, motion.pose,
             sim.attached.ground.moves, blocks_of_tile(sim));
}

void fit_tiles(Simulation& sim) {
  TiledFaces& own = sim.motion.tiled;
  own.threads = std::max(own.threads, omp_get_max_threads());
  if (own.blocks != blocks_of_tile(sim)) put_faces(sim, take_faces(sim));
}

void place_in_tiles(Simulation& sim) {
  Motion& motion = sim.motion;
  begin_step(motion.contacts, motion.tiled.tiles, sim.scene->blocks, motion.pose, motion.laws);
  FacesInStep step = faces_in_step(sim, motion.state.step);
  step.sweep();
  step.decide_and_evaluate(step.undecided());
}

void reevaluate_at_n(Simulation& sim, double step) {
  FacesInStep at_rest = faces_in_step(sim, step, false);
  at_rest.sweep();
  at_rest.decide_and_evaluate(at_rest.undecided());
}

void switch_in_tiles(Simulation& sim, const StepTaken& taken) {
  TiledFaces& own = sim.motion.tiled;
  FacesInStep in_step = faces_in_step(sim, sim.motion.state.step);
  const std::vector<Id> switching = in_step.found(lane_bits::switching, &SweepResult::switching);
  if (switching.empty()) return;
  own.corrects = true;
  correct_switching(sim.motion.contacts, own.tiles, in_step, taken, sim.accounts.open_close,
                    sim.leapfrog.switching, switching);
  own.corrects = false;
  own.pushed = sim.leapfrog.switching.pushed_by;
}

namespace {

/// Whether each face stores energy, [nf].
std::vector<std::uint8_t> faces_that_carry(const FaceTiles& t) {
  std::vector<std::uint8_t> carry(t.place.size(), 0);
  for (std::size_t k = 0; k < carry.size(); ++k)
    carry[k] = t.remembers(lane_bits::stored, k) ? 1 : 0;
  return carry;
}

}  // namespace

void search_in_tiles(Simulation& sim, const Reach& reach) {
  Motion& motion = sim.motion;
  TiledFaces& own = motion.tiled;
  FaceSet& faces = motion.contacts;
  const BlockSet& b = sim.scene->blocks;
  recall_work(faces, own.tiles);
  faces.dashpots = dashpots_work(own.tiles);
  const std::vector<Id> old_row =
      find_faces(faces, b, motion.state, motion.pose, motion.laws, reach, sim.control.near_edges,
                 faces_that_carry(own.tiles));
  set_face_dashpots(faces, motion.laws, motion.damping.contact);
  if (own.tiles.tiles.empty()) return put_faces(sim, FaceStates(faces.size()));
  renew_tiles(own.tiles, faces, b, motion.pose, old_row);
  own.pushed = 0.0;
  constexpr double worth = 0.15;  // of the faces, evaluated twice because neighbours have changed
  if (part_in_two_tiles(own.tiles) > own.in_two_tiles + worth) put_faces(sim, take_faces(sim));
}

void lose_faces(Simulation& sim) {
  FaceTiles& tiles = sim.motion.tiled.tiles;
  tiles = FaceTiles();
  sim.control.near_edges = NearEdges();
  tiles.place.assign(sim.motion.contacts.size(), {no_id, no_id});
}

}  // namespace edda
