// Rows of numbers from the text of a CSV file.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "base/fault.hpp"

namespace edda {

/// The form that the rows of a file must have.
struct RowShape {
  std::size_t columns;
  std::string numbers;                               ///< "two numbers"
  std::string write;                                 ///< "write time,value in each line"
  std::string example;                               ///< "0.5,1.0"
  std::vector<std::vector<std::string_view>> names;  ///< [columns] those of each column, lower case
};

/// Reads the whole of `text` as a finite number, ignoring blanks around it. False if it is none.
bool parse_number(std::string_view text, double& value);

/// All numbers of rows of `shape.columns` numbers separated by commas, row after row; a byte order
/// mark, a first line of names, empty lines and lines that start with # are skipped. Columns have
/// their order whatever they are called, but the name of another column is a fault. The first
/// column is a time and must ascend. A fault has `path` and the line; `key` is the key that names
/// the file.
Result<std::vector<double>> parse_rows(std::string_view text, const RowShape& shape,
                                       const std::string& path, const std::string& key);

}  // namespace edda
