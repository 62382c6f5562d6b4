// The command line as data, read from the parser itself: the manual page and the shells'
// completions are made from it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/commands.hpp"

namespace edda {

/// Files that an argument may name.
enum class Files { nothing, any, models, folders, folders_or_models };

struct OptionText {
  std::vector<std::string> names;    ///< "-o", "--output"; of what stands alone: "MODEL"
  std::string value;                 ///< "FILE", "displacement|velocity"; empty: a flag
  std::string text;                  ///< what it does
  std::vector<std::string> choices;  ///< where it takes one of a few words
  Files files = Files::nothing;
  bool required = false;
};

struct CommandText {
  std::string name, text, footer;
  std::vector<OptionText> options;
  std::optional<OptionText> positional;
  std::vector<std::string> inner;  ///< commands of this command ("show"), whose options are among
                                   ///< `options`
};

struct ProgramText {
  std::string name, text, footer;
  std::vector<OptionText> options;
  std::vector<CommandText> commands;  ///< these and options without a group are hidden
};

ProgramText describe(const CLI::App& program);

}  // namespace edda
