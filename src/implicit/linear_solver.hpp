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

/// What a solver remembers from solve to solve, so that it can go on elsewhere to the same bits.
struct SolverMemory {
  bool made = false;         ///< there is a factor with numbers
  bool with_factor = false;  ///< preconditioner in use
  // All in multiplications.
  double rent = 0.0;         ///< by diagonal blocks, beyond what a factor at hand would have taken
  double excess = 0.0;       ///< with this factor, beyond one iteration a solve
  double life = 0.0;         ///< with this factor, its making included
  double solved = 0.0;       ///< solves with this factor
  double by_diagonal = 0.0;  ///< the last solve by diagonal blocks, 0: none yet
  double per_solve = 0.0;    ///< with the factor before, over its life; 0 while there was none
  std::vector<double> values;  ///< of the matrix that was factorised
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
  const SolverMemory& memory() const { return m_; }
  /// Takes up where another has left off; `a` has the pattern in force (its values are lost).
  bool recall(BlockMatrix& a, SolverMemory memory);

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
  void order(const BlockMatrix& a);
  void invert_diagonal(BlockMatrix& a);
  double work_by_factor(const BlockMatrix& a) const;    ///< of one iteration, multiplications
  double work_by_diagonal(const BlockMatrix& a) const;  ///< the same

  std::unique_ptr<Factor> factor_;
  std::vector<Matrix6> diagonal_;  ///< inverses of the diagonal blocks
  bool ordered_ = false;           ///< the factor knows the pattern
  SolverMemory m_;
  int last_iterations_ = 0;
  SolverCounts counts_;
};

}  // namespace edda
