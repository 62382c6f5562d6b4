#include "model/value.hpp"

#include <fmt/format.h>

#include "model/nearest.hpp"

namespace edda {

const Value* find(const Value* table, std::string_view key) {
  if (table == nullptr) return nullptr;
  const Table* entries = std::get_if<Table>(&table->content);
  if (entries == nullptr) return nullptr;
  for (const Entry& entry : *entries) {
    if (entry.key == key) return &entry.value;
  }
  return nullptr;
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
