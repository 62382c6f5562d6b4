#include "app/first_word.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <string_view>
#include <utility>
#include <vector>

#include "app/common.hpp"
#include "model/table/nearest.hpp"

namespace edda {
namespace {

/// Names that other programs have for a command.
constexpr std::pair<std::string_view, std::string_view> other_commands[] = {
    {"help", "--help"},
    {"version", "--version"},
    {"solve", "run"},
    {"start", "run"},
    {"simulate", "run"},
    {"execute", "run"},
    {"compute", "run"},
    {"call", "run"},
    {"restore", "run --resume"},
    {"resume", "run --resume"},
    {"validate", "check"},
    {"test", "check"},
    {"lint", "check"},
    {"mesh", "cut"},
    {"blocks", "cut"},
    {"generate", "cut"},
    {"draw", "plot"},
    {"picture", "plot"},
    {"figure", "plot"},
    {"history", "plot --history"},
    {"show", "view"},
    {"open", "view"},
    {"replay", "view"},
    {"animate", "view"},
    {"film", "view"},
    {"movie", "view"},
    {"ssr", "fos"},
    {"safety", "fos"},
    {"factor-of-safety", "fos"},
    {"examples", "example"},
    {"new", "example"},
    {"init", "example"},
    {"template", "example"},
    {"reference", "keys"},
    {"manual", "man"},
};

bool is_there(const std::string& path) {
  std::error_code ignored;
  return std::filesystem::exists(path, ignored);
}

std::string what_to_write(const std::string& word, const std::vector<std::string_view>& commands) {
  for (const auto& [other, command] : other_commands) {
    if (word == other) return fmt::format("write: edda {}", command);
  }
  if (is_likely(word, commands)) {
    return fmt::format("did you mean: edda {}?", nearest(word, commands));
  }
  return fmt::format("commands are {}; edda --help describes them",
                     fmt::join(nearest_first(word, commands), ", "));
}

}  // namespace

std::optional<std::string> not_a_command(const CLI::App& app, int argc, const char* const* argv) {
  if (argc < 2) return std::nullopt;
  const std::string word = argv[1];
  if (word.empty() || word.front() == '-') return std::nullopt;
  std::vector<std::string_view> commands;
  std::vector<std::string> names;
  for (const CLI::App* command : app.get_subcommands({})) names.push_back(command->get_name());
  if (std::find(names.begin(), names.end(), word) != names.end()) return std::nullopt;
  for (const std::string& name : names) commands.push_back(name);
  const std::string shown = clipped(word);
  if (ending_of(word) == ".toml")
    return fmt::format("\"{0}\" is a model, not a command: to run it: edda run {0}", shown);
  if (is_there(word + "/summary.json")) {
    return fmt::format(
        "\"{0}\" is a folder of results, not a command: to see them: edda plot {0}, or edda view "
        "{0}",
        shown);
  }
  if (is_there(word + ".toml"))
    return fmt::format("\"{0}\" is no command: to run the model {0}.toml: edda run {0}.toml",
                       shown);
  return fmt::format("\"{}\" is no command: {}", shown, what_to_write(word, commands));
}

}  // namespace edda
