// A first word of the command line that is not a command.
#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>

namespace edda {

/// The fault with its remedy, or nothing where it is a command, an option or missing.
std::optional<std::string> not_a_command(const CLI::App& app, int argc, const char* const* argv);

}  // namespace edda
