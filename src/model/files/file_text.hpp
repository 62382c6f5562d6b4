// The text of an input file.
#pragma once

#include <string>
#include <variant>

#include "base/fault.hpp"

namespace edda {

/// The whole file, or why it cannot be read: missing, a folder, larger than 64 MiB.
std::variant<std::string, Fault> file_text(const std::string& path);

/// The path that the model names, relative to the model file, as an absolute path, so that the
/// written model finds it, too.
std::string beside_model(const std::string& path, const std::string& model_file);

}  // namespace edda
