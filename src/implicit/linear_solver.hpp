// The global solve: conjugate gradients, preconditioned by the last factor of the matrix as long as
// that is efficient, or by its diagonal blocks where that is cheaper. With a factor of the matrix
// itself the first iteration is the direct solution. Theory, section 12.4.
//
// Costs are counted in multiplications and never measured by the clock, so that the bits of a run
// do not depend on the machine's load.
#pragma once

#include <Eigen/Sparse>
#include <cstdint>
#include <vector>

#include "base/block_cholesky.hpp"
#include "implicit/block_matrix.hpp"

namespace edda {

struct SolverCounts {
  std::uint64_t solves = 0;
  std::uint64_t iterations = 0;
  std::uint64_t factorisations = 0;
  std::uint64_t orderings = 0;  ///< symbolic factorisations
};

/// Data that a solver carries from solve to solve; with them another solver continues to the same
/// bits.
struct SolverMemory {
  bool made = false;         ///< a numerical factor exists
  bool with_factor = false;  ///< the preconditioner in use is the factor
  // Costs, in multiplications:
  double rent = 0.0;         ///< with diagonal blocks, in excess of what a factor would have taken
  double excess = 0.0;       ///< with this factor, in excess of one iteration per solve
  double life = 0.0;         ///< with this factor, including its computation
  double solved = 0.0;       ///< solves with this factor
  double by_diagonal = 0.0;  ///< the last solve by diagonal blocks, 0: none yet
  double per_solve = 0.0;    ///< average with the last factor; 0 before the first one
  std::vector<double> values;  ///< values of the factorised matrix
};

class LinearSolver {
 public:
  LinearSolver() = default;
  /// A copy starts without the factor.
  LinearSolver(const LinearSolver&) {}
  LinearSolver& operator=(const LinearSolver&) = delete;
  LinearSolver(LinearSolver&&) = default;
  LinearSolver& operator=(LinearSolver&&) = default;

  /// Declares the pattern of the matrix changed: its rows are ordered again for the next factor.
  void forget_pattern();
  /// Solves A x = b to |A x - b| <= tolerance |b|; on entry x is a first guess. False if it fails,
  /// which for a positive definite matrix means that its values are out of range.
  bool solve(BlockMatrix& a, const Eigen::VectorXd& b, double tolerance, Eigen::VectorXd& x);
  const SolverCounts& counts() const { return counts_; }
  const SolverMemory& memory() const { return m_; }
  /// Continues from the memory of another solver; `a` has the present pattern (its values are
  /// overwritten).
  void recall(BlockMatrix& a, SolverMemory memory);

 private:
  /// Conjugate gradients with the preconditioner in use, at most `most` iterations.
  bool iterate(const BlockMatrix& a, const Eigen::VectorXd& b, double tolerance, double most,
               Eigen::VectorXd& x);
  bool solve_by_diagonal(const BlockMatrix& a, const Eigen::VectorXd& b, double tolerance,
                         Eigen::VectorXd& x);
  bool solve_by_factor(BlockMatrix& a, const Eigen::VectorXd& b, double tolerance,
                       Eigen::VectorXd& x);
  void factorise(BlockMatrix& a);
  void order(const BlockMatrix& a);
  void invert_diagonal(BlockMatrix& a);
  double work_by_factor(const BlockMatrix& a) const;    ///< per iteration, multiplications
  double work_by_diagonal(const BlockMatrix& a) const;  ///< the same

  BlockCholesky factor_;
  std::vector<BodyMatrix> diagonal_;  ///< inverses of the diagonal blocks
  bool ordered_ = false;              ///< the factor has the symbolic factorisation of the pattern
  SolverMemory m_;
  int last_iterations_ = 0;
  SolverCounts counts_;
};

}  // namespace edda
