// --set key=value: values given on the command line in place of the file's.
#pragma once

#include <string>
#include <vector>

#include "model/value.hpp"

namespace edda {

/// Puts each "dotted.path=value" into `root`, in order. Elements of lists are named by their name
/// or their number from 0; the value is read as TOML, else it is a string; lists are replaced
/// whole; tables and keys that are missing are made. What cannot be placed is a fault at "--set",
/// line = number of the override from 1. Whether the key exists is left to reading.
Faults apply_overrides(Value& root, const std::vector<std::string>& overrides);

}  // namespace edda
