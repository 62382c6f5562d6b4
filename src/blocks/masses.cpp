#include "blocks/masses.hpp"

#include <array>

#include "blocks/cover.hpp"

namespace edda {
namespace {

/// u^T M^-1 w of block i.
double inverse_product(const Masses& masses, std::size_t i, const NodeWeights& u,
                       const NodeWeights& w) {
  if (masses.kind != MassKind::consistent) {
    double sum = 0.0;
    for (std::size_t k = 0; k < nodes_per_block; ++k) sum += u[k] * w[k] / masses.node[k][i];
    return sum;
  }
  const auto& m = masses.inverse;
  return u[0] * (m[0][i] * w[0] + m[1][i] * w[1] + m[2][i] * w[2]) +
         u[1] * (m[1][i] * w[0] + m[3][i] * w[1] + m[4][i] * w[2]) +
         u[2] * (m[2][i] * w[0] + m[4][i] * w[1] + m[5][i] * w[2]);
}

}  // namespace

Masses given_masses(const BlockSet& b) {
  Masses m;
  m.kind = b.mass_kind;
  for (std::vector<double>& of_node : m.node) {
    of_node.reserve(b.size());
    for (const double mass : b.mass) of_node.push_back(mass / nodes_per_block);
  }
  m.inverse = b.inverse_mass;
  fill_point_masses(m, b);
  return m;
}

double inertia_of(const Masses& masses, std::size_t i) {
  if (masses.kind != MassKind::consistent) {
    return masses.node[0][i] + masses.node[1][i] + masses.node[2][i];
  }
  const auto& m = masses.inverse;
  return 9.0 / (m[0][i] + m[3][i] + m[5][i] + 2.0 * (m[1][i] + m[2][i] + m[4][i]));
}

double mass_product(const Masses& masses, std::size_t i, const NodeVectors& u,
                    const NodeVectors& v) {
  if (masses.kind != MassKind::consistent) {
    double sum = 0.0;
    for (std::size_t k = 0; k < nodes_per_block; ++k) sum += masses.node[k][i] * dot(u[k], v[k]);
    return sum;
  }
  std::array<double, 6> inverse;
  for (std::size_t e = 0; e < 6; ++e) inverse[e] = masses.inverse[e][i];
  const std::array<double, 6> m = inverse_symmetric(inverse);
  return dot(u[0], m[0] * v[0] + m[1] * v[1] + m[2] * v[2]) +
         dot(u[1], m[1] * v[0] + m[3] * v[1] + m[4] * v[2]) +
         dot(u[2], m[2] * v[0] + m[4] * v[1] + m[5] * v[2]);
}

double kinetic_energy(const Masses& masses, const Nodes& vx, const Nodes& vy, std::size_t i) {
  const NodeVectors v = vectors_of(vx, vy, i);
  return 0.5 * mass_product(masses, i, v, v);
}

double kinetic_energy(const Masses& masses, const BlockSet& b, const State& s, std::size_t i) {
  double energy = kinetic_energy(masses, s.vx, s.vy, i);
  if (const BlockModes modes = b.modes(i); modes.count > 0)
    energy += 0.5 * mode_product(modes, s.bend_rate, s.bend_rate) / masses.mode_inverse[i];
  return energy;
}

void fill_point_masses(Masses& m, const BlockSet& b) {
  m.point_inverse.assign(b.vertex_count(), 0.0);
  m.edge_inverse.assign(b.vertex_count(), 0.0);
  for (std::size_t k = 0; k < nodes_per_block; ++k) {
    m.node_inverse[k].resize(b.size());
    for (std::size_t i = 0; i < b.size(); ++i) {
      m.node_inverse[k][i] = m.node[k][i] > 0.0 ? 1.0 / m.node[k][i] : 0.0;
    }
  }
  m.mode_inverse.assign(b.bending.any() ? in_groups(b.size()) : 0, 0.0);
  for (std::size_t i = 0; b.bending.any() && i < b.size(); ++i) {
    const double inertia = b.fixed[i] ? 0.0 : inertia_of(m, i);
    const auto corners = static_cast<double>(b.vertex_begin[i + 1] - b.vertex_begin[i]);
    if (inertia > 0.0) m.mode_inverse[i] = corners / inertia;
  }
  for (std::size_t v = 0; v < b.vertex_count(); ++v) {
    const std::size_t i = b.vertex_block[v];
    if (b.fixed[i]) continue;
    const NodeWeights w = weights_of(b.weight, v);
    m.point_inverse[v] = inverse_product(m, i, w, w);
    m.edge_inverse[v] = inverse_product(m, i, w, weights_of(b.weight, b.next[v]));
    const BlockModes modes = b.modes(i);
    if (modes.count == 0) continue;
    const std::size_t at = v - b.vertex_begin[i], other = b.next[v] - b.vertex_begin[i];
    m.point_inverse[v] += m.mode_inverse[i] * modes.product(at, at);
    m.edge_inverse[v] += m.mode_inverse[i] * modes.product(at, other);
  }
}

}  // namespace edda
