// edda columns: what the columns of the result files are.
#include <fmt/format.h>

#include <memory>

#include "app/commands.hpp"
#include "app/common.hpp"
#include "model/table/nearest.hpp"
#include "results/columns.hpp"

namespace edda {
namespace {

int print_columns(const std::string& file) {
  const std::string text = file.empty() ? column_reference() : column_reference(file);
  if (!text.empty()) {
    fmt::print("{}", text);
    return exit_code::done;
  }
  std::vector<std::string_view> known;
  for (const ResultTable& table : result_tables())
    known.push_back(table.file.substr(0, table.file.find('.')));
  print({Fault{{"", file, 0, 0}, "is no table of results", suggestion(file, known)}});
  return exit_code::bad_input;
}

}  // namespace

void add_columns(CLI::App& app, int& code) {
  CLI::App* command =
      app.add_subcommand("columns", "Print the columns of result files, with units and meanings");
  command->footer("Example:\n  edda columns joints.csv");
  auto file = std::make_shared<std::string>();
  command->add_option("TABLE", *file, "One file alone, such as history.csv or joints.csv")
      ->type_name("CSV");
  command->callback([file, &code] { code = print_columns(*file); });
}

}  // namespace edda
