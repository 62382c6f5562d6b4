#include "model/files/value.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "model/table/nearest.hpp"

namespace edda {

namespace {

template <class Entries>
auto* entry_in(Entries& entries, std::string_view key) {
  const auto at = std::find_if(entries.begin(), entries.end(),
                               [key](const Entry& entry) { return entry.key == key; });
  return at == entries.end() ? nullptr : &*at;
}

}  // namespace

Entry* find_entry(Table& table, std::string_view key) {
  return entry_in(table, key);
}

const Value* find(const Value* table, std::string_view key) {
  const Table* entries = table == nullptr ? nullptr : std::get_if<Table>(&table->content);
  const Entry* entry = entries == nullptr ? nullptr : entry_in(*entries, key);
  return entry == nullptr ? nullptr : &entry->value;
}

const Value* child(const Value* value, std::size_t i) {
  if (value == nullptr) return nullptr;
  if (const List* list = std::get_if<List>(&value->content)) {
    return i < list->size() ? &(*list)[i] : nullptr;
  }
  if (const Table* table = std::get_if<Table>(&value->content)) {
    return i < table->size() ? &(*table)[i].value : nullptr;
  }
  return nullptr;
}

std::string shown(const Value& value) {
  struct Show {
    std::string operator()(bool v) const { return v ? "true" : "false"; }
    std::string operator()(long long v) const { return std::to_string(v); }
    std::string operator()(double v) const { return fmt::format("{}", v); }
    std::string operator()(const std::string& v) const { return '"' + clipped(v) + '"'; }
    std::string operator()(const Date&) const { return "a date"; }
    std::string operator()(const List&) const { return "a list"; }
    std::string operator()(const Table&) const { return "a table"; }
  };
  return std::visit(Show{}, value.content);
}

}  // namespace edda
