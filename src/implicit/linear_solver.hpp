// The global solve: conjugate gradients, preconditioned by the last factor of the matrix while it
// serves, or by its diagonal blocks where that is cheaper. With a factor of the matrix itself the
// first iteration is the direct solution.
//
// What is cheaper is reckoned in multiplications, never by the clock, so that the bits of a run do
// not depend on the machine's mood.
#pragma once

#include <Eigen/Sparse>
#include <cstdint>
#include <memory>

#include "implicit/block_matrix.hpp"

namespace edda {

struct SolverCounts {
  std::uint64_t solves = 0;
  std::uint64_t iterations = 0;
  std::uint64_t factorisations = 0;
  std::uint64_t orderings = 0;  ///< symbolic factorisations
};

class LinearSolver {
 public:
  LinearSolver();
  ~LinearSolver();
  /// A copy starts without the factor.
  LinearSolver(const LinearSolver&);
  LinearSolver& operator=(const LinearSolver&) = delete;
  LinearSolver(LinearSolver&&) noexcept;
  LinearSolver& operator=(LinearSolver&&) noexcept;

  /// The pattern of the matrix is a new one: orders its rows anew when the next factor is made.
  void forget_pattern();
  /// Solves A x = b to |A x - b| <= tolerance |b|; at entry x is a first guess. False if it cannot,
  /// which for a positive definite matrix means that its numbers are out of range.
  bool solve(BlockMatrix& a, const Eigen::VectorXd& b, double tolerance, Eigen::VectorXd& x);
  const SolverCounts& counts() const { return counts_; }

 private:
  struct Factor;
  /// Conjugate gradients with the preconditioner in use; at most so many iterations.
  bool iterate(const BlockMatrix& a, const Eigen::VectorXd& b, double tolerance, double most,
               Eigen::VectorXd& x);
  bool solve_by_diagonal(const BlockMatrix& a, const Eigen::VectorXd& b, double tolerance,
                         Eigen::VectorXd& x);
  bool solve_by_factor(const BlockMatrix& a, const Eigen::VectorXd& b, double tolerance,
                       Eigen::VectorXd& x);
  bool factorise(const BlockMatrix& a);
  void invert_diagonal(BlockMatrix& a);
  double work_by_factor(const BlockMatrix& a) const;    ///< of one iteration, multiplications
  double work_by_diagonal(const BlockMatrix& a) const;  ///< the same

  std::unique_ptr<Factor> factor_;
  std::vector<Matrix6> diagonal_;  ///< inverses of the diagonal blocks
  bool ordered_ = false;           ///< the factor knows the pattern
  bool made_ = false;              ///< and its numbers
  bool with_factor_ = false;       ///< preconditioner in use
  // All in multiplications.
  double rent_ = 0.0;         ///< by diagonal blocks, beyond what a factor at hand would have taken
  double excess_ = 0.0;       ///< with this factor, beyond one iteration a solve
  double life_ = 0.0;         ///< with this factor, its making included
  double solved_ = 0.0;       ///< solves with this factor
  double by_diagonal_ = 0.0;  ///< the last solve by diagonal blocks, 0: none yet
  double per_solve_ = 0.0;    ///< with the factor before, over its life; 0 while there was none
  int last_iterations_ = 0;
  SolverCounts counts_;
};

}  // namespace edda
