#include "imports/dxf_tables.hpp"

#include "imports/file_words.hpp"

namespace edda {
namespace {

std::string text_of(const DxfEntity& entity, int code) {
  const DxfGroup* group = entity.find(code);
  return group == nullptr ? std::string{} : std::string(group->value);
}

int number_of(const DxfEntity& entity, int code, int otherwise) {
  const DxfGroup* group = entity.find(code);
  return group == nullptr ? otherwise : whole_number(group->value).value_or(otherwise);
}

}  // namespace

DxfTables::DxfTables(const std::vector<std::string>& shown) {
  for (const std::string& layer : shown) shown_.insert(in_capitals(layer));
}

/// A layer that is off has a negative colour.
void DxfTables::read_layers(DxfSection& section) {
  constexpr int is_frozen = 1;
  while (const auto entity = section.next()) {
    if (DxfSection::is_end(*entity)) return;
    if (entity->name != "LAYER") continue;
    const std::string name = in_capitals(text_of(*entity, 2));
    if (shown_.contains(name)) continue;
    if (number_of(*entity, 62, 7) < 0) off_.insert(name);
    if ((number_of(*entity, 70, 0) & is_frozen) != 0) frozen_.insert(name);
  }
}

void DxfTables::read_objects(DxfSection& section) {
  while (const auto entity = section.next()) {
    if (DxfSection::is_end(*entity)) return;
    const std::string handle = dxf_handle(text_of(*entity, 5));
    if (entity->name == "SPATIAL_FILTER" && number_of(*entity, 71, 1) != 0) filters_.insert(handle);
    if (entity->name != "DICTIONARY") continue;
    for (const DxfGroup& group : entity->groups) {
      if (group.code == 350 || group.code == 360) entries_[handle].insert(dxf_handle(group.value));
    }
  }
}

bool DxfTables::hidden(const std::string& layer) const {
  return frozen(layer) || (!off_.empty() && off_.contains(in_capitals(layer)));
}

bool DxfTables::frozen(const std::string& layer) const {
  return !frozen_.empty() && frozen_.contains(in_capitals(layer));
}

/// The filter is an entry of the dictionary ACAD_FILTER, which is an entry of that of the INSERT.
bool DxfTables::clips(const std::string& dictionary) const {
  const auto of_insert = entries_.find(dictionary);
  if (dictionary.empty() || of_insert == entries_.end()) return false;
  for (const std::string& entry : of_insert->second) {
    const auto filters = entries_.find(entry);
    if (filters == entries_.end()) continue;
    for (const std::string& filter : filters->second) {
      if (filters_.contains(filter)) return true;
    }
  }
  return false;
}

}  // namespace edda
