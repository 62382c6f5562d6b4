// Curves over time from CSV files.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "base/fault.hpp"
#include "model/model.hpp"

namespace edda {

/// Reads rows of two numbers, time (s) and value, separated by a comma; a first line of names,
/// empty lines and lines that start with # are skipped. Times must ascend. A fault has the file and
/// its line; `key` is the key that names the file.
Result<TimeHistory> read_time_history(const std::string& path, const std::string& key);

/// The same from text.
Result<TimeHistory> parse_time_history(std::string_view text, const std::string& path,
                                       const std::string& key);

/// The files that the model's loads, waters, boundaries, shakings and imports name, each once, in
/// their order.
std::vector<std::string> files_beside(const Model& model);

}  // namespace edda
