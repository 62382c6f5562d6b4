// The columns of all tables that the program writes. One list (column_table.cpp) has every file,
// column, unit and meaning; the headers of the files, columns.csv and docs/results.md follow from
// it.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "results/csv.hpp"
#include "results/files.hpp"

namespace edda {

/// What a file has the column for: once, or for each monitor, convergence line, measured region or
/// boundary; of a study for each quantity that varies, or that is asked.
enum class ColumnOf { file, monitor, convergence, measurement, boundary, quantity, answer };

struct ResultColumn {
  std::string_view name;     ///< as in the header; NAME.ux stands for crown.ux of a monitor crown
  std::string_view unit;     ///< SI; "1": a number without dimension, "text": words
  std::string_view meaning;  ///< a sentence, with the sign convention where there is a sign
  ColumnOf of = ColumnOf::file;
};

/// In the order of result_tables() and of columns.csv.
enum class ResultFile {
  history,
  reactions,
  bolts,
  linings,
  flow,
  stages,
  curve,
  stage_joints,
  bolt_summary,
  blocks,
  joints,
  fos,
  mechanism,
  mechanism_joints,
  limit_joints,
  key_blocks,
  study,
  map,
  motions,
  spectra,
  amplification,
  relative,
  columns,
  cut,
};

/// Where a table is: in the results folder, there once for each stage, or wherever the user says.
enum class TableIn { folder, folder_by_stage, file_of_user };

struct ResultTable {
  std::string_view file;  ///< its name; joints_N.csv: of stage N; F.csv: chosen by the user
  std::string_view rows;  ///< a sentence: what a row is, and when the file is written
  std::span<const ResultColumn> columns;  ///< in the order of the file
  TableIn in = TableIn::folder;
};

/// All of them, one per ResultFile.
std::span<const ResultTable> result_tables();
const ResultTable& result_table(ResultFile file);
/// Whether a file of that name is a table of a results folder.
bool is_result_table(std::string_view name);

/// Names of what has columns of its own, in the order of the columns.
struct ColumnOwners {
  std::vector<std::string> monitors{}, convergences{}, boundaries{}, quantities{}, answers{},
      measurements{};
};

/// The names of rows of the model, or of what was made of them.
template <class Named>
std::vector<std::string> names_in(const std::vector<Named>& rows) {
  std::vector<std::string> names;
  for (const Named& row : rows) names.push_back(row.name);
  return names;
}

/// Number of columns of a table.
std::size_t column_count(ResultFile file, const ColumnOwners& owners = {});

/// A table with its header line, ready for rows.
Csv begin_table(ResultFile file, const ColumnOwners& owners = {});

/// Writes columns.csv into a results folder: the columns of those tables that are there now, each
/// with its unit and meaning.
Trouble write_columns_csv(const std::string& folder, const ColumnOwners& owners = {});

/// Every file and its columns in Markdown.
std::string column_reference();
/// The same of one file ("joints.csv", "joints", "joints_2.csv"); empty if there is no such table.
std::string column_reference(std::string_view file);

}  // namespace edda
