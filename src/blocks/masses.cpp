#include "blocks/masses.hpp"

#include <array>

#include "blocks/cover.hpp"
#include "blocks/kinematics.hpp"

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

double inverse_product(const Masses& m, const BlockSet& b, std::size_t v, std::size_t w) {
  const std::size_t i = b.vertex_block[v];
  const double of_nodes = inverse_product(m, i, weights_of(b.weight, v), weights_of(b.weight, w));
  const BlockModes modes = b.modes(i);
  if (modes.count == 0) return of_nodes;
  const std::size_t at = v - b.vertex_begin[i], with = w - b.vertex_begin[i];
  const std::size_t first = modes.of_mesh() ? b.meshes.begin[i] : 0;
  return of_nodes + m.mode_inverse[i] * (modes.of_mesh()
                                             ? b.meshes.inverse_product(i, first + at, first + with)
                                             : modes.product(at, with));
}

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

BodyVector accelerations(const Masses& masses, const BlockSet& b, std::size_t i,
                         const BodyVector& f) {
  BodyVector a(f.count);
  a.nodes = accelerations(masses, i, f.nodes);
  if (!b.is_meshed(i)) {
    for (std::size_t m = 0; m < f.count; ++m) a.modes.set(m, masses.mode_inverse[i] * f.modes[m]);
    return a;
  }
  const std::size_t first = b.meshes.begin[i];
  AffinePart common;
  for (std::size_t m = 0; m < f.count; ++m) b.meshes.add(common, first + m, f.modes[m]);
  common = b.meshes.solve(i, common);
  for (std::size_t m = 0; m < f.count; ++m) {
    const Vec2 own = f.modes[m] / b.meshes.share[first + m] - b.meshes.at(common, first + m);
    a.modes.set(m, masses.mode_inverse[i] * own);
  }
  return a;
}

double mass_product(const Masses& masses, const BlockSet& b, std::size_t i, const BodyVector& u,
                    const BodyVector& v) {
  double sum = mass_product(masses, i, u.nodes, v.nodes);
  const BlockModes modes = b.modes(i);
  for (std::size_t a = 0; a < u.count; ++a)
    sum += modes.mass(a) * dot(u.modes[a], v.modes[a]) / masses.mode_inverse[i];
  return sum;
}

AffinePart beside_lumped(const Masses& masses, const BlockSet& b, std::size_t i,
                         const AffinePart& p) {
  NodeVectors f;
  for (std::size_t k = 0; k < nodes_per_block; ++k)
    f[k] = p.one / nodes_per_block + b.grad_x[k][i] * p.x + b.grad_y[k][i] * p.y;
  const AffineMotion exact = affine_motion(b, accelerations(masses, i, f), i);
  const AffinePart lumped = b.meshes.solve(i, p);
  const double inverse = masses.mode_inverse[i];
  return {exact.at - inverse * lumped.one, Vec2{exact.f.xx, exact.f.yx} - inverse * lumped.x,
          Vec2{exact.f.xy, exact.f.yy} - inverse * lumped.y};
}

Unbalanced unbalanced_forces(const Masses& masses, const BlockSet& b, const BodyVectors& forces,
                             std::size_t i) {
  if (!b.is_meshed(i)) return {norm(resultant(vectors_of(forces, i))), 1};
  const BodyVector a = accelerations(masses, b, i, vector_of(b, forces, i));
  const AffineMotion affine = affine_motion(b, a.nodes, i);
  const Meshes& m = b.meshes;
  Unbalanced all{0.0, a.count};
  for (std::size_t j = 0; j < a.count; ++j) {
    const std::size_t node = m.begin[i] + j;
    all.sum += m.share[node] / masses.mode_inverse[i] *
               norm(affine.of(m.arm_x[node], m.arm_y[node]) + a.modes[j]);
  }
  return all;
}

double kinetic_energy(const Masses& masses, const BlockSet& b, const BodyVectors& velocity,
                      std::size_t i) {
  const NodeVectors v = vectors_of(velocity, i);
  double energy = 0.5 * mass_product(masses, i, v, v);
  if (const BlockModes modes = b.modes(i); modes.count > 0)
    energy += 0.5 * mode_product(modes, velocity.modes, velocity.modes) / masses.mode_inverse[i];
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
  m.mode_inverse.assign(b.mode_places() > 0 ? in_groups(b.size()) : 0, 0.0);
  for (std::size_t i = 0; b.mode_places() > 0 && i < b.size(); ++i) {
    const double inertia = b.fixed[i] ? 0.0 : inertia_of(m, i);
    const auto corners = static_cast<double>(b.vertex_begin[i + 1] - b.vertex_begin[i]);
    if (inertia > 0.0) m.mode_inverse[i] = b.is_meshed(i) ? 1.0 / inertia : corners / inertia;
  }
  for (std::size_t v = 0; v < b.vertex_count(); ++v) {
    if (b.fixed[b.vertex_block[v]]) continue;
    m.point_inverse[v] = inverse_product(m, b, v, v);
    m.edge_inverse[v] = inverse_product(m, b, v, b.next[v]);
  }
}

}  // namespace edda
