#include "blocks/bending.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/corner_weights.hpp"

namespace edda {
namespace {

using Matrix = Eigen::MatrixXd;
using Vector = Eigen::VectorXd;

Eigen::Index row(std::size_t v) {
  return static_cast<Eigen::Index>(v);
}

/// mu_v: by the lengths of the edges, with the centroid as their centre; mean 1.
Vector mass_parts(const BendingBlock& q) {
  const std::vector<double> weight = corner_weights(q.corner, q.tributary);
  const auto n = row(weight.size());
  return static_cast<double>(n) * Eigen::Map<const Vector>(weight.data(), n);
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

/// Where linear stresses move the corners. B: the motions of the modes that these make, W their
/// energies; of all that move corners alike that of least energy counts, so that the motions
/// s = B c have the compliance B W^-1 B^T = U S^-1 U^T. What the modes do beside them is what D
/// does not couple with them, s - U c with G c = U^T D s, G = U^T D U, so that
///  K = D - D U G^-1 (G - S) G^-1 U^T D,
/// which no choice of axes or of a metric enters. Only of those that are softer than D: corners of
/// a block that is nearly a triangle hardly tell of some.
struct BendingModes {
  Matrix axis;  ///< e_b, [2 modes][4]; 0: none
  std::array<double, bendings> less{};
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
  const Eigen::SelfAdjointEigenSolver<Matrix> compliance(
      (images * energy.ldlt().solve(images.transpose())).eval());
  const Eigen::Index size = images.rows(), most = std::min(size, row(bendings));
  constexpr double rounding = 1e-12;
  const double least = rounding * compliance.eigenvalues()[size - 1];
  Eigen::Index rank = 0;
  while (rank < most && compliance.eigenvalues()[size - 1 - rank] > least) ++rank;
  const Matrix u = compliance.eigenvectors().rightCols(rank);
  Vector stiffness(size);  // D
  for (Eigen::Index c = 0; c < size; ++c) stiffness[c] = k[c / 2];
  const Vector exact =
      plane_modulus(q) * q.thickness * compliance.eigenvalues().tail(rank).cwiseInverse();
  const Matrix du = stiffness.asDiagonal() * u;
  const Eigen::GeneralizedSelfAdjointEigenSolver<Matrix> soft(Matrix(u.transpose() * du),
                                                              Matrix(exact.asDiagonal()));
  // D U G^-1 (G - S) G^-1 U^T D, with G c = mu S c and c.S c = 1, so that c.G c = mu.
  const Eigen::ArrayXd per = soft.eigenvalues().array().max(1.0).inverse();
  const Vector softer = ((1.0 - per) * per).sqrt();
  const Matrix root = du * soft.eigenvectors() * softer.asDiagonal();
  const Eigen::SelfAdjointEigenSolver<Matrix> less((root.transpose() * root).eval());
  BendingModes found;
  found.axis = Matrix::Zero(size, row(bendings));
  for (Eigen::Index b = 0; b < rank; ++b) {
    const double square = less.eigenvalues()[b];
    if (!(square > rounding * stiffness.maxCoeff())) continue;
    found.axis.col(b) = root * less.eigenvectors().col(b) / std::sqrt(square);
    found.less[static_cast<std::size_t>(b)] = square;
  }
  return found;
}

/// Room for the modes of the next block, which are its numbers at the places of the result. A group
/// grows by places for all of its blocks: it is the last.
ModePlaces open_block(Bending& out, std::size_t count) {
  if (out.begin.empty()) {
    out.begin.push_back(0);
    out.shape_begin.push_back(0);
  }
  const std::size_t i = out.count.size();
  if (i % group_size == 0) {
    out.begin.push_back(out.begin.back());
    for (std::vector<double>& less : out.less) less.resize(i + group_size, 0.0);
  }
  const std::size_t begin = out.begin[out.begin.size() - 2];
  const std::size_t end = std::max<std::size_t>(out.begin.back(), begin + count * group_size);
  out.begin.back() = static_cast<std::uint32_t>(end);
  out.stiffness.resize(end, 0.0);
  for (ModeVectors& axis : out.axis) {
    axis.x.resize(end, 0.0);
    axis.y.resize(end, 0.0);
  }
  out.count.push_back(static_cast<std::uint8_t>(count));
  out.shape_begin.push_back(out.shape.size());
  return {begin + i % group_size, count};
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
  const ModePlaces place = open_block(out, static_cast<std::size_t>(shape.cols()));
  for (Eigen::Index a = 0; a < shape.cols(); ++a) {
    const std::size_t at = place[static_cast<std::size_t>(a)];
    out.stiffness[at] = k[a];
    for (std::size_t b = 0; b < bendings; ++b)
      out.axis[b].set(at, {bending.axis(2 * a, row(b)), bending.axis(2 * a + 1, row(b))});
  }
  for (Eigen::Index v = 0; v < shape.rows(); ++v) {
    for (Eigen::Index a = 0; a < shape.cols(); ++a) out.shape.push_back(shape(v, a));
  }
  const std::size_t i = out.count.size() - 1;
  for (std::size_t b = 0; b < bendings; ++b) out.less[b][i] = bending.less[b];
  out.shape_begin.back() = out.shape.size();
}

void add_no_modes(Bending& out) {
  open_block(out, 0);
}

std::array<double, bendings + 1> stiffness_along(const Bending& b, const BlockModes& modes,
                                                 std::size_t i) {
  std::array<double, bendings + 1> along{};
  double rest = 0.0, left = 2.0 * static_cast<double>(modes.count);
  for (std::size_t a = 0; a < modes.count; ++a) rest += 2.0 * b.stiffness[modes[a]];
  for (std::size_t k = 0; k < bendings; ++k) {
    double square = 0.0, of_boundary = 0.0;
    for (std::size_t a = 0; a < modes.count; ++a) {
      const Vec2 e = b.axis[k][modes[a]];
      square += dot(e, e);
      of_boundary += b.stiffness[modes[a]] * dot(e, e);
    }
    if (square == 0.0) continue;
    along[k] = of_boundary - b.less[k][i];
    rest -= of_boundary;
    left -= 1.0;
  }
  along[bendings] = left > 0.5 ? rest / left : 0.0;
  return along;
}

}  // namespace edda
