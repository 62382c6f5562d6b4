#include "model/files/csv_rows.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <optional>

#include "base/text.hpp"
#include "model/table/nearest.hpp"

namespace edda {
namespace {

/// Whether a text may be the name of a column: it begins with a letter and is not a word for a
/// number.
bool is_name(std::string_view text) {
  text = trimmed(text);
  double number = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  return !text.empty() && std::isalpha(static_cast<unsigned char>(text.front())) != 0 &&
         error == std::errc::invalid_argument;
}

std::vector<std::string_view> cells_of(std::string_view row) {
  std::vector<std::string_view> cells;
  while (true) {
    const std::size_t comma = row.find(',');
    cells.push_back(row.substr(0, comma));
    if (comma == std::string_view::npos) return cells;
    row.remove_prefix(comma + 1);
  }
}

/// The column of that name, whatever follows it, such as a unit: "Time (s)" is "time".
std::optional<std::size_t> column_called(std::string_view cell, const RowShape& shape) {
  std::string name;
  for (const char c : trimmed(cell)) {
    if (std::isalnum(static_cast<unsigned char>(c)) == 0) break;
    name += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  }
  for (std::size_t k = 0; k < shape.names.size(); ++k) {
    const auto& known = shape.names[k];
    if (std::find(known.begin(), known.end(), name) != known.end()) return k;
  }
  return {};
}

/// Whether a line of names has that of another column in some column.
bool in_other_order(const std::vector<std::string_view>& cells, const RowShape& shape) {
  for (std::size_t k = 0; k < cells.size(); ++k) {
    if (column_called(cells[k], shape).value_or(k) != k) return true;
  }
  return false;
}

}  // namespace

bool parse_number(std::string_view text, double& value) {
  text = trimmed(text);
  if (text.starts_with('+')) text.remove_prefix(1);
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return !text.empty() && error == std::errc{} && end == text.data() + text.size() &&
         std::isfinite(value);
}

Result<std::vector<double>> parse_rows(std::string_view text, const RowShape& shape,
                                       const std::string& path, const std::string& key) {
  std::vector<double> numbers;
  int line = 0;
  bool names_may_come = true;
  auto fault = [&](std::string problem, std::string remedy) {
    return Fault{{key, path, line, line > 0 ? 1 : 0}, std::move(problem), std::move(remedy)};
  };
  if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    const std::string_view row = trimmed(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
    ++line;
    if (row.empty() || row.front() == '#') continue;
    const std::vector<std::string_view> cells = cells_of(row);
    const bool fits = cells.size() == shape.columns;
    const bool names = names_may_come && fits && std::all_of(cells.begin(), cells.end(), is_name);
    names_may_come = false;
    if (names && in_other_order(cells, shape)) {
      return fault("has its columns in another order: " + clipped(row),
                   shape.write + ", in this order, in each line");
    }
    if (names) continue;
    const std::size_t first = numbers.size();
    bool good = fits;
    for (std::size_t k = 0; good && k < cells.size(); ++k) {
      double value = 0.0;
      good = parse_number(cells[k], value);
      numbers.push_back(value);
    }
    if (!good) {
      return fault("is not " + shape.numbers,
                   shape.write + " in each line, such as " + shape.example);
    }
    if (first > 0 && !(numbers[first] > numbers[first - shape.columns])) {
      return fault(fmt::format("time {} does not come after {}", numbers[first],
                               numbers[first - shape.columns]),
                   "write the rows in the order of their times, each time once");
    }
  }
  line = 0;
  if (numbers.empty()) return fault("has no rows", shape.write + " in each line");
  return numbers;
}

}  // namespace edda
