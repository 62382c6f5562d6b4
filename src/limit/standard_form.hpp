// A linear program in the form min c'x with A x = b, in which each variable is at least 0 or free.
#pragma once

#include <Eigen/SparseCore>
#include <vector>

#include "limit/linear_program.hpp"

namespace edda {

struct StandardForm {
  Eigen::SparseMatrix<double> a;  ///< [rows][columns]
  Eigen::VectorXd b, c;
  std::vector<char> free;  ///< [columns] 1: may be negative

  /// Variable j of the program is shift + sign times x of its column; no column: it is fixed.
  struct Origin {
    int column = -1;
    double shift = 0.0, sign = 1.0;
  };
  std::vector<Origin> origin;    ///< [columns of the program]
  std::size_t program_rows = 0;  ///< rows of the program, which come first

  explicit StandardForm(const LinearProgram& program);
  std::vector<double> variables(const Eigen::VectorXd& x) const;
};

}  // namespace edda
