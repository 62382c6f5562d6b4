// Hints for keys that a table does not have.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "model/files/value.hpp"
#include "model/table/keys.hpp"

namespace edda {

struct UnknownKey {
  /// The table it belongs to, its name in this program, or the key of the table that was probably
  /// meant.
  std::string hint;
  const Key* stands_for = nullptr;  ///< a required and missing key that the hint mentions
};

/// `table` has the `keys` and is read into `object`; `is_root`: it is the whole file, which also
/// has `sections`; `meant`: missing keys for which other unknown keys were written.
UnknownKey unknown_key(const Entry& entry, const Value& table, std::span<const Key> keys,
                       void* object, const std::vector<const Key*>& meant, bool is_root,
                       std::span<const Section> sections);

/// What a number that was given as a table should be, where a table beside it has the further
/// values; empty where there is no such table. `keys`, `object`: as above.
std::string number_remedy(const Key& key, const Value& value, std::span<const Key> keys,
                          void* object);

/// The value that a key requires which is a table, with its keys.
std::string table_remedy(const SubTable& table);
/// Likewise a list of tables.
std::string list_remedy(const TableList& tables);

}  // namespace edda
