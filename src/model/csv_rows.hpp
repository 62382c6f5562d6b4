// Rows of numbers from the text of a CSV file.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "base/fault.hpp"

namespace edda {

/// What the rows of a file must be.
struct RowShape {
  std::size_t columns;
  std::string numbers;  ///< "two numbers"
  std::string write;    ///< "write time,value in each line"
  std::string example;  ///< "0.5,1.0"
};

/// Number `text` as a whole, finite; blanks round it are passed over. False if it is none.
bool parse_number(std::string_view text, double& value);

/// All numbers of rows of `shape.columns` numbers separated by commas, row after row; a first line
/// of names is passed over, and so are empty lines and those that start with #. The first column is
/// a time and must ascend. A fault carries `path` and the line; `key` is what names the file.
Result<std::vector<double>> parse_rows(std::string_view text, const RowShape& shape,
                                       const std::string& path, const std::string& key);

}  // namespace edda
