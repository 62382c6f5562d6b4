#include "model/key_places.hpp"

#include <algorithm>

namespace edda {
namespace {

WrittenAt written_at(const Where& where) {
  const bool from_set = where.file == "--set";
  return {where.line, from_set ? 1 : where.column, from_set};
}

/// Where the dotted path names `key` of a table: as its last part, or followed by a number or by
/// keys of its own; 0: nowhere.
std::size_t place_in(std::string_view path, std::string_view key) {
  for (std::size_t at = path.rfind(key); at != std::string_view::npos && at > 0;
       at = path.rfind(key, at - 1)) {
    const std::size_t end = at + key.size();
    if (path[at - 1] == '.' && (end == path.size() || path[end] == '.' || path[end] == '[')) {
      return at;
    }
  }
  return 0;
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
    // The last match counts: the name of the table comes before it and may equal that of a key.
    const KeyPlace* found = nullptr;
    std::size_t last = 0;
    for (const KeyPlace& p : places) {
      const std::size_t place = p.table == at ? place_in(fault.where.key, p.key) : 0;
      if (place <= last) continue;
      last = place;
      found = &p;
    }
    if (found == nullptr) continue;
    fault.where.line = found->value.line;
    fault.where.column = found->value.column;
    if (found->value.from_set) fault.where.file = "--set";
  }
  return faults;
}

}  // namespace edda
