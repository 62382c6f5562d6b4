#include "model/table/key_hints.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <variant>

#include "model/table/nearest.hpp"
#include "model/table/synonyms.hpp"

namespace edda {
namespace {

/// A key of a table that is itself a key: the spacing of deviation.
struct InnerKey {
  std::string_view table, key;

  std::string example() const { return fmt::format("{} = {{ {} = ... }}", table, key); }
};

/// The keys of all tables among the keys of an object.
std::vector<InnerKey> inner_keys(std::span<const Key> keys, void* object) {
  std::vector<InnerKey> list;
  for (const Key& key : keys) {
    if (key.slot == nullptr || key.rule.kind != Kind::table) continue;
    for (const Key& inner : inner_keys_of(key.slot(object))) list.push_back({key.name, inner.name});
  }
  return list;
}

/// Tables that have a key of this name.
std::vector<std::string> tables_with(std::string_view name, std::span<const Section> sections) {
  std::vector<std::string> tables;
  for (const Section& section : sections) {
    if (section.shape != Shape::root && find_key(section.keys, name) != nullptr)
      tables.push_back(in_file(section));
  }
  return tables;
}

/// "a", "a or b", "a, b or c"; empty where there are none, or too many.
std::string either(const std::vector<std::string>& names) {
  constexpr std::size_t most = 3;
  if (names.empty() || names.size() > most) return {};
  std::string list = names[0];
  for (std::size_t i = 1; i < names.size(); ++i) {
    list += (i + 1 == names.size() ? " or " : ", ") + names[i];
  }
  return list;
}

/// Whether the word is the key's name, or its name in other programs.
bool means(std::string_view word, std::string_view name, std::span<const Key> keys) {
  const std::vector<const Key*> called = keys_called(word, keys);
  return word == name || std::any_of(called.begin(), called.end(),
                                     [&](const Key* key) { return key->name == name; });
}

/// Whether the name combines the name of a table and that of a key inside it, possibly misspelt:
/// "angle_deviation", "length_std".
bool joins(std::string_view name, const InnerKey& asked, std::span<const Key> keys,
           const std::vector<InnerKey>& inner) {
  std::vector<std::string_view> beside;
  for (const InnerKey& k : inner) {
    if (k.table == asked.table) beside.push_back(k.key);
  }
  const auto is_key = [&](std::string_view word) {
    return is_likely(word, beside) && nearest(word, beside) == asked.key;
  };
  for (std::size_t at = name.find('_'); at != std::string_view::npos; at = name.find('_', at + 1)) {
    const std::string_view first = name.substr(0, at), last = name.substr(at + 1);
    if (means(last, asked.table, keys) && is_key(first)) return true;
    if (means(first, asked.table, keys) && is_key(last)) return true;
  }
  return false;
}

/// The keys of inner tables that the name equals, or contains together with the name of the table.
std::string inside(std::string_view name, std::span<const Key> keys,
                   const std::vector<InnerKey>& inner) {
  std::vector<std::string> examples;
  for (const InnerKey& k : inner) {
    if (name == k.key || joins(name, k, keys, inner)) examples.push_back(k.example());
  }
  const std::string text = either(examples);
  return text.empty() ? text : fmt::format("did you mean {}?", text);
}

/// Depth of numbers in nested lists: 1 in a point, 2 in a list of points; 0 where it is no list.
int depth_of(const Value& value) {
  const List* list = std::get_if<List>(&value.content);
  return list == nullptr || list->empty() ? 0 : 1 + depth_of(list->front());
}

/// Whether a value has the form that the key requires, and that few other keys require.
bool looks_like(const Value& value, const Key& key) {
  const Kind kind = key.rule.kind;
  if (kind == Kind::point) {
    return depth_of(value) == 1 && std::get<List>(value.content).size() == 2;
  }
  return (kind == Kind::polyline || kind == Kind::polygon) && depth_of(value) == 2;
}

bool is_missing(const Key& key, const Value& table) {
  return key.otherwise.required && find(&table, key.name) == nullptr;
}

/// The only required and missing key, not yet `meant` by another, for which the value is suitable;
/// null: none.
const Key* only_fit(const Entry& entry, const Value& table, std::span<const Key> keys,
                    const std::vector<const Key*>& meant) {
  const Key* only = nullptr;
  for (const Key& key : keys) {
    if (!is_missing(key, table) || !looks_like(entry.value, key)) continue;
    if (std::find(meant.begin(), meant.end(), &key) != meant.end()) continue;
    if (only != nullptr) return nullptr;
    only = &key;
  }
  return only;
}

UnknownKey called_here(std::string_view name, const Value& table, std::span<const Key> keys) {
  UnknownKey unknown{synonym_hint(name, keys)};
  for (const Key* key : keys_called(name, keys)) {
    if (is_missing(*key, table)) unknown.stands_for = key;
  }
  return unknown;
}

/// A misspelt key of the table itself.
UnknownKey slip_of(std::string_view name, const Value& table, std::span<const Key> keys,
                   std::span<const std::string_view> known) {
  const Key* key = find_key(keys, nearest(name, known));
  return {suggestion(name, known), key != nullptr && is_missing(*key, table) ? key : nullptr};
}

}  // namespace

UnknownKey unknown_key(const Entry& entry, const Value& table, std::span<const Key> keys,
                       void* object, const std::vector<const Key*>& meant, bool is_root,
                       std::span<const Section> sections) {
  const std::string& name = entry.key;
  if (!keys_called(name, keys).empty()) return called_here(name, table, keys);
  if (const std::string hint = inside(name, keys, inner_keys(keys, object)); !hint.empty())
    return {hint};
  if (find_key(sections.front().keys, name) != nullptr)
    return {fmt::format("{} belongs at the top of the file, before the first [table]", name)};
  std::vector<std::string_view> known = key_names(keys);
  for (const Section& s : sections) {
    if (is_root && s.shape != Shape::root) known.push_back(s.name);
  }
  const std::vector<std::string> elsewhere = tables_with(name, sections);
  const bool is_model = sections.data() == edda::sections().data();
  const std::string other_word = is_model ? synonym_hint(name) : std::string();
  if (elsewhere.empty() && !other_word.empty()) return {other_word};
  if (is_likely(name, known)) return slip_of(name, table, keys, known);
  if (const std::string places = either(elsewhere); !places.empty())
    return {fmt::format("{} belongs to {}", name, places)};
  const Key* fit = elsewhere.empty() ? only_fit(entry, table, keys, meant) : nullptr;
  if (fit != nullptr) return {fmt::format("did you mean \"{}\"?", fit->name), fit};
  return {suggestion(name, known)};
}

std::string number_remedy(const Key& key, const Value& value, std::span<const Key> keys,
                          void* object) {
  const Table* table = std::get_if<Table>(&value.content);
  if (key.rule.kind != Kind::number || table == nullptr) return {};
  const std::vector<InnerKey> inner = inner_keys(keys, object);
  const auto found = std::find_if(inner.begin(), inner.end(),
                                  [&](const InnerKey& k) { return k.key == key.name; });
  if (found == inner.end()) return {};
  std::string number;
  for (const Entry& entry : *table) {
    const bool is_number = std::holds_alternative<double>(entry.value.content) ||
                           std::holds_alternative<long long>(entry.value.content);
    if (number.empty() && is_number && entry.key != found->table)
      number = fmt::format("{} = {}, ", key.name, shown(entry.value));
  }
  return fmt::format("give {}{}, and its {} as {}", number, expected(key), found->table,
                     found->example());
}

std::string table_remedy(const SubTable& table) {
  const std::vector<std::string_view> known = key_names(table.keys);
  return fmt::format("expects {}a table such as {{ {} = ... }}, of {}",
                     table.file != nullptr ? "the path of a file in quotes, or " : "",
                     known.front(), quoted_list(known));
}

std::string list_remedy(const TableList& tables) {
  const std::vector<std::string_view> known = key_names(tables.keys);
  return fmt::format("expects a list of tables such as [{{ {} = ... }}], of {}", known.front(),
                     quoted_list(known));
}

}  // namespace edda
