#include "forces/bolt_matrix.hpp"

#include <algorithm>
#include <cmath>

namespace edda {
namespace {

/// Stiffness across the bolt, N/m, of a dowel. A link that has turned pulls there, too: with no
/// more than the stiffness sqrt(EA K) at which a long bolt is pulled out of its bond K, and as a
/// bar does that carries its force.
double dowel_stiffness(const Bolts& b, const BarFrame& frame, const BoltData& row, std::size_t k) {
  if (b.hinges[k] == 0.0) return b.dowels.stiffness[k];
  const BarLink link = link_of(b, frame, k);
  const double pulled = std::min(b.bars.stiffness[k], std::sqrt(row.steel * row.bond));
  return b.dowels.stiffness[k] + 2.0 * link.sine * link.sine * pulled +
         (std::abs(b.bars.force[k]) + 2.0 * std::abs(b.dowels.force[k])) / link.length;
}

/// Bar k and its dowel at their end `node`.
BoltSpringAt end_springs(const Bolts& bolts, const BlockSet& blocks, const State& s, std::size_t k,
                         std::size_t node, const BoltData& row) {
  if (row.grouted) {
    const BarFrame frame = bar_frame(bolts, blocks, s, k);
    return {node, frame.t, 0.0, 2.0 * dowel_stiffness(bolts, frame, row, k)};
  }
  const double stiffness = bolts.bars.stiffness[k];
  const double pull = std::min(bolts.bars.strength[k],
                               std::max(bolts.bars.force[k], 0.01 * stiffness * bolts.length[k]));
  return {node, unit(node_place(bolts, blocks, s, k + 1) - node_place(bolts, blocks, s, k)),
          2.0 * stiffness, 2.0 * pull / bolts.length[k]};
}

}  // namespace

std::vector<BoltSpringAt> bolt_springs(const Bolts& b, const BlockSet& blocks, const State& s,
                                       std::size_t i) {
  std::vector<BoltSpringAt> springs;
  if (b.place.empty() || b.place[i] == no_id) return springs;
  for (Id q = b.block_begin[b.place[i]]; q < b.block_begin[b.place[i] + 1]; ++q) {
    const std::size_t k = b.block_nodes[q];
    const auto row = static_cast<std::size_t>(
        std::upper_bound(b.begin.begin(), b.begin.end(), static_cast<Id>(k)) - b.begin.begin() - 1);
    const Vec2 axis = weighted(weights_of(b.along, k), carriers_at(b, blocks, s, k));
    springs.push_back({k, axis, b.bonds.stiffness[k]});
    if (k + 1 < b.begin[row + 1]) springs.push_back(end_springs(b, blocks, s, k, k, b.rows[row]));
    if (k > b.begin[row]) springs.push_back(end_springs(b, blocks, s, k - 1, k, b.rows[row]));
  }
  return springs;
}

NodalMatrix bolt_matrix(const Bolts& b, const BlockSet& blocks, const State& s, std::size_t i) {
  NodalMatrix m = NodalMatrix::Zero();
  const std::vector<BoltSpringAt> springs = bolt_springs(b, blocks, s, i);
  if (springs.empty()) return m;
  const Rotation r = rotation(deformation(blocks, s.position, i));
  const auto back = [&](Vec2 u) { return Vec2{r.c * u.x + r.s * u.y, -r.s * u.x + r.c * u.y}; };
  for (const BoltSpringAt& spring : springs) {
    const NodeWeights w = weights_of(b.weight, spring.node);
    const NodalVector along_bolt = along(w, back(spring.t)),
                      across = along(w, back(perp(spring.t)));
    m += spring.along * along_bolt * along_bolt.transpose() +
         spring.across * across * across.transpose();
  }
  return m;
}

}  // namespace edda
