// Tables of comma-separated rows, read back.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "base/fault.hpp"

namespace edda {

struct Column {
  std::string name;
  std::vector<double> values;  ///< one per row; nan where a cell is no number
  std::vector<std::string>
      texts{};  ///< one per row where numbers do not represent all cells, else empty
  /// The cell as written in the file.
  std::string text(std::size_t row) const;
};

struct Table {
  std::vector<Column> columns;
  std::size_t rows() const { return columns.empty() ? 0 : columns.front().values.size(); }
  /// The column of that name, or null.
  const Column* column(const std::string& name) const;
};

/// Reads what Csv writes. An incomplete last row, as of a run in progress, is left out. A
/// fault where there is no such file, or a row before the last has too few or too many cells.
Result<Table> read_table(const std::string& path);
/// The same of a table's text; faults name `path`.
Result<Table> table_of(std::string_view text, const std::string& path);

}  // namespace edda
