// Where each key of the model was written, for faults that are found long after reading.
#pragma once

#include <string_view>
#include <vector>

#include "base/fault.hpp"

namespace edda {

/// A place in the file, or (`from_set`) the number of a --set.
struct WrittenAt {
  int line = 0, column = 0;
  bool from_set = false;
  bool operator==(const WrittenAt&) const = default;
};

/// One key that was given.
struct KeyPlace {
  std::string_view key;  ///< of the table of keys, which lasts
  WrittenAt table, value;
  bool in_words = false;  ///< it is a text, such as a number with its unit
};

using KeyPlaces = std::vector<KeyPlace>;

/// Where `key` of the table at `table` was written; null where it was not given.
const KeyPlace* find_key_place(const KeyPlaces& places, const Where& table, std::string_view key);

/// Replaces in faults the place of a table by that of the key that the fault names. Faults found
/// later in a run only have the place of the table.
Faults at_their_keys(const KeyPlaces& places, Faults faults);

}  // namespace edda
