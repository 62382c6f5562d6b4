// A symmetric matrix of 6 x 6 blocks, one row of blocks per free block of the model, kept whole and
// by rows, so that every row can be assembled on its own and Eigen can read it as it is.
#pragma once

#include <Eigen/Sparse>
#include <vector>

#include "forces/block_matrices.hpp"

namespace edda {

class BlockMatrix {
 public:
  using Scalar = Eigen::SparseMatrix<double, Eigen::RowMajor>;
  using Block = Eigen::Map<Eigen::Matrix<double, 6, 6, Eigen::RowMajor>, 0, Eigen::OuterStride<>>;

  /// columns[r]: the columns of row r, ascending, r itself among them. Values become zero.
  void set_pattern(const std::vector<std::vector<Id>>& columns);

  /// As it was given to set_pattern().
  std::vector<std::vector<Id>> pattern() const;
  std::size_t rows() const { return begin_.empty() ? 0 : begin_.size() - 1; }
  std::size_t blocks() const { return column_.size(); }
  /// Slot of column c in row r, or no_id.
  Id slot(Id r, Id c) const;
  Block at(Id r, Id slot);
  void clear_row(Id r);
  const Scalar& scalar() const { return scalar_; }
  /// Values in the order of scalar(), for a matrix of the same pattern.
  std::vector<double> values() const;
  void set_values(const std::vector<double>& values);

 private:
  std::vector<Id> begin_, column_;
  Scalar scalar_;  ///< [6 rows][6 rows], N/m
};

}  // namespace edda
