// Keys and words that were renamed: old models and scripts go on working.
#pragma once

#include <string>
#include <vector>

#include "model/files/reader.hpp"

namespace edda {

/// Writes today's names in place of old ones, with a warning for each of them. A table that gives a
/// key by both of its names is a fault.
void rename_old(Value& root, Reading& reading);

/// The same for the path of a --set, in its parts.
void rename_old(std::vector<std::string>& path, Reading& reading);

}  // namespace edda
