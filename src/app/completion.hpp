// Scripts that let shells complete what is typed after "edda".
#pragma once

#include <string>

#include "app/command_tree.hpp"

namespace edda {

std::string bash_completion(const ProgramText& program);
std::string zsh_completion(const ProgramText& program);
std::string fish_completion(const ProgramText& program);

}  // namespace edda
