#include "model/key_hints.hpp"

#include <fmt/format.h>

#include <vector>

#include "model/keys.hpp"
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

}  // namespace

std::string unknown_key_hint(std::string_view name, std::span<const std::string_view> known) {
  if (find_key(sections().front().keys, name) != nullptr)
    return fmt::format("{} belongs at the top of the file, before the first [table]", name);
  if (const std::string hint = synonym_hint(name); !hint.empty()) return hint;
  if (is_likely(name, known)) return suggestion(name, known);
  const std::string place = place_of_key(name);
  return place.empty() ? suggestion(name, known) : place;
}

}  // namespace edda
