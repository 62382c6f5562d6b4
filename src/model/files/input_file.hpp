// Files that a model names.
#pragma once

#include <string>

#include "model/files/reader.hpp"

namespace edda {

/// What is wrong with a file; or with its name, where nothing in the file is wrong: then the fault
/// is at `place` in the model.
void blame(const Fault& fault, const std::string& path, Place place, Reading& reading);

/// Reads the time history that `path` names under the key `history` of `node`, where one is given.
void read_history(const Value* node, const std::string& element, std::string& path,
                  TimeHistory& history, Reading& reading);

}  // namespace edda
