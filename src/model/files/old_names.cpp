#include "model/files/old_names.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string_view>
#include <variant>

namespace edda {
namespace {

struct OldName {
  std::string_view section;  ///< list of tables that have the key; empty: the key is such a list
  std::string_view old_key, key;
  std::string_view old_word, word;  ///< a value of the key; may be empty
};

constexpr std::array old_names{
    OldName{"", "held", "fixed", "", ""},
    OldName{"stage", "mass_scaling", "masses", "static", "scaled"},
};

Entry* entry_called(Value& table, std::string_view name) {
  Table* entries = std::get_if<Table>(&table.content);
  return entries == nullptr ? nullptr : find_entry(*entries, name);
}

void warn(Reading& reading, const std::string& old_name, std::string_view name) {
  std::vector<std::string>& warnings = reading.model.warnings;
  std::string text = fmt::format("{} is named {} now; the old name is still read", old_name, name);
  if (std::find(warnings.begin(), warnings.end(), text) == warnings.end())
    warnings.push_back(std::move(text));
}

void warn_of_key(Reading& reading, const OldName& n) {
  if (n.section.empty()) {
    warn(reading, fmt::format("[[{}]]", n.old_key), fmt::format("[[{}]]", n.key));
  } else {
    warn(reading, fmt::format("{} of [[{}]]", n.old_key, n.section), n.key);
  }
}

/// `path`: of the table in keys, with a dot at its end unless it is empty.
void rename_in(Value& table, const OldName& n, const std::string& path, Reading& reading) {
  if (Entry* old = entry_called(table, n.old_key)) {
    if (entry_called(table, n.key) != nullptr) {
      add_fault(reading, old->place, path + std::string(n.old_key),
                fmt::format("is the old name of {}, which is given, too", n.key),
                fmt::format("move what it has to {}", n.key));
      std::erase_if(std::get<Table>(table.content),
                    [&n](const Entry& entry) { return entry.key == n.old_key; });
      return;
    }
    old->key = n.key;
    warn_of_key(reading, n);
  }
  Entry* entry = n.old_word.empty() ? nullptr : entry_called(table, n.key);
  std::string* text = entry == nullptr ? nullptr : std::get_if<std::string>(&entry->value.content);
  if (text == nullptr || *text != n.old_word) return;
  *text = n.word;
  warn(reading, fmt::format("\"{}\" as {} of [[{}]]", n.old_word, n.key, n.section),
       fmt::format("\"{}\"", n.word));
}

}  // namespace

void rename_old(Value& root, Reading& reading) {
  for (const OldName& n : old_names) {
    if (n.section.empty()) {
      rename_in(root, n, "", reading);
      continue;
    }
    Entry* entry = entry_called(root, n.section);
    List* list = entry == nullptr ? nullptr : std::get_if<List>(&entry->value.content);
    for (std::size_t i = 0; list != nullptr && i < list->size(); ++i) {
      rename_in((*list)[i], n, fmt::format("{}.{}.", n.section, label((*list)[i], i)), reading);
    }
  }
}

void rename_old(std::vector<std::string>& path, Reading& reading) {
  for (const OldName& n : old_names) {
    const std::size_t at = n.section.empty() ? 0 : 2;
    if (path.size() <= at || path[at] != n.old_key || (at > 0 && path[0] != n.section)) continue;
    path[at] = n.key;
    warn_of_key(reading, n);
  }
}

}  // namespace edda
