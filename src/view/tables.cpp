#include "view/tables.hpp"

#include <algorithm>
#include <cmath>

#include "report/peaks.hpp"
#include "results/read_table.hpp"

namespace edda {
namespace {

/// The rows with their ends; a cell in quotes may hold a line break.
std::vector<std::string_view> rows_of(std::string_view csv) {
  std::vector<std::string_view> rows;
  bool quoted = false;
  std::size_t begin = 0;
  for (std::size_t k = 0; k < csv.size(); ++k) {
    if (csv[k] == '"') quoted = !quoted;
    if (csv[k] != '\n' || quoted) continue;
    rows.push_back(csv.substr(begin, k + 1 - begin));
    begin = k + 1;
  }
  return rows;
}

/// The first row, with the names, and the selected ones of the others.
template <class Wanted>
std::string some_rows(const std::vector<std::string_view>& rows, Wanted wanted) {
  std::string text(rows.front());
  for (std::size_t r = 0; r + 1 < rows.size(); ++r) {
    if (wanted(r)) text += rows[r + 1];
  }
  return text;
}

/// Rows with a peak of any column.
std::vector<bool> peaks_of(const Table& table, const std::vector<double>& time,
                           std::size_t slivers) {
  std::vector<bool> kept(table.rows(), false);
  for (const Column& column : table.columns) {
    if (&column.values == &time) continue;
    for (const std::size_t r : rows_with_peaks(time, column.values, slivers)) kept[r] = true;
  }
  return kept;
}

}  // namespace

std::string_view complete_rows(std::string_view csv) {
  std::size_t size = 0;
  for (const std::string_view row : rows_of(csv)) size += row.size();
  return csv.substr(0, size);
}

std::string with_peaks(std::string_view csv, std::size_t most_rows) {
  const std::vector<std::string_view> rows = rows_of(csv);
  std::string all(complete_rows(csv));
  if (rows.size() <= most_rows + 1) return all;
  const Result<Table> table = table_of(all, "");
  const Column* const time = table.ok() ? table.value().column("time") : nullptr;
  if (time == nullptr) return all;
  // The number of rows of a sliver depends on how many columns have their peaks in the same row.
  for (std::size_t slivers = std::max<std::size_t>(most_rows / 2, 1);; slivers /= 2) {
    const std::vector<bool> kept = peaks_of(table.value(), time->values, slivers);
    const auto count = static_cast<std::size_t>(std::count(kept.begin(), kept.end(), true));
    if (count <= most_rows || slivers == 1)
      return some_rows(rows, [&](std::size_t r) { return kept[r]; });
  }
}

std::string rows_at(std::string_view csv, const std::vector<double>& times) {
  std::string all(complete_rows(csv));
  const Result<Table> table = table_of(all, "");
  const Column* const time = table.ok() ? table.value().column("time") : nullptr;
  if (time == nullptr) return all;
  return some_rows(rows_of(csv), [&](std::size_t r) {
    const double t = time->values[r], rounding = 1e-9 * std::max(1.0, std::abs(t));
    const auto next = std::lower_bound(times.begin(), times.end(), t - rounding);
    return next != times.end() && *next <= t + rounding;
  });
}

}  // namespace edda
