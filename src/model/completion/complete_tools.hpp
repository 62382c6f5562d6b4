// Helpers that the parts of complete() share.
#pragma once

#include <algorithm>
#include <optional>
#include <string>
#include <string_view>

#include "model/completion/complete.hpp"

namespace edda {

/// A default derived from other keys, within the range allowed for the key.
inline double fitted(double x) {
  return std::clamp(x, smallest_positive, largest_number);
}

inline bool given(const Value* table, std::string_view key) {
  return find(table, key) != nullptr;
}

inline bool is_table(const Value* value) {
  return value != nullptr && std::holds_alternative<Table>(value->content);
}

/// The i-th [[section]].
inline const Value* element(const Value& root, std::string_view section, std::size_t i) {
  return child(find(&root, section), i);
}

/// The place where `key` was written, else that of its table.
inline Place place_of(const Value* table, std::string_view key) {
  const Value* value = find(table, key);
  return value != nullptr ? value->place : table->place;
}

/// Adds a fault unless exactly one of the two keys is given. `example`: what to add where both are
/// missing.
bool one_of(const Value* table, const std::string& path, std::string_view first,
            std::string_view second, const std::string& example, Reading& reading);

/// Adds a fault where local damping is given and the method or the mass does not allow it.
/// `instead`: what to do in the implicit method.
void check_local_damping(const Value* damping, const std::string& owner, const Solver& solver,
                         const char* instead, Reading& reading);

inline constexpr const char* implicit_remedy = "use method = \"edda\", or leave it out";

/// Adds a fault where no opening has the name that the key `opening` of this table gives.
void check_opening(const Value* node, const std::string& path, const std::string& opening,
                   Reading& reading);

/// What `vary` ("kh", "load:NAME" ...) means; a fault at that place and key where it means nothing
/// in the model.
struct VariedRow {
  Varied varied;
  Index target;  ///< row of loads, shakings, waters or boundaries; or `backwards`; else none
};
std::optional<VariedRow> find_varied(const std::string& vary, Place place, const std::string& key,
                                     Reading& reading);

}  // namespace edda
