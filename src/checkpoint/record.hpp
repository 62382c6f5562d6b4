// The contents of a checkpoint, independent of the file format: arrays of numbers, and texts, by
// name.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <variant>
#include <vector>

namespace edda {

using RecordValue =
    std::variant<std::vector<double>, std::vector<std::uint64_t>, std::vector<std::uint32_t>,
                 std::vector<std::int32_t>, std::vector<std::uint16_t>, std::vector<std::uint8_t>,
                 std::string>;

/// Names are made of letters, digits, '_' and '.'.
using Record = std::map<std::string, RecordValue>;

}  // namespace edda
