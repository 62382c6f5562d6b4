// A TOML file of any kind, before its keys are read.
#pragma once

#include <string>
#include <string_view>

#include "model/files/value.hpp"

namespace edda {

/// The file's tables. Faults: bytes that are not UTF-8, a syntax error, an empty file. kind: what
/// it is, for messages ("model"); if_empty: the remedy where it is empty.
Result<Value> read_document(std::string_view text, const std::string& file, std::string_view kind,
                            const std::string& if_empty);

/// In the order of the lines, those of --set last.
void sort_by_place(Faults& faults);

}  // namespace edda
