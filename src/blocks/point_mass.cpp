#include "blocks/point_mass.hpp"

#include <array>

namespace edda {
namespace {

using Weights = std::array<double, 3>;

Weights weights_of(const BlockSet& b, std::size_t v) {
  return {b.weight[0][v], b.weight[1][v], b.weight[2][v]};
}

/// u^T M^-1 w of block i; 0 where it is held.
double inverse_product(const BlockSet& b, std::size_t i, const Weights& u, const Weights& w) {
  if (b.fixed[i]) return 0.0;
  if (b.mass_kind != MassKind::consistent) {
    double sum = 0.0;
    for (std::size_t k = 0; k < 3; ++k) sum += u[k] * w[k] / b.node_mass[k][i];
    return sum;
  }
  const auto& m = b.inverse_mass;
  return u[0] * (m[0][i] * w[0] + m[1][i] * w[1] + m[2][i] * w[2]) +
         u[1] * (m[1][i] * w[0] + m[3][i] * w[1] + m[4][i] * w[2]) +
         u[2] * (m[2][i] * w[0] + m[4][i] * w[1] + m[5][i] * w[2]);
}

}  // namespace

void fill_point_masses(BlockSet& b) {
  b.point_inverse.resize(b.vertex_count());
  b.edge_inverse.resize(b.vertex_count());
  for (std::size_t v = 0; v < b.vertex_count(); ++v) {
    const std::size_t i = b.vertex_block[v];
    const Weights w = weights_of(b, v);
    b.point_inverse[v] = inverse_product(b, i, w, w);
    b.edge_inverse[v] = inverse_product(b, i, w, weights_of(b, b.next[v]));
  }
}

}  // namespace edda
