#include "forces/bolt_matrix.hpp"

#include <algorithm>
#include <cmath>

namespace edda {
namespace {

/// What end `node` of bar k feels of the bar and its dowel.
Matrix6 end_matrix(const Bolts& bolts, const State& s, const Rotation& r, std::size_t k,
                   std::size_t node, bool grouted) {
  const auto back = [&](Vec2 u) { return Vec2{r.c * u.x + r.s * u.y, -r.s * u.x + r.c * u.y}; };
  const std::array<double, 3> w{bolts.weight[0][node], bolts.weight[1][node],
                                bolts.weight[2][node]};
  const Vec2 t = grouted ? bar_frame(bolts, s, k).t
                         : unit(node_place(bolts, s, k + 1) - node_place(bolts, s, k));
  const Vector6 along_bolt = along(w, back(t)), across = along(w, back(perp(t)));
  if (grouted) return 2.0 * bolts.dowels.stiffness[k] * across * across.transpose();
  const double stiffness = bolts.bars.stiffness[k];
  const double pull = std::min(bolts.bars.strength[k],
                               std::max(bolts.bars.force[k], 0.01 * stiffness * bolts.length[k]));
  return 2.0 * stiffness * along_bolt * along_bolt.transpose() +
         2.0 * pull / bolts.length[k] * across * across.transpose();
}

}  // namespace

Matrix6 bolt_matrix(const Bolts& b, const BlockSet& blocks, const State& s, std::size_t i) {
  Matrix6 m = Matrix6::Zero();
  if (b.place.empty() || b.place[i] == no_id) return m;
  const Rotation r = rotation(deformation(blocks, s.x, s.y, i));
  for (Id q = b.block_begin[b.place[i]]; q < b.block_begin[b.place[i] + 1]; ++q) {
    const std::size_t k = b.block_nodes[q];
    const auto row = static_cast<std::size_t>(
        std::upper_bound(b.begin.begin(), b.begin.end(), static_cast<Id>(k)) - b.begin.begin() - 1);
    const bool grouted = b.rows[row].grouted;
    const std::array<double, 3> w{b.weight[0][k], b.weight[1][k], b.weight[2][k]};
    const Vec2 axis = weighted({b.along[0][k], b.along[1][k], b.along[2][k]}, s.x, s.y, i);
    const Vector6 h = along(w, {r.c * axis.x + r.s * axis.y, -r.s * axis.x + r.c * axis.y});
    m += b.bonds.stiffness[k] * h * h.transpose();
    if (k + 1 < b.begin[row + 1]) m += end_matrix(b, s, r, k, k, grouted);
    if (k > b.begin[row]) m += end_matrix(b, s, r, k - 1, k, grouted);
  }
  return m;
}

}  // namespace edda
