// The first word of the command line where it is no command.
#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>

namespace edda {

/// What is wrong with it and what to write, or nothing where it is a command, an option or missing.
std::optional<std::string> not_a_command(const CLI::App& app, int argc, const char* const* argv);

}  // namespace edda
