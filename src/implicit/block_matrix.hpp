// A symmetric matrix of NodalMatrix blocks, one row of blocks per free block of the model, stored
// in full and by rows, so that each row can be assembled independently and Eigen can use it
// directly.
#pragma once

#include <Eigen/Sparse>
#include <vector>

#include "forces/block_matrices.hpp"

namespace edda {

/// The part of row `row` of blocks in a vector of all of them.
template <class Vector>
auto part_of(Vector& v, std::size_t row) {
  return v.template segment<degrees_of_freedom>(
      static_cast<Eigen::Index>(degrees_of_freedom * row));
}

class BlockMatrix {
 public:
  using Scalar = Eigen::SparseMatrix<double, Eigen::RowMajor>;
  using Block =
      Eigen::Map<Eigen::Matrix<double, degrees_of_freedom, degrees_of_freedom, Eigen::RowMajor>, 0,
                 Eigen::OuterStride<>>;

  /// columns[r]: the columns of row r, ascending, including r. Values become zero.
  void set_pattern(const std::vector<std::vector<Id>>& columns);

  /// The pattern as given to set_pattern().
  std::vector<std::vector<Id>> pattern() const;
  std::size_t rows() const { return begin_.empty() ? 0 : begin_.size() - 1; }
  std::size_t blocks() const { return column_.size(); }
  static constexpr std::size_t entries = degrees_of_freedom * degrees_of_freedom;  ///< of a block
  /// Position of column c in row r, or no_id.
  Id slot(Id r, Id c) const;
  Block at(Id r, Id slot);
  void clear_row(Id r);
  const Scalar& scalar() const { return scalar_; }
  /// Values in the order of scalar(), for a matrix of the same pattern.
  std::vector<double> values() const;
  void set_values(const std::vector<double>& values);

 private:
  std::vector<Id> begin_, column_;
  Scalar scalar_;  ///< [degrees_of_freedom * rows][the same], N/m
};

}  // namespace edda
