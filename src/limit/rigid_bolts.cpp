#include "limit/rigid_bolts.hpp"

#include <algorithm>

#include "attachments/bolts.hpp"
#include "limit/linear_program.hpp"

namespace edda {
namespace {

/// What the bar after node k, or its dowel, may carry: nothing once it has broken, or where the
/// rock at one of its ends has been taken out.
double strength_now(const Simulation& sim, const BoltSprings& springs, Id k) {
  const Bolts& bolts = sim.attached.bolts;
  const State& state = sim.motion.state;
  const bool cut = is_cut_off(bolts, state, k) || is_cut_off(bolts, state, k + 1);
  return cut || springs.broken[k] != 0 ? 0.0 : std::min(springs.strength[k], no_bound);
}

/// Direction of the steel after node k, where it passes from block to block.
Vec2 direction_there(const Simulation& sim, Id k) {
  const Bolts& bolts = sim.attached.bolts;
  const BarFrame frame = bar_frame(bolts, sim.scene->blocks, sim.motion.state, k);
  if (bolts.hinges[k] == 0.0) return frame.t;
  const BarLink link = link_of(bolts, frame, k);
  return link.cosine * frame.t + link.sine * perp(frame.t);
}

/// A grouted bolt: where it passes from block to block its steel carries up to its yield force
/// along it, and its dowel across it; between two such places the bond takes up the difference.
void add_grouted(RigidBlocks& rigid, const Simulation& sim, Id first, Id last) {
  const Bolts& bolts = sim.attached.bolts;
  RigidGrout grout;
  for (Id k = first; k < last; ++k) {
    if (bolts.bonds.stiffness[k] > 0.0) grout.strength += bolts.bonds.strength[k];
    if (k + 1 == last || bolts.crossing[k] == 0) continue;
    const Vec2 t = direction_there(sim, k);
    const Vec2 place = node_place(bolts, sim.scene->blocks, sim.motion.state, k);
    const double yield = strength_now(sim, bolts.bars, k);
    rigid.ties.push_back({bolts.host[k], bolts.host[k + 1], place, place, t, -yield, yield});
    grout.after = rigid.ties.size() - 1;
    rigid.grout.push_back(grout);
    grout = {grout.after, RigidGrout::no_tie, 0.0};
    const double most = bolts.dowels.stiffness[k] > 0.0 ? strength_now(sim, bolts.dowels, k) : 0.0;
    if (most > 0.0)
      rigid.ties.push_back({bolts.host[k], bolts.host[k + 1], place, place, perp(t), -most, most});
  }
  rigid.grout.push_back(grout);
}

}  // namespace

void add_bolts(RigidBlocks& rigid, const Simulation& sim, BoltForces forces) {
  const Bolts& bolts = sim.attached.bolts;
  const BlockSet& blocks = sim.scene->blocks;
  const State& state = sim.motion.state;
  for (std::size_t row = 0; row < bolts.rows.size(); ++row) {
    const Id first = bolts.begin[row], last = bolts.begin[row + 1];
    if (bolts.rows[row].grouted) {
      add_grouted(rigid, sim, first, last);
    } else {
      const double most = strength_now(sim, bolts.bars, first);
      const double now = std::min(bolts.bars.force[first], most);
      const bool as_now = forces == BoltForces::as_now;
      rigid.ties.push_back(
          {bolts.host[first], bolts.host[first + 1], node_place(bolts, blocks, state, first),
           node_place(bolts, blocks, state, first + 1), bar_frame(bolts, blocks, state, first).t,
           as_now ? now : 0.0, as_now ? now : most});
    }
  }
}

}  // namespace edda
