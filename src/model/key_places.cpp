#include "model/key_places.hpp"

#include <algorithm>

namespace edda {
namespace {

WrittenAt written_at(const Where& where) {
  const bool from_set = where.file == "--set";
  return {where.line, from_set ? 1 : where.column, from_set};
}

/// Whether the dotted path names `key` of a table: its last part, or followed by a number or by
/// keys of its own.
bool names(std::string_view path, std::string_view key) {
  for (std::size_t at = path.rfind(key); at != std::string_view::npos && at > 0;
       at = path.rfind(key, at - 1)) {
    const std::size_t end = at + key.size();
    if (path[at - 1] == '.' && (end == path.size() || path[end] == '.' || path[end] == '[')) {
      return true;
    }
  }
  return false;
}

}  // namespace

const KeyPlace* find_key_place(const KeyPlaces& places, const Where& table, std::string_view key) {
  const WrittenAt at = written_at(table);
  const auto found = std::find_if(places.begin(), places.end(),
                                  [&](const KeyPlace& p) { return p.table == at && p.key == key; });
  return found == places.end() ? nullptr : &*found;
}

Faults at_their_keys(const KeyPlaces& places, Faults faults) {
  for (Fault& fault : faults) {
    if (fault.where.line == 0) continue;
    const WrittenAt at = written_at(fault.where);
    for (const KeyPlace& p : places) {
      if (p.table != at || !names(fault.where.key, p.key)) continue;
      fault.where.line = p.value.line;
      fault.where.column = p.value.column;
      if (p.value.from_set) fault.where.file = "--set";
      break;
    }
  }
  return faults;
}

}  // namespace edda
