#include "implicit/linear_solver.hpp"

#include <algorithm>
#include <cmath>

#include "base/parallel.hpp"

namespace edda {
namespace {

using Vector = Eigen::VectorXd;

}  // namespace
/// Orders blocks instead of single rows: the graph is degrees_of_freedom times smaller, and the
/// rows of a block stay together.
struct BlockOrdering {
  using PermutationType = Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int>;
  template <class Matrix>
  void operator()(const Matrix& a, PermutationType& p) const {
    using Graph = Eigen::SparseMatrix<double, Eigen::ColMajor, int>;
    constexpr Eigen::Index lines = degrees_of_freedom;
    const Eigen::Index blocks = a.cols() / lines;
    std::vector<Eigen::Triplet<double>> edges;
    for (Eigen::Index j = 0; j < blocks; ++j) {
      for (typename Matrix::InnerIterator it(a, lines * j); it; ++it) {
        if (it.row() % lines == 0) edges.emplace_back(it.row() / lines, j, 1.0);
      }
    }
    Graph graph(blocks, blocks);
    graph.setFromTriplets(edges.begin(), edges.end());
    PermutationType of_blocks;
    Eigen::AMDOrdering<int>()(graph, of_blocks);
    p.resize(a.cols());
    for (Eigen::Index j = 0; j < blocks; ++j) {
      for (int r = 0; r < lines; ++r) {
        p.indices()[lines * j + r] = static_cast<int>(lines) * of_blocks.indices()[j] + r;
      }
    }
  }
};

struct LinearSolver::Factor
    : Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>, Eigen::Lower, BlockOrdering> {
  using Matrix = Eigen::SparseMatrix<double>;
  /// Multiplications to compute the factor, and to solve with it.
  double making() const {
    const int* outer = m_matrix.outerIndexPtr();
    double sum = 0.0;
    for (Eigen::Index j = 0; j < m_matrix.cols(); ++j) {
      const double n = outer[j + 1] - outer[j];
      sum += n * n;
    }
    return sum;
  }
  double using_it() const { return 2.0 * m_matrix.outerIndexPtr()[m_matrix.cols()]; }
};

LinearSolver::LinearSolver() : factor_(std::make_unique<Factor>()) {}
LinearSolver::LinearSolver(const LinearSolver&) : LinearSolver() {}
LinearSolver::~LinearSolver() = default;
LinearSolver::LinearSolver(LinearSolver&&) noexcept = default;
LinearSolver& LinearSolver::operator=(LinearSolver&&) noexcept = default;

void LinearSolver::forget_pattern() {
  ordered_ = m_.made = false;
}

double LinearSolver::work_by_factor(const BlockMatrix& a) const {
  return static_cast<double>(a.entries * a.blocks()) + factor_->using_it();
}

double LinearSolver::work_by_diagonal(const BlockMatrix& a) const {
  return static_cast<double>(a.entries * (a.blocks() + a.rows()));
}

/// The matrix by columns: since it is symmetric, these are its rows.
static Eigen::Map<const Eigen::SparseMatrix<double>> by_columns(const BlockMatrix& a) {
  const BlockMatrix::Scalar& m = a.scalar();
  return {m.rows(), m.cols(), m.nonZeros(), m.outerIndexPtr(), m.innerIndexPtr(), m.valuePtr()};
}

void LinearSolver::order(const BlockMatrix& a) {
  if (ordered_) return;
  factor_->analyzePattern(by_columns(a));
  ++counts_.orderings;
  ordered_ = true;
}

bool LinearSolver::factorise(const BlockMatrix& a) {
  m_.values = a.values();
  factor_->factorize(by_columns(a));
  ++counts_.factorisations;
  m_.made = factor_->info() == Eigen::Success;
  m_.excess = m_.solved = 0.0;
  m_.life = factor_->making();
  return m_.made;
}

void LinearSolver::invert_diagonal(BlockMatrix& a) {
  diagonal_.resize(a.rows());
  parallel_for(a.rows(), [&](std::size_t r) {
    const Id row = static_cast<Id>(r);
    diagonal_[r] = NodalMatrix(a.at(row, a.slot(row, row))).inverse();
  });
}

/// Preconditioned conjugate gradients (Hestenes and Stiefel 1952).
bool LinearSolver::iterate(const BlockMatrix& a, const Vector& b, double tolerance, double most,
                           Vector& x) {
  const double enough = tolerance * b.norm();
  auto precondition = [&](const Vector& r, Vector& z) {
    if (m_.with_factor) {
      z = factor_->solve(r);
      return;
    }
    z.resize(r.size());
    parallel_for(a.rows(), [&](std::size_t i) { part_of(z, i) = diagonal_[i] * part_of(r, i); });
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

bool LinearSolver::solve_by_factor(const BlockMatrix& a, const Vector& b, double tolerance,
                                   Vector& x) {
  m_.with_factor = true;
  if (!m_.made && !factorise(a)) return false;
  const double work = work_by_factor(a);
  const bool solved = iterate(a, b, tolerance, std::max(10.0, 2.0 * factor_->making() / work), x);
  ++m_.solved;
  m_.excess += work * std::max(0, last_iterations_ - 1);
  m_.life += work * last_iterations_;
  return solved;
}

bool LinearSolver::solve_by_diagonal(const BlockMatrix& a, const Vector& b, double tolerance,
                                     Vector& x) {
  m_.with_factor = false;
  const double work = work_by_diagonal(a);
  const double most = std::max(10.0, 2.0 * (factor_->making() + work_by_factor(a)) / work);
  const bool solved = iterate(a, b, tolerance, most, x);
  m_.by_diagonal = work * std::max(1, last_iterations_);
  m_.rent += m_.by_diagonal - 2.0 * work_by_factor(a);
  return solved;
}

bool LinearSolver::recall(BlockMatrix& a, SolverMemory memory) {
  order(a);
  m_ = std::move(memory);
  if (!m_.made) return true;
  a.set_values(m_.values);
  factor_->factorize(by_columns(a));
  return factor_->info() == Eigen::Success;
}

bool LinearSolver::solve(BlockMatrix& a, const Vector& b, double tolerance, Vector& x) {
  ++counts_.solves;
  order(a);
  const Vector guess = x;
  if (!m_.with_factor) {
    // A factor is computed when the additional work of diagonal preconditioning has reached the
    // cost of one; twenty times that cost after a factor that did no better.
    const double patience = m_.per_solve > 0.0 ? 20.0 : 1.0;
    if (m_.rent <= patience * factor_->making()) {
      invert_diagonal(a);
      if (solve_by_diagonal(a, b, tolerance, x)) return true;
      x = guess;
    }
    m_.made = false;
    m_.rent = 0.0;
    return solve_by_factor(a, b, tolerance, x);
  }
  if (m_.made && m_.excess <= factor_->making() && solve_by_factor(a, b, tolerance, x)) return true;
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
