#include "results/read_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <limits>
#include <string_view>

#include "results/files.hpp"
#include "results/number.hpp"

namespace edda {
namespace {

/// Removes one row from the front of `text`, cell by cell. False: the row is incomplete.
bool take_row(std::string_view& text, std::vector<std::string>& cells) {
  cells.assign(1, {});
  bool quoted = false;
  for (std::size_t k = 0; k < text.size(); ++k) {
    const char c = text[k];
    if (quoted) {
      if (c != '"') {
        cells.back() += c;
      } else if (k + 1 < text.size() && text[k + 1] == '"') {
        cells.back() += text[++k];
      } else {
        quoted = false;
      }
    } else if (c == '"') {
      quoted = true;
    } else if (c == ',') {
      cells.emplace_back();
    } else if (c == '\n') {
      text.remove_prefix(k + 1);
      return true;
    } else {
      cells.back() += c;
    }
  }
  return false;
}

void put(Column& column, const std::string& cell) {
  double value = 0.0;
  const char* const end = cell.data() + cell.size();
  const auto [stop, error] = std::from_chars(cell.data(), end, value);
  const bool is_number = error == std::errc{} && stop == end;
  // A name may look like a number, as that of a bolt without a name: the text is not kept where the
  // number reads back to the same text.
  const bool says_all = is_number && shortest(value) == cell;
  if (!says_all && column.texts.empty()) {
    for (const double before : column.values) column.texts.push_back(shortest(before));
  }
  column.values.push_back(is_number ? value : std::numeric_limits<double>::quiet_NaN());
  if (!says_all || !column.texts.empty()) column.texts.push_back(cell);
}

}  // namespace

std::string Column::text(std::size_t row) const {
  return texts.empty() ? shortest(values[row]) : texts[row];
}

const Column* Table::column(const std::string& name) const {
  const auto found =
      std::find_if(columns.begin(), columns.end(), [&](const Column& c) { return c.name == name; });
  return found == columns.end() ? nullptr : &*found;
}

Result<Table> read_table(const std::string& path) {
  const Result<std::string> content = read_file(path);
  if (!content.ok()) return content.faults();
  return table_of(content.value(), path);
}

Result<Table> table_of(std::string_view text, const std::string& path) {
  Table table;
  std::vector<std::string> cells;
  if (!take_row(text, cells)) return table;
  for (std::string& name : cells) table.columns.push_back({std::move(name), {}});
  for (int line = 2; take_row(text, cells); ++line) {
    if (cells.size() != table.columns.size()) {
      return Fault{{{}, path, line, 0},
                   fmt::format("has {} cells under {} names", cells.size(), table.columns.size()),
                   "run the model again"};
    }
    for (std::size_t c = 0; c < cells.size(); ++c) put(table.columns[c], cells[c]);
  }
  return table;
}

}  // namespace edda
