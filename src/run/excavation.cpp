// Rock taken out between two steps.
#include <algorithm>
#include <set>

#include "contacts/face_reading.hpp"
#include "run/observe.hpp"
#include "run/simulation.hpp"

namespace edda {
namespace {

/// What rock that goes does to rock that stays, by the contacts as they are now.
std::vector<KeptForce> wall_forces(const BlockSet& b, const FaceSet& f,
                                   const std::vector<std::uint8_t>& goes) {
  std::vector<KeptForce> walls;
  for (std::size_t k = 0; k < f.size(); ++k) {
    const Id i = block_of_edge(b, f, k), j = block_of_facing(b, f, k);
    if (goes[i] == goes[j] || !is_closed(f, k)) continue;
    const CornerForces on = corner_forces(f, k);
    const auto keep = [&](Id edge, Vec2 start, Vec2 end, Id of) {
      walls.push_back({edge, start, b.opening[of]});
      walls.push_back({b.next[edge], end, b.opening[of]});
    };
    if (goes[j] != 0 && !b.fixed[i]) keep(f.edge[k], on.p1, on.p2, j);
    if (goes[i] != 0 && !b.fixed[j]) keep(f.facing[k], on.q1, on.q2, i);
  }
  return walls;
}

}  // namespace

void Simulation::excavate(const std::vector<Index>& openings) {
  const double energy = ledger_now().balance();
  std::vector<std::uint8_t> goes(blocks.size(), 0);
  std::set<Index> going;  // what was taken out before keeps what it has let go
  for (std::size_t i = 0; i < blocks.opening.size(); ++i) {
    const bool named =
        std::find(openings.begin(), openings.end(), blocks.opening[i]) != openings.end();
    goes[i] = named && state.alive[i] != 0 ? 1 : 0;
    if (goes[i] != 0) going.insert(blocks.opening[i]);
  }
  Instant now;
  observe(*this, now);
  const std::vector<KeptForce> on_walls = wall_forces(blocks, now.contacts, goes);
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    if (goes[i] == 0) continue;
    state.alive[i] = 0;
    for (std::size_t k = 0; k < 3; ++k) state.vx[k][i] = state.vy[k][i] = 0.0;
  }
  for (const Index o : going) loads.held[static_cast<std::size_t>(o)] = {0.0, 1.0, state.time};
  keep(on_walls);
  search(contacts.reach);
  external_work += ledger_now().balance() - energy;
}

void Simulation::relax(Index opening, double part) {
  loads.held[static_cast<std::size_t>(opening)].change(1.0 - part, state.time);
}

}  // namespace edda
