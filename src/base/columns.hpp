// Tables of numbers, one row per element, stored in chunks of rows:
// [chunk][column][16]. A loop over several elements at once (base/vector_loop.hpp) so reads one
// contiguous piece of memory, and the address of a column follows from that of the chunk.
//
// The columns of a table are a struct of fields, `template <class C> struct Fields { C a, b; };`,
// which is Fields<ChunkColumn> for access by the number of a row, Fields<double*> for a loop
// over one chunk, and a list of these fields, `template <class C> constexpr Field<C> list[]`, whose
// entries have the field as `values`.
#pragma once

#include <cassert>
#include <cstddef>
#include <iterator>
#include <new>
#include <utility>
#include <vector>

#include "base/vector_loop.hpp"

namespace edda {

inline constexpr std::size_t chunk_rows = 16;

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
class ChunkColumn {
 public:
  ChunkColumn() = default;
  /// first: of row 0; stride: numbers from chunk to chunk.
  ChunkColumn(double* first, std::size_t stride, std::size_t rows)
      : first_(first), stride_(stride), rows_(rows) {}

  double operator[](std::size_t row) const { return first_[place(row)]; }
  double& operator[](std::size_t row) { return first_[place(row)]; }
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
  std::size_t place(std::size_t row) const { return row / chunk_rows * stride_ + row % chunk_rows; }
  double* first_ = nullptr;
  std::size_t stride_ = 0, rows_ = 0;
};

/// Rows with the columns that `list` names. The last chunk is filled up with rows that clear_rows()
/// leaves at zero; a loop over it may need other numbers there.
template <class Columns, const auto& list>
class ChunkTable : public Columns {
 public:
  ChunkTable() = default;
  ChunkTable(const ChunkTable& other) : Columns(), cells_(other.cells_), rows_(other.rows_) {
    bind();
  }
  ChunkTable(ChunkTable&& other) noexcept
      : cells_(std::exchange(other.cells_, {})), rows_(std::exchange(other.rows_, 0)) {
    bind();
    other.bind();
  }
  ChunkTable& operator=(ChunkTable other) noexcept {
    cells_.swap(other.cells_);
    rows_ = other.rows_;
    bind();
    return *this;
  }
  ~ChunkTable() = default;

  std::size_t rows() const { return rows_; }
  /// Sets all values to 0.
  void clear_rows(std::size_t rows) {
    rows_ = rows;
    cells_.assign((rows + chunk_rows - 1) / chunk_rows * stride, 0.0);
    bind();
  }
  /// As many rows, of any values; those that fill up the last chunk are 0.
  void set_rows(std::size_t rows) {
    rows_ = 0;  // where there is no memory
    resize_afresh(cells_, (rows + chunk_rows - 1) / chunk_rows * stride);
    rows_ = rows;
    bind();
    for (std::size_t row = rows; row % chunk_rows != 0; ++row) clear_row(row);
  }
  /// Sets the values of a row to 0.
  void clear_row(std::size_t row) {
    double* const first = begin_of_chunk(row / chunk_rows) + row % chunk_rows;
    for (std::size_t i = 0; i < std::size(list); ++i) first[i * chunk_rows] = 0.0;
  }
  /// Copies row `from` of another table to `row`, in the chosen columns.
  template <class Choice>
  void copy_row(std::size_t row, const ChunkTable& other, std::size_t from, Choice chosen) {
    double* const to = begin_of_chunk(row / chunk_rows) + row % chunk_rows;
    const double* const is = other.begin_of_chunk(from / chunk_rows) + from % chunk_rows;
    for (std::size_t i = 0; i < std::size(list); ++i) {
      if (chosen(list[i])) to[i * chunk_rows] = is[i * chunk_rows];
    }
  }
  void copy_row(std::size_t row, const ChunkTable& other, std::size_t from) {
    copy_row(row, other, from, [](const auto&) { return true; });
  }
  double* begin_of_chunk(std::size_t q) { return cells_.data() + q * stride; }
  const double* begin_of_chunk(std::size_t q) const { return cells_.data() + q * stride; }

  static constexpr std::size_t stride = std::size(list) * chunk_rows;
  static_assert(sizeof(Columns) == std::size(list) * sizeof(ChunkColumn), "a field is not listed");

 private:
  void bind() {
    for (std::size_t i = 0; i < std::size(list); ++i) {
      double* const begin = cells_.empty() ? nullptr : cells_.data() + i * chunk_rows;
      this->*list[i].values = ChunkColumn(begin, stride, rows_);
    }
  }
  std::vector<double, InWholeLines<double>> cells_;
  std::size_t rows_ = 0;
};

/// The columns of a chunk, for a loop over its rows 0 to 15.
template <class Fields, const auto& list, class Number>
EDDA_INLINE Fields columns_of_chunk(Number* chunk) {
  Fields fields;
  static_assert(sizeof(Fields) == std::size(list) * sizeof(Number*), "a field is not listed");
  [&]<std::size_t... i>(std::index_sequence<i...>) __attribute__((always_inline)) {
    ((fields.*list[i].values = chunk + i * chunk_rows), ...);
  }
  (std::make_index_sequence<std::size(list)>{});
  return fields;
}

}  // namespace edda
