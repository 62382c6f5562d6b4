// Tables of comma-separated rows, read back.
#pragma once

#include <string>
#include <vector>

#include "base/fault.hpp"

namespace edda {

struct Column {
  std::string name;
  std::vector<double> values;        ///< one per row; nan where a cell is no number
  std::vector<std::string> texts{};  ///< one per row where any cell is no number, else empty
};

struct Table {
  std::vector<Column> columns;
  std::size_t rows() const { return columns.empty() ? 0 : columns.front().values.size(); }
  /// The column of that name, or null.
  const Column* column(const std::string& name) const;
};

/// Reads what Csv writes. A last row that is not complete, as of a run that goes on, is left out. A
/// fault where there is no such file, or a row before the last has too few or too many cells.
Result<Table> read_table(const std::string& path);

}  // namespace edda
