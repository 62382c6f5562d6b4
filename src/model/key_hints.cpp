#include "model/key_hints.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <variant>

#include "model/nearest.hpp"
#include "model/synonyms.hpp"

namespace edda {
namespace {

/// The table that a key which is written elsewhere belongs to; empty where none has it, or too
/// many.
std::string place_of_key(std::string_view name) {
  constexpr std::size_t most = 3;
  std::vector<std::string> tables;
  for (const Section& section : sections()) {
    if (section.shape != Shape::root && find_key(section.keys, name) != nullptr)
      tables.push_back(named_in_file(section.name));
  }
  if (tables.empty() || tables.size() > most) return {};
  std::string list = tables[0];
  for (std::size_t i = 1; i < tables.size(); ++i) {
    list += (i + 1 == tables.size() ? " or " : ", ") + tables[i];
  }
  return fmt::format("{} belongs to {}", name, list);
}

/// Where it belongs, what it is called here, or what it may be a slip of.
std::string hint_of(std::string_view name, std::span<const std::string_view> known) {
  if (find_key(sections().front().keys, name) != nullptr)
    return fmt::format("{} belongs at the top of the file, before the first [table]", name);
  if (const std::string hint = synonym_hint(name); !hint.empty()) return hint;
  if (is_likely(name, known)) return suggestion(name, known);
  const std::string place = place_of_key(name);
  return place.empty() ? suggestion(name, known) : place;
}

/// Whether the name is made of those of a table and of a key inside: "angle_deviation".
bool joins(std::string_view name, const InnerKey& inner) {
  return name == fmt::format("{}_{}", inner.key, inner.table) ||
         name == fmt::format("{}_{}", inner.table, inner.key);
}

/// How deep numbers stand in lists: 1 in a point, 2 in a list of points; 0 where it is no list.
int depth_of(const Value& value) {
  const List* list = std::get_if<List>(&value.content);
  return list == nullptr || list->empty() ? 0 : 1 + depth_of(list->front());
}

/// Whether a value is of the shape that the key asks for, and hardly another does.
bool looks_like(const Value& value, const Key& key) {
  const Kind kind = key.rule.kind;
  if (kind == Kind::point) {
    return depth_of(value) == 1 && std::get<List>(value.content).size() == 2;
  }
  return (kind == Kind::polyline || kind == Kind::polygon) && depth_of(value) == 2;
}

/// The key that is required and missing for which another was written in its place: one that is a
/// slip of it, or else has the only value that would do. Null: none.
const Key* written_for(const Entry& entry, const Value& table, std::span<const Key> keys,
                       std::span<const std::string_view> known) {
  if (find_key(sections().front().keys, entry.key) != nullptr) return nullptr;  // belongs there
  const bool slip = synonym_hint(entry.key).empty() && is_likely(entry.key, known);
  const Key* only = nullptr;
  for (const Key& key : keys) {
    if (!key.otherwise.required || find(&table, key.name) != nullptr) continue;
    if (slip ? nearest(entry.key, known) != key.name : !looks_like(entry.value, key)) continue;
    if (only != nullptr) return nullptr;
    only = &key;
  }
  return only;
}

}  // namespace

std::string InnerKey::example() const {
  return fmt::format("{} = {{ {} = ... }}", table, key);
}

std::vector<InnerKey> inner_keys(std::span<const Key> keys, void* object) {
  std::vector<InnerKey> list;
  for (const Key& key : keys) {
    if (key.slot == nullptr || key.rule.kind != Kind::table) continue;
    const Slot slot = key.slot(object);
    const SubTable* table = std::get_if<SubTable>(&slot);
    if (table == nullptr) continue;
    for (const Key& inner : table->keys) list.push_back({key.name, inner.name});
  }
  return list;
}

UnknownKey unknown_key(const Entry& entry, const Value& table, std::span<const Key> keys,
                       const std::vector<InnerKey>& inner, bool is_root) {
  const auto joined = std::find_if(inner.begin(), inner.end(),
                                   [&](const InnerKey& k) { return joins(entry.key, k); });
  if (joined != inner.end()) return {fmt::format("did you mean {}?", joined->example()), nullptr};
  std::vector<std::string_view> known = key_names(keys);
  for (const Section& s : sections()) {
    if (is_root && s.shape != Shape::root) known.push_back(s.name);
  }
  if (const Key* key = written_for(entry, table, keys, known))
    return {fmt::format("did you mean \"{}\"?", key->name), key};
  return {hint_of(entry.key, known), nullptr};
}

std::string number_remedy(const Key& key, const Value& value, const std::vector<InnerKey>& inner) {
  if (key.rule.kind != Kind::number || !std::holds_alternative<Table>(value.content)) return {};
  const auto found = std::find_if(inner.begin(), inner.end(),
                                  [&](const InnerKey& k) { return k.key == key.name; });
  if (found == inner.end()) return {};
  return fmt::format("expects {}; its {} stands beside it: {}", expected(key), found->table,
                     found->example());
}

std::string table_remedy(const SubTable& table) {
  const std::vector<std::string_view> known = key_names(table.keys);
  return fmt::format("expects {}a table such as {{ {} = ... }}, of {}",
                     table.file != nullptr ? "the path of a file in quotes, or " : "",
                     known.front(), quoted_list(known));
}

}  // namespace edda
