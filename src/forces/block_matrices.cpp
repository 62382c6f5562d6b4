#include "forces/block_matrices.hpp"

#include "blocks/strain_rate.hpp"

namespace edda {

NodalVector along(const NodeWeights& w, Vec2 direction) {
  NodeVectors h;
  for (std::size_t k = 0; k < nodes_per_block; ++k) h[k] = w[k] * direction;
  return nodal(h);
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

NodalMatrix boundary_matrix(const BlockSet& b, const BoundarySprings& springs, const Rotation& r,
                            std::size_t i) {
  Eigen::Matrix2d turn;
  turn << r.c, r.s, -r.s, r.c;
  NodalMatrix m = NodalMatrix::Zero();
  for (Id q = springs.block_begin[i]; q < springs.block_begin[i + 1]; ++q) {
    Eigen::Matrix2d k;
    k << springs.kxx[q], springs.kxy[q], springs.kxy[q], springs.kyy[q];
    k = turn * k * turn.transpose();
    add_at(m, weights_of(b.weight, springs.vertex[q]), k);
  }
  return m;
}

NodalMatrix rotated(const NodalMatrix& k, const Rotation& r) {
  Eigen::Matrix2d q;
  q << r.c, -r.s, r.s, r.c;
  NodalMatrix out;
  for (Eigen::Index row = 0; row < k.rows(); row += 2) {
    for (Eigen::Index column = 0; column < k.cols(); column += 2) {
      out.block<2, 2>(row, column) = q * k.block<2, 2>(row, column) * q.transpose();
    }
  }
  return out;
}

}  // namespace edda
