#include "implicit/block_matrix.hpp"

#include <algorithm>

namespace edda {

void BlockMatrix::set_pattern(const std::vector<std::vector<Id>>& columns) {
  begin_.assign(1, 0);
  column_.clear();
  for (const std::vector<Id>& row : columns) {
    column_.insert(column_.end(), row.begin(), row.end());
    begin_.push_back(static_cast<Id>(column_.size()));
  }
  const auto n = static_cast<Eigen::Index>(degrees_of_freedom * rows());
  const auto all = static_cast<Eigen::Index>(entries * blocks());
  scalar_.resize(n, n);
  scalar_.resizeNonZeros(all);
  int* outer = scalar_.outerIndexPtr();
  int* inner = scalar_.innerIndexPtr();
  std::fill_n(scalar_.valuePtr(), all, 0.0);
  int next = 0;
  for (std::size_t r = 0; r < rows(); ++r) {
    for (std::size_t line = 0; line < degrees_of_freedom; ++line) {
      *outer++ = next;
      for (Id q = begin_[r]; q < begin_[r + 1]; ++q) {
        for (std::size_t c = 0; c < degrees_of_freedom; ++c) {
          inner[next++] = static_cast<int>(degrees_of_freedom * column_[q] + c);
        }
      }
    }
  }
  *outer = next;
}

std::vector<std::vector<Id>> BlockMatrix::pattern() const {
  std::vector<std::vector<Id>> columns(rows());
  for (std::size_t r = 0; r < rows(); ++r) {
    columns[r].assign(column_.begin() + begin_[r], column_.begin() + begin_[r + 1]);
  }
  return columns;
}

std::vector<double> BlockMatrix::values() const {
  return {scalar_.valuePtr(), scalar_.valuePtr() + scalar_.nonZeros()};
}

void BlockMatrix::set_values(const std::vector<double>& values) {
  std::copy(values.begin(), values.end(), scalar_.valuePtr());
}

Id BlockMatrix::slot(Id r, Id c) const {
  const auto first = column_.begin() + begin_[r], last = column_.begin() + begin_[r + 1];
  const auto found = std::lower_bound(first, last, c);
  return found != last && *found == c ? static_cast<Id>(found - first) : no_id;
}

BlockMatrix::Block BlockMatrix::at(Id r, Id slot) {
  const std::size_t line = degrees_of_freedom * (begin_[r + 1] - begin_[r]);
  double* first = scalar_.valuePtr() + entries * begin_[r] + degrees_of_freedom * slot;
  return Block(first, Eigen::OuterStride<>(static_cast<Eigen::Index>(line)));
}

void BlockMatrix::clear_row(Id r) {
  std::fill_n(scalar_.valuePtr() + entries * begin_[r], entries * (begin_[r + 1] - begin_[r]), 0.0);
}

}  // namespace edda
