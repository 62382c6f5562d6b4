#include "model/files/reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

#include "model/files/read_values.hpp"
#include "model/table/key_hints.hpp"
#include "model/table/nearest.hpp"

namespace edda {
namespace {

/// Names appear in tables, messages and pictures, and must fit on one line.
void check_name(const std::string& name, Place place, const std::string& path, Reading& reading) {
  if (std::none_of(name.begin(), name.end(), is_control)) return;
  add_fault(reading, place, path,
            fmt::format("\"{}\" has a line break or another control character", clipped(name)),
            "give a name of letters, digits and signs on one line");
}

void read_keys(std::span<const Key> keys, void* object, const Value& table,
               const std::string& prefix, Reading& reading);

/// Reads a value into a field of each type.
struct ReadInto {
  Spot spot;
  std::string_view name;  ///< the key as written

  /// Calls take(entry, path) for each entry of a table whose keys are names.
  template <class Take>
  void each_entry(Take take) const {
    const Table* entries = as<Table>(spot.value);
    if (entries == nullptr) return type_fault(spot);
    for (const Entry& entry : *entries) take(entry, spot.path + '.' + entry.key);
  }
  void operator()(bool* field) const {
    if (const bool* value = as<bool>(spot.value)) {
      *field = *value;
    } else {
      type_fault(spot);
    }
  }
  void operator()(int* field) const {
    if (spot.key.rule.kind == Kind::material) {
      *field = read_reference(spot, spot.reading.model.materials, "material", "materials");
    } else if (spot.key.rule.kind == Kind::joint) {
      *field = read_reference(spot, spot.reading.model.joints, "joint", "joints");
    } else if (const auto value = read_integer(spot)) {
      *field = static_cast<int>(*value);
    }
  }
  void operator()(long long* field) const {
    if (const auto value = read_integer(spot)) *field = *value;
  }
  /// Where a word is given in place of the number, complete.cpp finds it.
  void operator()(double* field) const {
    if (is_word_of_rule()) return;
    if (const auto value = number()) *field = *value;
  }
  void operator()(std::optional<double>* field) const {
    if (is_word_of_rule()) {
      field->reset();
    } else if (const auto value = number()) {
      *field = *value;
    }
  }
  void operator()(std::optional<long long>* field) const { *field = read_integer(spot); }
  void operator()(std::optional<Restitution>* field) const {
    if (is_word_of_rule()) {
      *field = Restitution{true, 0.0};
    } else if (const auto value = number()) {
      *field = Restitution{false, *value};
    }
  }
  void operator()(std::string* field) const {
    const std::string* value = as<std::string>(spot.value);
    if (value == nullptr) return type_fault(spot);
    if (spot.key.rule.kind != Kind::text && value->empty()) {
      add_fault(spot.reading, spot.value.place, spot.path, "is empty",
                spot.key.rule.kind == Kind::name ? "give a name" : "give the path of a file");
    }
    if (spot.key.rule.kind == Kind::name)
      check_name(*value, spot.value.place, spot.path, spot.reading);
    *field = *value;
  }
  void operator()(JointMap* field) const {
    const bool materials = spot.key.rule.kind == Kind::material_map;
    each_entry([&](const Entry& entry, const std::string& path) {
      const Spot named{spot.key, entry.value, path, spot.reading};
      if (as<std::string>(entry.value) == nullptr) {
        add_fault(spot.reading, entry.value.place, path, "is " + shown(entry.value),
                  materials ? "expects the name of a material in quotes"
                            : "expects the name of a joint in quotes");
        return;
      }
      const Index i =
          materials ? read_reference(named, spot.reading.model.materials, "material", "materials")
                    : read_reference(named, spot.reading.model.joints, "joint", "joints");
      if (i != none) field->emplace_back(entry.key, i);
    });
  }
  void operator()(NumberMap* field) const {
    const Key key{spot.key.name, nullptr, {.range = spot.key.rule.range}, {}, {}};
    each_entry([&](const Entry& entry, const std::string& path) {
      const auto value = read_number(entry.value, key, path, spot.reading);
      if (value) field->emplace_back(entry.key, *value);
    });
  }
  void operator()(VariedRange* field) const {
    if (!field->vary.empty()) {
      add_fault(spot.reading, spot.value.place, spot.path, '"' + field->vary + "\" is varied too",
                "give one of them; ramps of several things are stages, one after the other");
      return;
    }
    *field = {std::string(name), read_point(spot.value, spot.key, spot.path, spot.reading)};
  }
  void operator()(Vec2* field) const {
    if (const auto p = read_point(spot.value, spot.key, spot.path, spot.reading)) *field = *p;
  }
  void operator()(std::optional<Vec2>* field) const {
    *field = read_point(spot.value, spot.key, spot.path, spot.reading);
  }
  void operator()(Triple* field) const {
    const auto value = read_numbers(spot.value, spot.key, spot.path, 3, spot.reading);
    if (value) *field = *value;
  }
  void operator()(std::optional<Triple>* field) const {
    *field = read_numbers(spot.value, spot.key, spot.path, 3, spot.reading);
  }
  void operator()(std::vector<Vec2>* field) const { *field = read_points(spot); }
  void operator()(std::vector<double>* field) const {
    *field = read_number_list(spot.value, spot.key, spot.path, spot.reading);
  }
  void operator()(std::vector<std::string>* field) const { *field = read_words(spot); }
  void operator()(const Choice& choice) const {
    const std::string* word = as<std::string>(spot.value);
    const auto found = word == nullptr ? choice.names.end()
                                       : std::find(choice.names.begin(), choice.names.end(), *word);
    if (found != choice.names.end()) {
      choice.set(choice.field, static_cast<int>(found - choice.names.begin()));
    } else if (word == nullptr) {
      add_fault(spot.reading, spot.value.place, spot.path, "is " + shown(spot.value),
                "expects one of " + quoted_list(choice.names));
    } else {
      add_fault(spot.reading, spot.value.place, spot.path, shown(spot.value) + " is not known",
                suggestion(*word, choice.names));
    }
  }
  void operator()(const SubTable& table) const {
    if (table.file != nullptr && as<std::string>(spot.value) != nullptr) {
      return (*this)(table.file);
    }
    if (as<Table>(spot.value) == nullptr) {
      return add_fault(spot.reading, spot.value.place, spot.path, "is " + shown(spot.value),
                       table_remedy(table));
    }
    void* object = table.object != nullptr ? table.object : table.make(table.owner);
    read_keys(table.keys, object, spot.value, spot.path + '.', spot.reading);
  }

  void operator()(const TableList& tables) const {
    const List* list = as<List>(spot.value);
    if (list == nullptr || list->empty()) {
      return add_fault(spot.reading, spot.value.place, spot.path, "is " + shown(spot.value),
                       list_remedy(tables));
    }
    for (std::size_t i = 0; i < list->size(); ++i) {
      const Value& value = (*list)[i];
      const std::string path = fmt::format("{}[{}]", spot.path, i);
      if (as<Table>(value) == nullptr) {
        add_fault(spot.reading, value.place, path, "is " + shown(value), list_remedy(tables));
        continue;
      }
      void* object = tables.add(tables.list);
      *tables.where(object) = where_of(spot.reading, value.place, path);
      read_keys(tables.keys, object, value, path + '.', spot.reading);
    }
  }

  bool is_word_of_rule() const {
    const std::string* word = as<std::string>(spot.value);
    return word != nullptr && !spot.key.rule.word.empty() && *word == spot.key.rule.word;
  }
  std::optional<double> number() const {
    return read_number(spot.value, spot.key, spot.path, spot.reading);
  }
};

void note_place(const Key& key, Place table, const Value& value, Reading& reading) {
  const auto at = [](Place p) { return WrittenAt{p.line, p.from_set ? 1 : p.column, p.from_set}; };
  reading.model.key_places.push_back(
      {key.name, at(table), at(value.place), as<std::string>(value) != nullptr});
}

void read_keys(std::span<const Key> keys, void* object, const Value& table,
               const std::string& prefix, Reading& reading) {
  const Table* entries = as<Table>(table);
  if (entries == nullptr) return;
  const bool is_root = prefix.empty();
  std::vector<const Key*> meant;  // that unknown keys probably stand for
  for (const Entry& entry : *entries) {
    if (is_root && find_section(entry.key, reading.sections) != nullptr) continue;
    const Key* key = find_key(keys, entry.key);
    if (key == nullptr) {
      const UnknownKey unknown =
          unknown_key(entry, table, keys, object, meant, is_root, reading.sections);
      add_fault(reading, entry.place, prefix + entry.key, "unknown key", unknown.hint);
      meant.push_back(unknown.stands_for);
    } else {
      note_place(*key, table.place, entry.value, reading);
      if (key->slot == nullptr) continue;
      const std::string path = prefix + entry.key;
      const std::string beside = number_remedy(*key, entry.value, keys, object);
      if (beside.empty()) {
        std::visit(ReadInto{{*key, entry.value, path, reading}, entry.key}, key->slot(object));
      } else {
        add_fault(reading, entry.value.place, path, "is " + shown(entry.value), beside);
      }
    }
  }
  for (const Key& key : keys) {
    if (!key.otherwise.required || find(&table, key.name) != nullptr) continue;
    if (std::find(meant.begin(), meant.end(), &key) != meant.end())
      continue;  // the hint for the unknown key reports it
    add_fault(reading, table.place, prefix + std::string(key.name), "is missing",
              "give " + expected(key));
  }
}

/// One object: its keys, its place and, in a named table, its name.
void read_object(const Section& section, const Value& value, const std::string& path,
                 const std::string& object_name, void* into, Reading& reading) {
  void* object = section.add(into);
  if (section.where != nullptr) *section.where(object) = where_of(reading, value.place, path);
  if (section.name_of != nullptr) *section.name_of(object) = object_name;
  if (as<Table>(value) == nullptr) {
    add_fault(reading, value.place, path, "is " + shown(value),
              section.shape == Shape::list ? fmt::format("write [[{}]], one for each", section.name)
                                           : fmt::format("write [{}]", path));
    return;
  }
  read_keys(section.keys, object, value, section.shape == Shape::root ? "" : path + '.', reading);
}

void read_list(const Section& section, const Value& value, void* into, Reading& reading) {
  const List* list = as<List>(value);
  if (list == nullptr) {
    add_fault(reading, value.place, std::string(section.name), "is " + shown(value),
              fmt::format("write [[{}]], one for each", section.name));
    return;
  }
  for (std::size_t i = 0; i < list->size(); ++i) {
    const std::string path = fmt::format("{}.{}", section.name, label((*list)[i], i));
    read_object(section, (*list)[i], path, {}, into, reading);
  }
}

void read_named(const Section& section, const Value& value, void* into, Reading& reading) {
  const Table* table = as<Table>(value);
  if (table == nullptr) {
    add_fault(reading, value.place, std::string(section.name), "is " + shown(value),
              fmt::format("write [{}.NAME], one for each", section.name));
    return;
  }
  for (const Entry& entry : *table) {
    const std::string path = fmt::format("{}.{}", section.name, entry.key);
    if (as<Table>(entry.value) == nullptr) {
      // Most likely [materials] was written instead of [materials.rock].
      const bool is_key = find_key(section.keys, entry.key) != nullptr;
      add_fault(reading, entry.place, path, "is " + shown(entry.value) + ", not a table",
                fmt::format("write [{}.{}]", section.name, is_key ? "NAME" : clipped(entry.key)));
      continue;
    }
    if (entry.key.empty()) {
      add_fault(reading, entry.place, std::string(section.name), "an empty name", "give a name");
    }
    check_name(entry.key, entry.place, path, reading);
    read_object(section, entry.value, path, entry.key, into, reading);
  }
}

}  // namespace

Where where_of(const Reading& reading, Place place, std::string key) {
  if (place.from_set) return {std::move(key), "--set", place.line, 1};
  return {std::move(key), reading.file, place.line, place.column};
}

void add_fault(Reading& reading, Place place, std::string key, std::string problem,
               std::string remedy) {
  for (char& c : key) {
    if (is_control(c)) c = '?';  // a quoted key may hold a line break
  }
  reading.faults.push_back(
      {where_of(reading, place, std::move(key)), std::move(problem), std::move(remedy)});
}

std::string label(const Value& element, std::size_t number) {
  const Value* name = find(&element, "name");
  const std::string* text = name == nullptr ? nullptr : as<std::string>(*name);
  return text == nullptr || text->empty() ? std::to_string(number) : *text;
}

void read_sections(const Value& root, void* into, Reading& reading) {
  for (const Section& section : reading.sections) {
    const Value* value = section.shape == Shape::root ? &root : find(&root, section.name);
    if (section.shape == Shape::root) {
      read_object(section, root, {}, {}, into, reading);
    } else if (section.shape == Shape::table) {
      // A table that is missing as a whole may still have required keys.
      const Value empty{Table{}, {1, 1, false}};
      if (value == nullptr && section.optional) continue;
      read_object(section, value == nullptr ? empty : *value, std::string(section.name), {}, into,
                  reading);
    } else if (value != nullptr && section.shape == Shape::named) {
      read_named(section, *value, into, reading);
    } else if (value != nullptr) {
      read_list(section, *value, into, reading);
    }
  }
}

}  // namespace edda
