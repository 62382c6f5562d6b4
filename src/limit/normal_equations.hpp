// The linear equations of each round of the interior-point method.
#pragma once

#include <Eigen/Cholesky>
#include <Eigen/SparseCore>
#include <vector>

#include "base/block_cholesky.hpp"
#include "limit/standard_form.hpp"

namespace edda {

/// Solves for x and y, with theta > 0 for all columns but free ones, where it is 0,
///
///   -theta x + A'y = p,   A x + delta y = q,
///
/// where delta = 1e-5 holds the prices back (a proximal step; Friedlander and Orban 2012): where
/// forces are few rows depend on each other, and without it no digit of y would be right. What it
/// takes from the rows vanishes with the steps that y still makes. By the factors of M = sum a_j
/// a_j'/theta_j over columns with few entries and, for the others and the free ones, F, by those of
/// F' M^-1 F + theta_F:
///
///   (M + delta) y + F x_F = q + sum a_j p_j/theta_j,   F'y - theta_F x_F = p_F,
///   x_j = (a_j'y - p_j)/theta_j.
///
/// To M and to the right-hand side F'y = p_F is added F times, for free columns with few entries,
/// which changes nothing but that rows with free columns alone have a diagonal.
class NormalEquations {
 public:
  using Vector = Eigen::VectorXd;
  explicit NormalEquations(const StandardForm& p);

  void factorise(const Vector& theta);
  void solve(const Vector& p, const Vector& q, Vector& x, Vector& y) const;

 private:
  struct Step {
    Vector y, beside;
  };
  Step solve_once(const Vector& of_rows, const Vector& of_beside) const;
  Vector by_factors(const Vector& right) const;
  void find_places();

  const StandardForm& p_;
  std::vector<Eigen::Index> beside_columns_;  // F
  std::vector<std::size_t> target_;  // of the products of each column, in the values of factors
  BlockCholesky factors_;
  Vector inverse_;                      // [columns] 1/theta; 0 for those of F
  Vector theta_;                        // of F
  Eigen::MatrixXd beside_;              // M^-1 F
  Eigen::LDLT<Eigen::MatrixXd> small_;  // F' M^-1 F + theta_F
};

}  // namespace edda
