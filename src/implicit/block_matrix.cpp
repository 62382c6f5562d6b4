#include "implicit/block_matrix.hpp"

#include <algorithm>

namespace edda {

void BlockMatrix::set_pattern(const std::vector<std::vector<Id>>& columns,
                              const std::vector<Eigen::Index>& lines) {
  begin_.assign(1, 0);
  column_.clear();
  for (const std::vector<Id>& row : columns) {
    column_.insert(column_.end(), row.begin(), row.end());
    begin_.push_back(static_cast<Id>(column_.size()));
  }
  line_.assign(1, 0);
  for (const Eigen::Index height : lines) line_.push_back(line_.back() + height);
  offset_.clear();
  Eigen::Index all = 0;
  for (std::size_t r = 0; r < rows(); ++r) {
    Eigen::Index width = 0;
    for (const Id c : columns[r]) {
      offset_.push_back(width);
      width += lines[c];
    }
    all += width * lines[r];
  }
  scalar_.resize(line_.back(), line_.back());
  scalar_.resizeNonZeros(all);
  int* outer = scalar_.outerIndexPtr();
  int* inner = scalar_.innerIndexPtr();
  std::fill_n(scalar_.valuePtr(), all, 0.0);
  int next = 0;
  for (std::size_t r = 0; r < rows(); ++r) {
    for (Eigen::Index line = 0; line < lines[r]; ++line) {
      *outer++ = next;
      for (const Id column : columns[r]) {
        for (Eigen::Index c = 0; c < lines[column]; ++c)
          inner[next++] = static_cast<int>(line_[column] + c);
      }
    }
  }
  *outer = next;
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

std::size_t BlockMatrix::diagonal_entries() const {
  Eigen::Index sum = 0;
  for (std::size_t r = 0; r < rows(); ++r) sum += lines(r) * lines(r);
  return static_cast<std::size_t>(sum);
}

BlockMatrix::Block BlockMatrix::at(Id r, Id slot) {
  const int* const outer = scalar_.outerIndexPtr() + line_[r];
  const Id q = begin_[r] + slot;
  return Block(scalar_.valuePtr() + outer[0] + offset_[q], lines(r), lines(column_[q]),
               Eigen::OuterStride<>(outer[1] - outer[0]));
}

void BlockMatrix::clear_row(Id r) {
  const int* const outer = scalar_.outerIndexPtr();
  std::fill(scalar_.valuePtr() + outer[line_[r]], scalar_.valuePtr() + outer[line_[r + 1]], 0.0);
}

}  // namespace edda
