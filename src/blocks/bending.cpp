#include "blocks/bending.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace edda {
namespace {

using Matrix = Eigen::MatrixXd;
using Vector = Eigen::VectorXd;

Eigen::Index row(std::size_t v) {
  return static_cast<Eigen::Index>(v);
}

/// mu_v: half of the mass in equal parts, half by the lengths of the edges at the corner; mean 1.
Vector mass_parts(const BendingBlock& q) {
  double perimeter = 0.0;
  for (const double l : q.tributary) perimeter += l;
  const auto n = static_cast<double>(q.corner.size());
  Vector mu(row(q.corner.size()));
  for (std::size_t v = 0; v < q.corner.size(); ++v)
    mu[row(v)] = 0.5 + 0.5 * n * q.tributary[v] / perimeter;
  return mu;
}

/// An orthonormal basis, in the metric of mu, of what contains no affine motion, [n][n - 3].
Matrix without_affine_motion(const BendingBlock& q, const Vector& root_mu) {
  Matrix constraint(root_mu.size(), 3);
  for (Eigen::Index v = 0; v < root_mu.size(); ++v) {
    const Vec2 g = q.gradient[static_cast<std::size_t>(v)];
    constraint.row(v) << root_mu[v], g.x / root_mu[v], g.y / root_mu[v];
  }
  const Eigen::HouseholderQR<Matrix> qr(constraint);
  const Matrix all = qr.householderQ();
  return root_mu.cwiseInverse().asDiagonal() * all.rightCols(root_mu.size() - 3);
}

/// Young's modulus of the plane, E/(1 - nu^2) in plane strain, and its ratio of Poisson,
/// nu/(1 - nu).
double plane_modulus(const BendingBlock& q) {
  return 4.0 * q.mu * (q.lambda + q.mu) / (q.lambda + 2.0 * q.mu);
}
double plane_ratio(const BendingBlock& q) {
  return q.lambda / (q.lambda + 2.0 * q.mu);
}

/// Stiffness of a boundary that moves by itself, per modulus and thickness: a half-plane with the
/// displacement u at its surface stores E'/(8 pi) Int Int (u(x) - u(y))^2/(x - y)^2 dx dy where the
/// traction along the other direction is free, here as a sum over pairs of corners with the lengths
/// at them. Corners nearer than these lengths count as if they were so far apart.
Matrix boundary_stiffness(const BendingBlock& q) {
  const auto n = row(q.corner.size());
  Matrix s = Matrix::Zero(n, n);
  for (Eigen::Index v = 0; v < n; ++v) {
    for (Eigen::Index w = 0; w < v; ++w) {
      const auto i = static_cast<std::size_t>(v), j = static_cast<std::size_t>(w);
      const Vec2 apart = q.corner[i] - q.corner[j];
      const double lengths = q.tributary[i] * q.tributary[j];
      const double k = lengths / (2.0 * std::numbers::pi) / std::max(dot(apart, apart), lengths);
      s(v, v) += k;
      s(w, w) += k;
      s(v, w) -= k;
      s(w, v) -= k;
    }
  }
  return s;
}

/// A field of displacement at the corners, less its affine part: (1 - Pi) u.
std::vector<Vec2> bent(const BendingBlock& q, const Vector& mu, const std::vector<Vec2>& u) {
  Vec2 by_x, by_y, mean;
  for (std::size_t v = 0; v < u.size(); ++v) {
    by_x += q.gradient[v].x * u[v];
    by_y += q.gradient[v].y * u[v];
  }
  std::vector<Vec2> rest(u.size());
  for (std::size_t v = 0; v < u.size(); ++v) {
    rest[v] = u[v] - q.corner[v].x * by_x - q.corner[v].y * by_y;
    mean += (mu[row(v)] / static_cast<double>(u.size())) * rest[v];
  }
  for (Vec2& r : rest) r -= mean;
  return rest;
}

/// A stress that is linear over the block and needs no body force: sigma_xx = xx . p, and so on, p
/// from the centroid, with the displacement of the rock, times E' (Airy's function of third order).
struct LinearStress {
  Vec2 xx, yy, xy;
  std::array<double, 3> ux, uy;  ///< of x^2, x y, y^2
};
using LinearStresses = std::array<LinearStress, bendings>;

/// All four: bending along x and along y, and a stress along x (y) that grows along itself.
LinearStresses linear_stresses(double nu) {
  return {{{{0, 1}, {}, {}, {0, 1, 0}, {-0.5, 0, -0.5 * nu}},
           {{}, {1, 0}, {}, {-0.5 * nu, 0, -0.5}, {0, 1, 0}},
           {{1, 0}, {}, {0, -1}, {0.5, 0, -1.0 - 0.5 * nu}, {0, -nu, 0}},
           {{}, {0, 1}, {-1, 0}, {0, -nu, 0}, {-1.0 - 0.5 * nu, 0, 0.5}}}};
}

/// Int sigma : epsilon dA of two of them, times E'.
double energy_of(const BendingBlock& q, const LinearStress& s, const LinearStress& t, double nu) {
  const auto moment = [&](Vec2 a, Vec2 b) {
    return a.x * b.x * q.sxx + (a.x * b.y + a.y * b.x) * q.sxy + a.y * b.y * q.syy;
  };
  return moment(s.xx, t.xx) + moment(s.yy, t.yy) - nu * (moment(s.xx, t.yy) + moment(s.yy, t.xx)) +
         2.0 * (1.0 + nu) * moment(s.xy, t.xy);
}

/// What these do to the modes, [2 modes][4].
Matrix modes_of(const BendingBlock& q, const Vector& mu, const Matrix& shape,
                const LinearStresses& fields) {
  Matrix images(2 * shape.cols(), row(bendings));
  for (std::size_t b = 0; b < bendings; ++b) {
    std::vector<Vec2> u;
    for (const Vec2 p : q.corner) {
      const auto at = [&](const std::array<double, 3>& c) {
        return c[0] * p.x * p.x + c[1] * p.x * p.y + c[2] * p.y * p.y;
      };
      u.push_back({at(fields[b].ux), at(fields[b].uy)});
    }
    u = bent(q, mu, u);
    for (Eigen::Index a = 0; a < shape.cols(); ++a) {
      Vec2 sum;
      for (Eigen::Index v = 0; v < shape.rows(); ++v)
        sum += (mu[v] * shape(v, a)) * u[static_cast<std::size_t>(v)];
      images(2 * a, row(b)) = sum.x;
      images(2 * a + 1, row(b)) = sum.y;
    }
  }
  return images;
}

/// The motions of the corners that linear stresses make, as unit vectors among the modes, and their
/// stiffness, which is exact: the inverse of B W^-1 B^T, with the modes B and the energies W of
/// linear stresses; of all stresses that move corners alike that of least energy counts. Only those
/// that are softer than a boundary that moves by itself: corners of a block that is nearly a
/// triangle hardly tell of some.
struct BendingModes {
  Matrix axis;  ///< [2 modes][4]; 0: none
  std::array<double, bendings> kappa{};
};
BendingModes bending_modes(const BendingBlock& q, const Vector& mu, const Matrix& shape,
                           const Vector& k) {
  const double nu = plane_ratio(q);
  const LinearStresses fields = linear_stresses(nu);
  Eigen::Matrix4d energy;
  for (std::size_t b = 0; b < bendings; ++b) {
    for (std::size_t c = 0; c < bendings; ++c)
      energy(row(b), row(c)) = energy_of(q, fields[b], fields[c], nu);
  }
  const Matrix images = modes_of(q, mu, shape, fields);
  const Matrix compliance = images * energy.ldlt().solve(images.transpose());
  const Eigen::SelfAdjointEigenSolver<Matrix> soft(compliance);
  const double modulus = plane_modulus(q) * q.thickness;
  BendingModes found;
  found.axis = Matrix::Zero(images.rows(), row(bendings));
  for (std::size_t b = 0; b < bendings && row(b) < images.rows(); ++b) {
    const Eigen::Index at = images.rows() - 1 - row(b);  // the softest first
    const Vector e = soft.eigenvectors().col(at);
    double boundary = 0.0;
    for (Eigen::Index c = 0; c < e.size(); ++c) boundary += k[c / 2] * e[c] * e[c];
    if (!(soft.eigenvalues()[at] * boundary > modulus)) break;
    found.axis.col(row(b)) = e;
    found.kappa[b] = modulus / soft.eigenvalues()[at];
  }
  return found;
}

/// Mean of k_a beside the bendings: of D on what is left of the modes' components.
double rest_of(const Vector& k, const BendingModes& bending) {
  double sum = 2.0 * k.sum(), count = 2.0 * static_cast<double>(k.size());
  for (Eigen::Index b = 0; b < bending.axis.cols(); ++b) {
    if (bending.axis.col(b).squaredNorm() == 0.0) continue;
    count -= 1.0;
    for (Eigen::Index c = 0; c < bending.axis.rows(); ++c)
      sum -= k[c / 2] * bending.axis(c, b) * bending.axis(c, b);
  }
  return count > 0.5 ? sum / count : 0.0;
}

void close_block(Bending& out) {
  if (out.begin.empty()) {
    out.begin.push_back(0);
    out.shape_begin.push_back(0);
  }
  out.begin.push_back(static_cast<std::uint32_t>(out.stiffness.size()));
  out.shape_begin.push_back(out.shape.size());
}

}  // namespace

void add_modes(Bending& out, const BendingBlock& q) {
  const Vector mu = mass_parts(q), root_mu = mu.cwiseSqrt();
  const Matrix basis = without_affine_motion(q, root_mu);
  const double modulus = plane_modulus(q) * q.thickness;
  const Eigen::SelfAdjointEigenSolver<Matrix> own(
      (basis.transpose() * boundary_stiffness(q) * basis).eval());
  const Matrix shape = basis * own.eigenvectors();
  const Vector k = modulus * own.eigenvalues();
  const BendingModes bending = bending_modes(q, mu, shape, k);
  for (Eigen::Index a = 0; a < shape.cols(); ++a) {
    for (Eigen::Index v = 0; v < shape.rows(); ++v) out.shape.push_back(shape(v, a));
    out.stiffness.push_back(k[a]);
    for (std::size_t b = 0; b < bendings; ++b) {
      out.axis[b].x.push_back(bending.axis(2 * a, row(b)));
      out.axis[b].y.push_back(bending.axis(2 * a + 1, row(b)));
    }
  }
  for (std::size_t b = 0; b < bendings; ++b) out.kappa[b].push_back(bending.kappa[b]);
  out.rest_stiffness.push_back(rest_of(k, bending));
  close_block(out);
}

void add_no_modes(Bending& out) {
  for (std::vector<double>& kappa : out.kappa) kappa.push_back(0.0);
  out.rest_stiffness.push_back(0.0);
  close_block(out);
}

}  // namespace edda
