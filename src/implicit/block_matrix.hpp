// A symmetric matrix of blocks, one row of them per free block of the model, as many lines high as
// that has components, stored in full and by rows, so that each row can be assembled independently
// and Eigen can use it directly.
#pragma once

#include <Eigen/Sparse>
#include <span>
#include <vector>

#include "forces/block_matrices.hpp"

namespace edda {

class BlockMatrix {
 public:
  using Scalar = Eigen::SparseMatrix<double, Eigen::RowMajor>;
  using Block = Eigen::Map<Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>,
                           0, Eigen::OuterStride<>>;

  /// columns[r]: the columns of row r, ascending, including r. lines[r]: its height. Values become
  /// zero.
  void set_pattern(const std::vector<std::vector<Id>>& columns,
                   const std::vector<Eigen::Index>& lines);

  /// The columns of row r, as given to set_pattern().
  std::span<const Id> columns(std::size_t r) const {
    return std::span(column_).subspan(begin_[r], begin_[r + 1] - begin_[r]);
  }
  std::size_t rows() const { return begin_.empty() ? 0 : begin_.size() - 1; }
  std::size_t blocks() const { return column_.size(); }
  /// The number of values: in all blocks, and in those of the diagonal.
  std::size_t entries() const { return static_cast<std::size_t>(scalar_.nonZeros()); }
  std::size_t diagonal_entries() const;
  /// The number of all lines, and of those of row r.
  Eigen::Index lines() const { return scalar_.rows(); }
  Eigen::Index lines(std::size_t r) const { return line_[r + 1] - line_[r]; }
  /// The part of row r in a vector of all lines.
  template <class Vector>
  auto part(Vector& v, std::size_t r) const {
    return v.segment(line_[r], lines(r));
  }
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
  std::vector<Eigen::Index> line_;    ///< [rows + 1] the first line of each row
  std::vector<Eigen::Index> offset_;  ///< [blocks] where it begins in the lines of its row
  Scalar scalar_;                     ///< N/m
};

}  // namespace edda
