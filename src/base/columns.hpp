// Tables of numbers, one row per element, whose numbers lie side by side.
//
// The columns of a table are a struct of fields, `template <class C> struct Fields { C a, b; };`,
// which is Fields<RowColumn> for access by the number of a row, Fields<double> for one row, and a
// list of these fields, `template <class C> constexpr Field<C> list[]`, whose entries have the
// field as `values`.
#pragma once

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <iterator>
#include <new>
#include <utility>
#include <vector>

namespace edda {

/// Memory aligned to cache lines; otherwise every load of eight numbers would touch two of them.
template <class T>
struct InWholeLines {
  using value_type = T;
  InWholeLines() = default;
  template <class U>
  InWholeLines(const InWholeLines<U>&) {}  // NOLINT(google-explicit-constructor): as allocators do
  T* allocate(std::size_t n) { return static_cast<T*>(::operator new(n * sizeof(T), line)); }
  void deallocate(T* at, std::size_t) { ::operator delete(at, line); }
  bool operator==(const InWholeLines&) const = default;
  static constexpr std::align_val_t line{64};
};

/// As resize(), but for the values that were there, and with little room to spare where memory
/// grows: std::vector would double it. Of size 0 nothing is kept.
template <class Vector>
void resize_afresh(Vector& values, std::size_t size) {
  if (size > values.capacity() || size == 0) {
    values = Vector();
    values.reserve(size + size / 16);
  }
  values.resize(size);
}

/// One column of a table, [rows].
class RowColumn {
 public:
  RowColumn() = default;
  /// first: of row 0; stride: numbers from row to row.
  RowColumn(double* first, std::size_t stride, std::size_t rows)
      : first_(first), stride_(stride), rows_(rows) {}

  double operator[](std::size_t row) const { return first_[row * stride_]; }
  double& operator[](std::size_t row) { return first_[row * stride_]; }
  std::size_t size() const { return rows_; }

  void fill(double value) {
    for (std::size_t row = 0; row < rows_; ++row) (*this)[row] = value;
  }
  std::vector<double> values() const {
    std::vector<double> all(rows_);
    for (std::size_t row = 0; row < rows_; ++row) all[row] = (*this)[row];
    return all;
  }
  void take(const std::vector<double>& values) {  ///< [rows]
    assert(values.size() == rows_);
    for (std::size_t row = 0; row < rows_; ++row) (*this)[row] = values[row];
  }

 private:
  double* first_ = nullptr;
  std::size_t stride_ = 0, rows_ = 0;
};

/// Rows with the columns that `list` names.
template <class Columns, const auto& list>
class RowTable : public Columns {
 public:
  RowTable() = default;
  RowTable(const RowTable& other) : Columns(), cells_(other.cells_), rows_(other.rows_) { bind(); }
  RowTable(RowTable&& other) noexcept
      : cells_(std::exchange(other.cells_, {})), rows_(std::exchange(other.rows_, 0)) {
    bind();
    other.bind();
  }
  RowTable& operator=(RowTable other) noexcept {
    cells_.swap(other.cells_);
    rows_ = other.rows_;
    bind();
    return *this;
  }
  ~RowTable() = default;

  std::size_t rows() const { return rows_; }
  /// Sets all values to 0.
  void clear_rows(std::size_t rows) {
    rows_ = rows;
    cells_.assign(rows * columns, 0.0);
    bind();
  }
  /// As many rows, of any values.
  void set_rows(std::size_t rows) {
    rows_ = 0;  // where there is no memory
    resize_afresh(cells_, rows * columns);
    rows_ = rows;
    bind();
  }
  /// Sets the values of a row to 0.
  void clear_row(std::size_t row) { std::fill_n(&cells_[row * columns], columns, 0.0); }
  /// Copies row `from` of another table to `row`.
  void copy_row(std::size_t row, const RowTable& other, std::size_t from) {
    std::copy_n(&other.cells_[from * columns], columns, &cells_[row * columns]);
  }

 private:
  static constexpr std::size_t columns = std::size(list);
  static_assert(sizeof(Columns) == columns * sizeof(RowColumn), "a field is not listed");

  void bind() {
    for (std::size_t i = 0; i < columns; ++i) {
      double* const begin = cells_.empty() ? nullptr : cells_.data() + i;
      this->*list[i].values = RowColumn(begin, columns, rows_);
    }
  }
  std::vector<double> cells_;
  std::size_t rows_ = 0;
};

}  // namespace edda
