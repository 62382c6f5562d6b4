// --set key=value: values given on the command line in place of the file's.
#pragma once

#include <string>
#include <vector>

#include "model/files/reader.hpp"

namespace edda {

/// Writes each "dotted.path=value" into `root`, in order. Elements of lists are given by their name
/// or their number from 0; the value is read as TOML, else it is a string; lists are replaced as a
/// whole; missing tables and keys are made. A path that cannot be resolved is a fault at "--set",
/// line = number of the override from 1. Whether the key exists is left to reading.
void apply_overrides(Value& root, const std::vector<std::string>& overrides, Reading& reading);

}  // namespace edda
