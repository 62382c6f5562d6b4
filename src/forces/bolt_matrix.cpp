#include "forces/bolt_matrix.hpp"

#include <algorithm>
#include <cmath>

namespace edda {
namespace {

/// Stiffness of bar k and its dowel at their end `node`.
NodalMatrix end_matrix(const Bolts& bolts, const State& s, const Rotation& r, std::size_t k,
                       std::size_t node, bool grouted) {
  const auto back = [&](Vec2 u) { return Vec2{r.c * u.x + r.s * u.y, -r.s * u.x + r.c * u.y}; };
  const NodeWeights w = weights_of(bolts.weight, node);
  const Vec2 t = grouted ? bar_frame(bolts, s, k).t
                         : unit(node_place(bolts, s, k + 1) - node_place(bolts, s, k));
  const NodalVector along_bolt = along(w, back(t)), across = along(w, back(perp(t)));
  if (grouted) return 2.0 * bolts.dowels.stiffness[k] * across * across.transpose();
  const double stiffness = bolts.bars.stiffness[k];
  const double pull = std::min(bolts.bars.strength[k],
                               std::max(bolts.bars.force[k], 0.01 * stiffness * bolts.length[k]));
  return 2.0 * stiffness * along_bolt * along_bolt.transpose() +
         2.0 * pull / bolts.length[k] * across * across.transpose();
}

}  // namespace

NodalMatrix bolt_matrix(const Bolts& b, const BlockSet& blocks, const State& s, std::size_t i) {
  NodalMatrix m = NodalMatrix::Zero();
  if (b.place.empty() || b.place[i] == no_id) return m;
  const Rotation r = rotation(deformation(blocks, s.x, s.y, i));
  for (Id q = b.block_begin[b.place[i]]; q < b.block_begin[b.place[i] + 1]; ++q) {
    const std::size_t k = b.block_nodes[q];
    const auto row = static_cast<std::size_t>(
        std::upper_bound(b.begin.begin(), b.begin.end(), static_cast<Id>(k)) - b.begin.begin() - 1);
    const bool grouted = b.rows[row].grouted;
    const NodeWeights w = weights_of(b.weight, k);
    const Vec2 axis = weighted(weights_of(b.along, k), s.x, s.y, i);
    const NodalVector h = along(w, {r.c * axis.x + r.s * axis.y, -r.s * axis.x + r.c * axis.y});
    m += b.bonds.stiffness[k] * h * h.transpose();
    if (k + 1 < b.begin[row + 1]) m += end_matrix(b, s, r, k, k, grouted);
    if (k > b.begin[row]) m += end_matrix(b, s, r, k - 1, k, grouted);
  }
  return m;
}

}  // namespace edda
