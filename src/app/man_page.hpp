// The manual page edda(1).
#pragma once

#include <string>

#include "app/command_tree.hpp"

namespace edda {

/// In troff, with the macros of man(7). `of`: the version; `date`: as 2026-01-31.
std::string man_page(const ProgramText& program, const std::string& of, const std::string& date);

}  // namespace edda
