#include "observe/bolt_nodes.hpp"

#include <algorithm>
#include <cmath>

namespace edda {
namespace {

/// Axial force at node k of a bolt with the nodes [first, last). In a joint it is that of the steel
/// across it, at a free end zero, elsewhere the mean of the two bars.
double axial_force(const Bolts& b, const BoltData& row, std::size_t k, std::size_t first,
                   std::size_t last) {
  if (!row.grouted) return b.bars.force[first];
  const double before = k > first ? b.bars.force[k - 1] : 0.0;
  const double after = k + 1 < last ? b.bars.force[k] : 0.0;
  if (k + 1 < last && b.crossing[k] != 0) return after;
  if (k > first && b.crossing[k - 1] != 0) return before;
  if (k == first || k + 1 == last) return 0.0;
  return 0.5 * (before + after);
}

/// The bar beside node k that has a dowel, or `last`.
std::size_t dowel_at(const Bolts& b, std::size_t k, std::size_t first, std::size_t last) {
  if (k + 1 < last && b.dowels.stiffness[k] > 0.0) return k;
  return k > first && b.dowels.stiffness[k - 1] > 0.0 ? k - 1 : last;
}

double part(double force, double strength) {
  return force != 0.0 && strength > 0.0 ? std::abs(force) / strength : 0.0;
}

}  // namespace

BoltNode bolt_node(const Simulation& sim, std::size_t r, std::size_t k) {
  const Bolts& b = sim.attached.bolts;
  const BoltData& row = b.rows[r];
  const std::size_t first = b.begin[r], last = b.begin[r + 1];
  const double axial = axial_force(b, row, k, first, last),
               bond = b.bonded[k] > 0.0 ? b.bonds.force[k] / b.bonded[k] : 0.0;
  // Bars that end in excavated rock have been cut with it.
  const auto holds = [&](std::size_t n) {
    return !is_cut_off(b, sim.motion.state, n) && !is_cut_off(b, sim.motion.state, n + 1);
  };
  const auto near = [&](const std::vector<std::uint8_t>& flags) {
    return (k + 1 < last && flags[k] != 0 && holds(k)) ||
           (k > first && flags[k - 1] != 0 && holds(k - 1));
  };
  BoltNode node;
  node.place = node_place(b, sim.scene->blocks, sim.motion.state, k) + sim.scene->blocks.origin;
  node.axial = axial / row.share;
  node.bond = bond / row.share;
  if (const std::size_t at = dowel_at(b, k, first, last); at != last) {
    node.dowel = b.dowels.force[at] / row.share;
    node.dowel_utilisation = part(b.dowels.force[at], b.dowels.strength[at]);
    if (b.hinges[at] > 0.0) {
      node.dowel_utilisation = std::hypot(node.dowel_utilisation, part(axial, row.yield));
      const BarLink link = link_of(b, bar_frame(b, sim.scene->blocks, sim.motion.state, at), at);
      node.angle = std::atan2(link.sine, link.cosine);
    }
  }
  node.utilisation =
      std::max({part(axial, row.yield), part(bond, row.bond_strength), node.dowel_utilisation});
  node.yielded = near(b.bars.yielded);
  node.ruptured = near(b.bars.broken);
  return node;
}

}  // namespace edda
