// Tables of a results folder as a page contains them: complete rows, and only those that it needs.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace edda {

/// The table without a last row that is still being written.
std::string_view complete_rows(std::string_view csv);

/// A table over time: all of it, or about `most_rows` rows, among which are the lowest and the
/// highest value of every column in every stretch of time.
std::string with_peaks(std::string_view csv, std::size_t most_rows);

/// The rows at these times (s, ascending). A table that is not over time is not changed.
std::string rows_at(std::string_view csv, const std::vector<double>& times);

}  // namespace edda
