// Tables of a results folder as a page takes them along: complete rows, and not more than it needs.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace edda {

/// Without a last row that is still being written.
std::string_view complete_rows(std::string_view csv);

/// A table over time: all of it, or about `most_rows` rows, among which are the lowest and the
/// highest value of every column in every stretch of time.
std::string with_peaks(std::string_view csv, std::size_t most_rows);

/// The rows at those times (s, rising). What is not over time stays as it is.
std::string rows_at(std::string_view csv, const std::vector<double>& times);

}  // namespace edda
