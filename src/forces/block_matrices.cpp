#include "forces/block_matrices.hpp"

#include "blocks/strain_rate.hpp"

namespace edda {

Vector6 along(const std::array<double, 3>& w, Vec2 direction) {
  Vector6 h;
  for (int k = 0; k < 3; ++k) {
    const auto u = static_cast<std::size_t>(k);
    h[2 * k] = w[u] * direction.x;
    h[2 * k + 1] = w[u] * direction.y;
  }
  return h;
}

Eigen::Matrix<double, 3, 6> strain_matrix(const BlockSet& b, std::size_t i) {
  Eigen::Matrix<double, 3, 6> strain;
  for (int k = 0; k < 3; ++k) {
    const auto u = static_cast<std::size_t>(k);
    const double gx = b.grad_x[u][i], gy = b.grad_y[u][i];
    strain.block<3, 2>(0, 2 * k) << gx, 0.0, 0.0, gy, gy, gx;
  }
  return strain;
}

Eigen::Matrix3d stiffness_of_rock(const BlockSet& b, std::size_t i) {
  const double lambda = b.lame_lambda[i], mu = b.lame_mu[i];
  Eigen::Matrix3d c;
  c << lambda + 2.0 * mu, lambda, 0.0, lambda, lambda + 2.0 * mu, 0.0, 0.0, 0.0, mu;
  return c;
}

Matrix6 elastic_matrix(const BlockSet& b, std::size_t i) {
  const Eigen::Matrix<double, 3, 6> strain = strain_matrix(b, i);
  return b.volume[i] * strain.transpose() * stiffness_of_rock(b, i) * strain;
}

Matrix6 viscous_matrix(const BlockSet& b, std::size_t i) {
  if (b.viscosity.empty()) return Matrix6::Zero();
  return b.viscosity[i] * elastic_matrix(b, i);
}

Matrix6 viscous_matrix(const BlockSet& b, std::size_t i, const Deformation& f) {
  if (b.viscosity.empty()) return Matrix6::Zero();
  const StrainFrame frame = strain_frame(f);
  Eigen::Matrix<double, 3, 6> rates;
  for (int k = 0; k < 3; ++k) {
    const auto u = static_cast<std::size_t>(k);
    const double gx = b.grad_x[u][i], gy = b.grad_y[u][i];
    const StrainTerms along_x = strain_rate(frame, {gx, gy, 0.0, 0.0}),
                      along_y = strain_rate(frame, {0.0, 0.0, gx, gy});
    rates.col(2 * k) << along_x.xx, along_x.yy, along_x.xy;
    rates.col(2 * k + 1) << along_y.xx, along_y.yy, along_y.xy;
  }
  return b.viscosity[i] * b.volume[i] * rates.transpose() * stiffness_of_rock(b, i) * rates;
}

Matrix6 mass_matrix(const BlockSet& b, std::size_t i) {
  Matrix6 m = Matrix6::Zero();
  if (b.mass_kind != MassKind::consistent) {
    for (int k = 0; k < 6; ++k) m(k, k) = b.node_mass[static_cast<std::size_t>(k / 2)][i];
    return m;
  }
  Eigen::Matrix3d inverse;
  inverse << b.inverse_mass[0][i], b.inverse_mass[1][i], b.inverse_mass[2][i], b.inverse_mass[1][i],
      b.inverse_mass[3][i], b.inverse_mass[4][i], b.inverse_mass[2][i], b.inverse_mass[4][i],
      b.inverse_mass[5][i];
  const Eigen::Matrix3d full = inverse.inverse();
  for (int k = 0; k < 3; ++k) {
    for (int l = 0; l < 3; ++l) m(2 * k, 2 * l) = m(2 * k + 1, 2 * l + 1) = full(k, l);
  }
  return m;
}

Matrix6 boundary_matrix(const BlockSet& b, const BoundarySprings& springs, const Rotation& r,
                        std::size_t i) {
  Eigen::Matrix2d turn;
  turn << r.c, r.s, -r.s, r.c;
  Matrix6 m = Matrix6::Zero();
  for (Id q = springs.block_begin[i]; q < springs.block_begin[i + 1]; ++q) {
    Eigen::Matrix2d k;
    k << springs.kxx[q], springs.kxy[q], springs.kxy[q], springs.kyy[q];
    k = turn * k * turn.transpose();
    const auto w = vertex_weights(b, springs.vertex[q]);
    for (int p = 0; p < 3; ++p) {
      for (int l = 0; l < 3; ++l) {
        m.block<2, 2>(2 * p, 2 * l) +=
            w[static_cast<std::size_t>(p)] * w[static_cast<std::size_t>(l)] * k;
      }
    }
  }
  return m;
}

Matrix6 turned(const Matrix6& k, const Rotation& r) {
  Eigen::Matrix2d q;
  q << r.c, -r.s, r.s, r.c;
  Matrix6 out;
  for (int p = 0; p < 3; ++p) {
    for (int l = 0; l < 3; ++l) {
      out.block<2, 2>(2 * p, 2 * l) = q * k.block<2, 2>(2 * p, 2 * l) * q.transpose();
    }
  }
  return out;
}

}  // namespace edda
