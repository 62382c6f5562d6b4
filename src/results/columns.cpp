#include "results/columns.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <optional>

namespace edda {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view owner_mark = "NAME", csv_ending = ".csv";

struct NamedColumn {
  std::string name;
  const ResultColumn* column;
};

/// Of monitors each has all of its columns before the next.
std::vector<NamedColumn> named_columns(const ResultTable& table, const ColumnOwners& owners) {
  const auto names_of = [&owners](ColumnOf of) {
    switch (of) {
      case ColumnOf::monitor:
        return owners.monitors;
      case ColumnOf::convergence:
        return owners.convergences;
      case ColumnOf::measurement:
        return owners.measurements;
      case ColumnOf::boundary:
        return owners.boundaries;
      case ColumnOf::quantity:
        return owners.quantities;
      case ColumnOf::answer:
        return owners.answers;
      case ColumnOf::file:
        break;
    }
    return std::vector<std::string>{std::string(owner_mark)};
  };
  std::vector<NamedColumn> named;
  for (auto from = table.columns.begin(); from != table.columns.end();) {
    const auto to = std::find_if(from, table.columns.end(),
                                 [&](const ResultColumn& c) { return c.of != from->of; });
    for (const std::string& name : names_of(from->of)) {
      for (auto c = from; c != to; ++c) {
        const bool own = c->of != ColumnOf::file;
        named.push_back(
            {own ? name + std::string(c->name.substr(owner_mark.size())) : std::string(c->name),
             &*c});
      }
    }
    from = to;
  }
  return named;
}

std::string stage_file(std::size_t stage) {
  return fmt::format("joints_{}.csv", stage);
}

/// 12 of joints_12.csv. Earlier versions counted stages from 0.
std::optional<std::size_t> number_of_stage(std::string_view file) {
  const auto number = number_in_name(file, "joints_", csv_ending);
  return number && file == stage_file(*number) ? number : std::nullopt;
}

/// joints_1.csv, joints_2.csv and so on, as far as they are in the folder.
std::vector<std::string> stage_files(const std::string& folder) {
  std::vector<std::size_t> stages;
  std::error_code error;
  for (fs::directory_iterator it(folder, error), end; it != end && !error; it.increment(error)) {
    if (const auto number = number_of_stage(it->path().filename().string()))
      stages.push_back(*number);
  }
  std::sort(stages.begin(), stages.end());
  std::vector<std::string> files;
  for (const std::size_t stage : stages) files.push_back(stage_file(stage));
  return files;
}

/// The names of those files of a table that are in the folder, columns.csv among them.
std::vector<std::string> files_there(const ResultTable& table, const std::string& folder) {
  if (table.in == TableIn::folder_by_stage) return stage_files(folder);
  if (table.in == TableIn::file_of_user) return {};
  std::error_code error;
  const bool there = &table == &result_table(ResultFile::columns) ||
                     fs::exists(fs::path(folder) / table.file, error);
  return there ? std::vector{std::string(table.file)} : std::vector<std::string>{};
}

std::string heading_of(const ResultTable& table) {
  return fmt::format("## `{}`\n\n{}\n", table.file, table.rows);
}

std::string reference_of(const ResultTable& table) {
  std::string text = heading_of(table) + "\n| column | unit | meaning |\n|---|---|---|\n";
  for (const ResultColumn& c : table.columns)
    text += fmt::format("| `{}` | {} | {} |\n", c.name, c.unit, c.meaning);
  return text;
}

}  // namespace

bool is_result_table(std::string_view name) {
  const std::span<const ResultTable> tables = result_tables();
  return number_of_stage(name).has_value() ||
         std::any_of(tables.begin(), tables.end(), [name](const ResultTable& table) {
           return table.in == TableIn::folder && name == table.file;
         });
}

std::size_t column_count(ResultFile file, const ColumnOwners& owners) {
  return named_columns(result_table(file), owners).size();
}

Csv begin_table(ResultFile file, const ColumnOwners& owners) {
  Csv csv;
  for (const NamedColumn& c : named_columns(result_table(file), owners)) csv.add(c.name);
  csv.end();
  return csv;
}

Trouble write_columns_csv(const std::string& folder, const ColumnOwners& owners) {
  Csv csv = begin_table(ResultFile::columns);
  for (const ResultTable& table : result_tables()) {
    for (const std::string& file : files_there(table, folder)) {
      for (const NamedColumn& c : named_columns(table, owners))
        csv.add(file).add(c.name).add(c.column->unit).add(c.column->meaning).end();
    }
  }
  return write_file(folder + "/columns.csv", csv.text());
}

std::string column_reference() {
  std::string text;
  for (const ResultTable& table : result_tables()) {
    // Its columns are those of joints.csv, as its heading says.
    text += (text.empty() ? "" : "\n") +
            (table.in == TableIn::folder_by_stage ? heading_of(table) : reference_of(table));
  }
  return text;
}

std::string column_reference(std::string_view file) {
  const std::string name = std::string(file) + (file.ends_with(csv_ending) ? "" : ".csv");
  const bool of_stage = number_of_stage(name).has_value();
  for (const ResultTable& table : result_tables()) {
    if (name == table.file || (of_stage && table.in == TableIn::folder_by_stage))
      return reference_of(table);
  }
  return {};
}

}  // namespace edda
