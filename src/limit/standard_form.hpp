// A linear program in the form min c'x with A x = b, in which each variable is free, or at least 0
// and at most u.
#pragma once

#include <Eigen/SparseCore>
#include <vector>

#include "limit/linear_program.hpp"

namespace edda {

struct StandardForm {
  Eigen::SparseMatrix<double> a;  ///< [rows][columns]
  Eigen::VectorXd b, c;
  Eigen::VectorXd u;          ///< [columns]; 0 where there is no upper bound
  std::vector<char> free;     ///< [columns] 1: may be negative
  std::vector<char> bounded;  ///< [columns] 1: at most u

  /// Variable j of the program is shift + sign times x of its column; no column: it is fixed.
  struct Origin {
    int column = -1;
    double shift = 0.0, sign = 1.0;
  };
  std::vector<Origin> origin;  ///< [columns of the program]

  explicit StandardForm(const LinearProgram& program);
  std::vector<double> variables(const Eigen::VectorXd& x) const;
  Eigen::VectorXd sums(const Eigen::VectorXd& x) const;   ///< A x
  Eigen::VectorXd worth(const Eigen::VectorXd& y) const;  ///< A'y, by this thread alone
};

}  // namespace edda
