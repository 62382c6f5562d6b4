// What to say of a key that its table does not know.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "model/keys.hpp"
#include "model/value.hpp"

namespace edda {

struct UnknownKey {
  /// Where it belongs, what it is called here, or which of the keys that the table knows it may be
  /// a slip of.
  std::string hint;
  const Key* stands_for = nullptr;  ///< one that is required and missing, of which the hint tells
};

/// `table` has the `keys` and is read into `object`; `is_root`: it is the whole file, which has
/// sections, too; `meant`: keys that are missing and that others stand for.
UnknownKey unknown_key(const Entry& entry, const Value& table, std::span<const Key> keys,
                       void* object, const std::vector<const Key*>& meant, bool is_root);

/// What a key asks for that got a table in place of a number, where a table beside it has more to
/// say of it; empty: nothing of the kind. `keys`, `object`: as above.
std::string number_remedy(const Key& key, const Value& value, std::span<const Key> keys,
                          void* object);

/// What a key asks for whose value is a table, with the keys in it.
std::string table_remedy(const SubTable& table);

}  // namespace edda
