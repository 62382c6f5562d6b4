// A model file as a tree of values with their places, in the order of the file. It
// keeps the TOML library out of every other file.
#pragma once

#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "base/fault.hpp"

namespace edda {

/// Where a value was written; for one given by --set, `line` is the number of the --set.
struct Place {
  int line = 0;
  int column = 0;
  bool from_set = false;
};

struct Value;
struct Entry;
struct Date {};  ///< a TOML date or time, which no key accepts
using List = std::vector<Value>;
using Table = std::vector<Entry>;

struct Value {
  std::variant<bool, long long, double, std::string, Date, List, Table> content;
  Place place;
};

struct Entry {
  std::string key;
  Place place;  ///< of the key
  Value value;
};

/// The entry of `key`, or null where it is missing.
Entry* find_entry(Table& table, std::string_view key);

/// The value of `key`, or null where it is missing or `table` is no table.
const Value* find(const Value* table, std::string_view key);

/// The i-th element of a list, or the i-th entry of a table; null where there is none.
const Value* child(const Value* value, std::size_t i);

/// What the value is, for messages: "a table", "-5", "\"abc\"".
std::string shown(const Value& value);

/// Reads TOML 1.0. A syntax error is one fault with `file`, line and column.
Result<Value> parse_toml(std::string_view text, const std::string& file);

}  // namespace edda
