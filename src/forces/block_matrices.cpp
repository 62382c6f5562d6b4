#include "forces/block_matrices.hpp"

#include "blocks/strain_rate.hpp"

namespace edda {

NodalVector along(const NodeWeights& w, Vec2 direction) {
  NodeVectors h;
  for (std::size_t k = 0; k < nodes_per_block; ++k) h[k] = w[k] * direction;
  return nodal(h);
}

namespace {

BodyColumn column_of(const BodyVector& u) {
  BodyColumn c(row_of_node(nodes_per_block + u.count));
  c.head<degrees_of_freedom>() = nodal(u.nodes);
  for (std::size_t a = 0; a < u.count; ++a)
    c.segment<2>(row_of_node(nodes_per_block + a)) << u.modes[a].x, u.modes[a].y;
  return c;
}

}  // namespace

BodyColumn column_of(const BlockSet& b, const BodyVectors& u, std::size_t i) {
  return column_of(vector_of(b, u, i));
}

void store(const BodyColumn& c, const BlockSet& b, BodyVectors& u, std::size_t i) {
  BodyVector v(b.bending.modes_of(i));
  v.nodes = vectors_of(c.head<degrees_of_freedom>());
  for (std::size_t a = 0; a < v.count; ++a) {
    const auto q = c.segment<2>(row_of_node(nodes_per_block + a));
    v.modes.set(a, {q[0], q[1]});
  }
  store(v, b, u, i);
}

BodyColumn at_corner(const BlockSet& b, Id v, Vec2 force) {
  BlockForces on{b, b.vertex_block[v]};
  on.at_corner(v, force);
  return column_of(on.sum);
}

void add_at(NodalMatrix& m, const NodeWeights& w, const Eigen::Matrix2d& c) {
  for (std::size_t k = 0; k < nodes_per_block; ++k) {
    for (std::size_t l = 0; l < nodes_per_block; ++l) {
      m.block<2, 2>(row_of_node(k), row_of_node(l)) += w[k] * w[l] * c;
    }
  }
}

StrainMatrix strain_matrix(const BlockSet& b, std::size_t i) {
  StrainMatrix strain;
  for (std::size_t k = 0; k < nodes_per_block; ++k) {
    const double gx = b.grad_x[k][i], gy = b.grad_y[k][i];
    strain.block<3, 2>(0, row_of_node(k)) << gx, 0.0, 0.0, gy, gy, gx;
  }
  return strain;
}

Eigen::Matrix3d stiffness_of_rock(const BlockSet& b, std::size_t i) {
  const double lambda = b.lame_lambda[i], mu = b.lame_mu[i];
  Eigen::Matrix3d c;
  c << lambda + 2.0 * mu, lambda, 0.0, lambda, lambda + 2.0 * mu, 0.0, 0.0, 0.0, mu;
  return c;
}

NodalMatrix elastic_matrix(const BlockSet& b, std::size_t i) {
  const StrainMatrix strain = strain_matrix(b, i);
  return b.volume[i] * strain.transpose() * stiffness_of_rock(b, i) * strain;
}

NodalMatrix viscous_matrix(const BlockSet& b, const Masses& masses, std::size_t i) {
  if (masses.viscosity.empty()) return NodalMatrix::Zero();
  return masses.viscosity[i] * elastic_matrix(b, i);
}

NodalMatrix viscous_matrix(const BlockSet& b, const Masses& masses, std::size_t i,
                           const Deformation& f) {
  if (masses.viscosity.empty()) return NodalMatrix::Zero();
  const StrainFrame frame = strain_frame(f);
  StrainMatrix rates;
  for (std::size_t k = 0; k < nodes_per_block; ++k) {
    const double gx = b.grad_x[k][i], gy = b.grad_y[k][i];
    const StrainTerms along_x = strain_rate(frame, {gx, gy, 0.0, 0.0}),
                      along_y = strain_rate(frame, {0.0, 0.0, gx, gy});
    rates.col(row_of_node(k)) << along_x.xx, along_x.yy, along_x.xy;
    rates.col(row_of_node(k) + 1) << along_y.xx, along_y.yy, along_y.xy;
  }
  return masses.viscosity[i] * b.volume[i] * rates.transpose() * stiffness_of_rock(b, i) * rates;
}

NodalMatrix mass_matrix(const Masses& masses, std::size_t i) {
  NodalMatrix m = NodalMatrix::Zero();
  if (masses.kind != MassKind::consistent) {
    for (std::size_t k = 0; k < nodes_per_block; ++k) {
      m.block<2, 2>(row_of_node(k), row_of_node(k)).diagonal().setConstant(masses.node[k][i]);
    }
    return m;
  }
  Eigen::Matrix<double, nodes_per_block, nodes_per_block> inverse;
  auto entry = masses.inverse.begin();
  for (Eigen::Index k = 0; k < inverse.rows(); ++k) {
    for (Eigen::Index l = k; l < inverse.cols(); ++l) {
      inverse(k, l) = inverse(l, k) = (*entry++)[i];
    }
  }
  const auto full = inverse.inverse().eval();
  for (Eigen::Index k = 0; k < full.rows(); ++k) {
    for (Eigen::Index l = 0; l < full.cols(); ++l) {
      m(2 * k, 2 * l) = m(2 * k + 1, 2 * l + 1) = full(k, l);
    }
  }
  return m;
}

namespace {

/// Stiffness of boundary spring q in the frame of its block, whose rotation is r.
Eigen::Matrix2d stiffness_of_spring(const BoundarySprings& springs, Id q, const Rotation& r) {
  Eigen::Matrix2d turn, k;
  turn << r.c, r.s, -r.s, r.c;
  k << springs.kxx[q], springs.kxy[q], springs.kxy[q], springs.kyy[q];
  return turn * k * turn.transpose();
}

}  // namespace

NodalMatrix boundary_matrix(const BlockSet& b, const BoundarySprings& springs, const Rotation& r,
                            std::size_t i) {
  NodalMatrix m = NodalMatrix::Zero();
  for (Id q = springs.block_begin[i]; q < springs.block_begin[i + 1]; ++q)
    add_at(m, weights_of(b.weight, springs.vertex[q]), stiffness_of_spring(springs, q, r));
  return m;
}

BodyMatrix boundary_of_body(const BlockSet& b, const BoundarySprings& s, const Rotation& r,
                            std::size_t i) {
  const Eigen::Index size = components_of(b, i);
  BodyMatrix m = BodyMatrix::Zero(size, size);
  for (Id q = s.block_begin[i]; q < s.block_begin[i + 1]; ++q) {
    Eigen::MatrixXd both(size, 2);
    both.col(0) = at_corner(b, s.vertex[q], {1.0, 0.0});
    both.col(1) = at_corner(b, s.vertex[q], {0.0, 1.0});
    m += both * stiffness_of_spring(s, q, r) * both.transpose();
  }
  return m;
}

namespace {

/// A matrix of the modes of a block: `beside` on the diagonal, and e_b e_b^T times more[b].
BodyMatrix of_modes(const BlockSet& b, std::size_t i, const std::array<double, bendings>& more,
                    const Eigen::VectorXd& beside) {
  const BlockModes modes = b.modes(i);
  BodyMatrix matrix = beside.asDiagonal();
  for (std::size_t k = 0; k < bendings; ++k) {
    Eigen::VectorXd e(beside.size());
    for (std::size_t a = 0; a < modes.count; ++a) {
      const Vec2 of_mode = b.bending.axis[k][modes[a]];
      e.segment<2>(row_of_node(a)) << of_mode.x, of_mode.y;
    }
    matrix += more[k] * e * e.transpose();
  }
  return matrix;
}

}  // namespace

BodyMatrix stiffness_of_modes(const BlockSet& b, std::size_t i) {
  const BlockModes modes = b.modes(i);
  if (modes.count == 0) return {};
  Eigen::VectorXd beside(row_of_node(modes.count));
  for (std::size_t a = 0; a < modes.count; ++a)
    beside.segment<2>(row_of_node(a)).setConstant(b.bending.stiffness[modes[a]]);
  std::array<double, bendings> more{};
  for (std::size_t k = 0; k < bendings; ++k) more[k] = -b.bending.less[k][i];
  return of_modes(b, i, more, beside);
}

BodyMatrix viscosity_of_modes(const BlockSet& b, const Masses& masses, std::size_t i) {
  const Eigen::Index size = row_of_node(b.bending.modes_of(i));
  const auto& rate = masses.mode_damping;
  if (size == 0 || rate[0].empty()) return BodyMatrix::Zero(size, size);
  const double mass = 1.0 / masses.mode_inverse[i], rest = rate[bendings][i];
  std::array<double, bendings> more{};
  for (std::size_t k = 0; k < bendings; ++k) more[k] = mass * (rate[k][i] - rest);
  return of_modes(b, i, more, Eigen::VectorXd::Constant(size, mass * rest));
}

BodyMatrix of_body(const NodalMatrix& nodes, const BodyMatrix& modes) {
  BodyMatrix all = BodyMatrix::Zero(nodes.rows() + modes.rows(), nodes.cols() + modes.cols());
  all.topLeftCorner<degrees_of_freedom, degrees_of_freedom>() = nodes;
  all.bottomRightCorner(modes.rows(), modes.cols()) = modes;
  return all;
}

void BodyMass::add_to(BodyMatrix& k, double factor) const {
  k.topLeftCorner<degrees_of_freedom, degrees_of_freedom>() += factor * nodes;
  k.diagonal().tail(k.rows() - nodes.rows()).array() += factor * mode;
}

BodyColumn operator*(const BodyMass& mass, const BodyColumn& u) {
  BodyColumn product = mass.mode * u;
  product.head<degrees_of_freedom>() = mass.nodes * u.head<degrees_of_freedom>();
  return product;
}

BodyMass body_mass(const BlockSet& b, const Masses& masses, std::size_t i) {
  return {mass_matrix(masses, i), b.bending.modes_of(i) == 0 ? 0.0 : 1.0 / masses.mode_inverse[i]};
}

}  // namespace edda
