#include "app/command_tree.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "app/examples.hpp"
#include "model/table/keys.hpp"
#include "report/shown_field.hpp"
#include "results/columns.hpp"

namespace edda {
namespace {

std::vector<std::string> split(const std::string& text, const std::string& between) {
  std::vector<std::string> parts;
  std::size_t from = 0;
  for (std::size_t at = text.find(between); at != std::string::npos;
       at = text.find(between, from)) {
    parts.push_back(text.substr(from, at - from));
    from = at + between.size();
  }
  parts.push_back(text.substr(from));
  return parts;
}

std::vector<std::string> names_of_examples() {
  std::vector<std::string> names;
  for (const Example& e : built_in_examples()) names.emplace_back(e.name);
  return names;
}

std::vector<std::string> names_of_tables() {
  std::vector<std::string> names;
  for (const Section& s : sections()) {
    if (s.shape != Shape::root) names.emplace_back(s.name);
  }
  std::sort(names.begin(), names.end());
  names.erase(std::unique(names.begin(), names.end()), names.end());
  return names;
}

std::vector<std::string> names_of_result_files() {
  std::vector<std::string> names;
  for (const ResultTable& table : result_tables()) names.emplace_back(table.file);
  return names;
}

/// CLI11 says what a value may be after its kind: "TEXT:{displacement,velocity}".
std::vector<std::string> words_in_braces(const std::string& type) {
  const std::size_t open = type.find('{'), close = type.rfind('}');
  if (open == std::string::npos || close == std::string::npos || close < open) return {};
  return split(type.substr(open + 1, close - open - 1), ",");
}

std::vector<std::string> choices_of(const std::string& type) {
  if (type == "FIELD") return split(field_names(), ", ");
  if (type == "EXAMPLE") return names_of_examples();
  if (type == "TABLE") return names_of_tables();
  if (type == "CSV") return names_of_result_files();
  return words_in_braces(type);
}

Files files_of(const std::string& type, bool positional) {
  if (type == "DIR|MODEL") return Files::folders_or_models;
  if (type == "DIR") return Files::folders;
  if (type.starts_with("FILE")) return positional ? Files::models : Files::any;
  return Files::nothing;
}

/// What stands for the value in a synopsis.
std::string value_of(const std::string& type) {
  const std::vector<std::string> words = words_in_braces(type);
  if (words.empty()) return type.substr(0, type.find(':'));
  std::string value;
  for (const std::string& w : words) value += (value.empty() ? "" : "|") + w;
  return value;
}

OptionText describe(const CLI::Option& option) {
  OptionText text;
  const bool positional = option.get_positional();
  if (positional) {
    text.names.push_back(option.get_name(true));
  } else {
    for (const std::string& name : option.get_snames()) text.names.push_back("-" + name);
    for (const std::string& name : option.get_lnames()) text.names.push_back("--" + name);
  }
  const bool flag = option.get_items_expected_max() == 0;
  const std::string type = flag ? std::string{} : option.get_type_name();
  text.value = value_of(type);
  text.text = option.get_description();
  text.choices = choices_of(type);
  text.files = files_of(type, positional);
  text.required = option.get_required();
  return text;
}

CommandText describe_command(const CLI::App& command) {
  CommandText text;
  text.name = command.get_name();
  text.text = command.get_description();
  text.footer = command.get_footer();
  for (const CLI::Option* option : command.get_options()) {
    if (option->get_positional()) {
      text.positional = describe(*option);
    } else if (!option->get_group().empty()) {
      text.options.push_back(describe(*option));
    }
  }
  for (const CLI::App* inner : command.get_subcommands({})) {
    const CommandText more = describe_command(*inner);
    text.inner.push_back(more.name);
    for (OptionText option : more.options) {
      const auto same = [&](const OptionText& o) { return o.names == option.names; };
      if (std::any_of(text.options.begin(), text.options.end(), same)) continue;
      option.text = fmt::format("Of {} {}: {}", text.name, more.name, option.text);
      text.options.push_back(std::move(option));
    }
  }
  return text;
}

}  // namespace

ProgramText describe(const CLI::App& program) {
  ProgramText text;
  text.name = program.get_name();
  text.text = program.get_description();
  text.footer = program.get_footer();
  for (const CLI::Option* option : program.get_options()) {
    text.options.push_back(describe(*option));
  }
  const auto shown = [](const CLI::App* command) { return !command->get_group().empty(); };
  for (const CLI::App* command : program.get_subcommands(shown)) {
    text.commands.push_back(describe_command(*command));
  }
  return text;
}

}  // namespace edda
