// Excavation between two steps.
#include <algorithm>
#include <set>

#include "contacts/face_reading.hpp"
#include "step/changes.hpp"
#include "step/contact_search.hpp"
#include "step/energy_balance.hpp"
#include "step/simulation.hpp"
#include "step/tile_step.hpp"

namespace edda {
namespace {

/// Forces of the rock that is excavated on the rock that stays, from the contacts as they are now.
std::vector<WallForce> wall_forces(const Simulation& sim, const std::vector<std::uint8_t>& goes) {
  const BlockSet& b = sim.scene->blocks;
  const FaceSet& f = sim.motion.contacts;
  std::vector<WallForce> walls;
  for (std::size_t k = 0; k < f.size(); ++k) {
    const Id i = block_of_edge(b, f, k), j = block_of_facing(b, f, k);
    if (goes[i] == goes[j] || !is_closed_now(sim, k)) continue;
    const CornerForces on = face_row(sim, k).force;
    const auto keep = [&](Id edge, Vec2 start, Vec2 end, Id of) {
      walls.push_back({edge, start, b.opening[of]});
      walls.push_back({b.next[edge], end, b.opening[of]});
    };
    if (goes[j] != 0 && !b.fixed[i]) keep(f.edge[k], on.p1, on.p2, j);
    if (goes[i] != 0 && !b.fixed[j]) keep(f.facing[k], on.q1, on.q2, i);
  }
  return walls;
}

/// The list of contacts, and what they carry, without those of blocks that have been removed.
void search_without_removed(Simulation& sim) {
  search(sim, {sim.motion.contacts.reach, sim.motion.contacts.reach_behind});
  sum_contact_forces(sim);
}

}  // namespace

bool set_aside(Simulation& sim, const Failure& failure) {
  constexpr double most = 0.1;  // of the area of all blocks
  if (!failure.of_block) return false;
  const BlockSet& blocks = sim.scene->blocks;
  State& state = sim.motion.state;
  double all = 0.0, out = blocks.area[failure.block];
  for (std::size_t i = 0; i < blocks.size(); ++i) all += state.alive[i] != 0 ? blocks.area[i] : 0.0;
  for (const SetAside& before : sim.accounts.set_aside) {
    out += blocks.area[before.block];
    all += blocks.area[before.block];
  }
  if (out > most * all) return false;
  const AsExternalWork work(sim);
  state.alive[failure.block] = 0;
  set_zero(blocks, state.velocity, failure.block);
  search_without_removed(sim);
  sim.accounts.set_aside.push_back({failure.block, failure.time, failure.place});
  return true;
}

void excavate(Simulation& sim, const std::vector<Index>& openings) {
  const BlockSet& blocks = sim.scene->blocks;
  State& state = sim.motion.state;
  const AsExternalWork work(sim);
  std::vector<std::uint8_t> goes(blocks.size(), 0);
  std::set<Index> going;  // openings excavated before keep what they have released
  for (std::size_t i = 0; i < blocks.opening.size(); ++i) {
    const bool named =
        std::find(openings.begin(), openings.end(), blocks.opening[i]) != openings.end();
    goes[i] = named && state.alive[i] != 0 ? 1 : 0;
    if (goes[i] != 0) going.insert(blocks.opening[i]);
  }
  const std::vector<WallForce> on_walls = wall_forces(sim, goes);
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    if (goes[i] == 0) continue;
    state.alive[i] = 0;
    set_zero(blocks, state.velocity, i);
  }
  for (const Index o : going)
    sim.attached.loads.remaining[static_cast<std::size_t>(o)] = {0.0, 1.0, state.time};
  keep(sim, on_walls);
  search_without_removed(sim);
}

void relax(Simulation& sim, Index opening, double part) {
  sim.attached.loads.remaining[static_cast<std::size_t>(opening)].change(1.0 - part,
                                                                         sim.motion.state.time);
}

}  // namespace edda
