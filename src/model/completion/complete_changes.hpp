// What the stages of a model share as they are completed.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "model/completion/complete_tools.hpp"

namespace edda {

template <class Items>
std::vector<std::string_view> names_in(const Items& items) {
  std::vector<std::string_view> names;
  for (const auto& item : items) {
    if (!item.name.empty()) names.push_back(item.name);
  }
  return names;
}

/// Adds the fault that a name is none of those known.
void names_nothing(Reading& reading, const Value& value, const std::string& path,
                   const std::string& name, const std::string& what,
                   const std::vector<std::string_view>& known);

Opening* opening_called(Model& model, const std::string& name);

/// Whether a ramp brings the changes of the stage.
inline bool is_ramped(const Stage& stage) {
  return stage.ramp && stage.ramp->varied == Varied::change;
}

/// The changes of properties at the start of a stage.
void complete_changes(const Value* own, Stage& stage, Reading& reading);
/// Finds which laws each change of joints changes, and adds those that follow from it (LawChange):
/// one for each law that joints have by then and that counts as the one that changes.
void complete_law_changes(const Value& root, Reading& reading);

}  // namespace edda
