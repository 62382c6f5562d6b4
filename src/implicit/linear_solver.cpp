#include "implicit/linear_solver.hpp"

#include <algorithm>
#include <cmath>

#include "base/parallel.hpp"

namespace edda {
namespace {

using Vector = Eigen::VectorXd;

}  // namespace

void LinearSolver::forget_pattern() {
  ordered_ = m_.made = false;
}

double LinearSolver::work_by_factor(const BlockMatrix& a) const {
  return static_cast<double>(a.entries()) + factor_.solving();
}

double LinearSolver::work_by_diagonal(const BlockMatrix& a) const {
  return static_cast<double>(a.entries() + a.diagonal_entries());
}

void LinearSolver::order(const BlockMatrix& a) {
  if (ordered_) return;
  std::vector<int> sides;
  BlockCholesky::Pairs couples;
  for (std::size_t r = 0; r < a.rows(); ++r) {
    sides.push_back(static_cast<int>(a.lines(r)));
    for (const Id c : a.columns(r)) {
      if (c < r) couples.emplace_back(static_cast<int>(r), static_cast<int>(c));
    }
  }
  factor_ = BlockCholesky(sides, couples);
  ++counts_.orderings;
  ordered_ = true;
}

void LinearSolver::factorise(BlockMatrix& a) {
  m_.values = a.values();
  std::fill(factor_.values.begin(), factor_.values.end(), 0.0);
  for (Id r = 0; r < a.rows(); ++r) {
    const std::span<const Id> columns = a.columns(r);
    for (Id q = 0; q < columns.size(); ++q) {
      const int row = static_cast<int>(r), column = static_cast<int>(columns[q]);
      if (!factor_.is_lower(row, column)) continue;
      const BlockMatrix::Block block = a.at(r, q);
      const auto [at, stride] = factor_.block_at(row, column);
      Eigen::Map<Eigen::MatrixXd, 0, Eigen::OuterStride<>>(
          &factor_.values[at], block.rows(), block.cols(),
          Eigen::OuterStride<>(static_cast<Eigen::Index>(stride))) = block;
    }
  }
  factor_.factorise();
  ++counts_.factorisations;
  m_.made = true;
  m_.excess = m_.solved = 0.0;
  m_.life = factor_.making();
}

void LinearSolver::invert_diagonal(BlockMatrix& a) {
  diagonal_.resize(a.rows());
  parallel_for(a.rows(), [&](std::size_t r) {
    const Id row = static_cast<Id>(r);
    diagonal_[r] = BodyMatrix(a.at(row, a.slot(row, row))).inverse();
  });
}

/// Preconditioned conjugate gradients (Hestenes and Stiefel 1952).
bool LinearSolver::iterate(const BlockMatrix& a, const Vector& b, double tolerance, double most,
                           Vector& x) {
  const double enough = tolerance * b.norm();
  auto precondition = [&](const Vector& r, Vector& z) {
    if (m_.with_factor) {
      z = r;
      return factor_.solve(z.data());
    }
    z.resize(r.size());
    parallel_for(a.rows(),
                 [&](std::size_t i) { a.part(z, i).noalias() = diagonal_[i] * a.part(r, i); });
  };
  Vector r = b - a.scalar() * x, z, p, q;
  last_iterations_ = 0;
  if (!(r.norm() > enough)) return std::isfinite(r.norm());
  precondition(r, z);
  p = z;
  double rz = r.dot(z);
  while (last_iterations_ < most) {
    ++last_iterations_;
    ++counts_.iterations;
    q = a.scalar() * p;
    const double along = rz / p.dot(q);
    x += along * p;
    r -= along * q;
    const double left = r.norm();
    if (left <= enough) return true;
    if (!std::isfinite(left)) return false;
    precondition(r, z);
    const double next = r.dot(z);
    p = z + (next / rz) * p;
    rz = next;
  }
  return false;
}

bool LinearSolver::solve_by_factor(BlockMatrix& a, const Vector& b, double tolerance, Vector& x) {
  m_.with_factor = true;
  if (!m_.made) factorise(a);
  const double work = work_by_factor(a);
  const bool solved = iterate(a, b, tolerance, std::max(10.0, 2.0 * factor_.making() / work), x);
  ++m_.solved;
  m_.excess += work * std::max(0, last_iterations_ - 1);
  m_.life += work * last_iterations_;
  return solved;
}

bool LinearSolver::solve_by_diagonal(const BlockMatrix& a, const Vector& b, double tolerance,
                                     Vector& x) {
  m_.with_factor = false;
  const double work = work_by_diagonal(a);
  const double most = std::max(10.0, 2.0 * (factor_.making() + work_by_factor(a)) / work);
  const bool solved = iterate(a, b, tolerance, most, x);
  m_.by_diagonal = work * std::max(1, last_iterations_);
  m_.rent += m_.by_diagonal - 2.0 * work_by_factor(a);
  return solved;
}

void LinearSolver::recall(BlockMatrix& a, SolverMemory memory) {
  order(a);
  if (memory.made) {
    a.set_values(memory.values);
    factorise(a);
  }
  m_ = std::move(memory);
}

bool LinearSolver::solve(BlockMatrix& a, const Vector& b, double tolerance, Vector& x) {
  ++counts_.solves;
  order(a);
  const Vector guess = x;
  if (!m_.with_factor) {
    // A factor is computed when the additional work of diagonal preconditioning has reached the
    // cost of one; twenty times that cost after a factor that did no better.
    const double patience = m_.per_solve > 0.0 ? 20.0 : 1.0;
    if (m_.rent <= patience * factor_.making()) {
      invert_diagonal(a);
      if (solve_by_diagonal(a, b, tolerance, x)) return true;
      x = guess;
    }
    m_.made = false;
    m_.rent = 0.0;
    return solve_by_factor(a, b, tolerance, x);
  }
  if (m_.made && m_.excess <= factor_.making() && solve_by_factor(a, b, tolerance, x)) return true;
  // The factor is no longer efficient.
  x = guess;
  m_.per_solve = m_.solved > 0.0 ? m_.life / m_.solved : 0.0;
  m_.made = false;
  if (m_.by_diagonal > 0.0 && m_.by_diagonal < m_.per_solve) {
    m_.rent = 0.0;
    invert_diagonal(a);
    if (solve_by_diagonal(a, b, tolerance, x)) return true;
    x = guess;
  }
  return solve_by_factor(a, b, tolerance, x);
}

}  // namespace edda
