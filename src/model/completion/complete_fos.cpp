#include <fmt/format.h>

#include <algorithm>
#include <string_view>
#include <utility>

#include "model/completion/complete_changes.hpp"
#include "model/completion/complete_tools.hpp"
#include "model/stage_names.hpp"
#include "model/table/nearest.hpp"

namespace edda {
namespace {

/// The row of that name; a fault where there is none.
template <class Items>
Index row_of(const Items& items, const std::string& name, const char* what, Place place,
             const std::string& key, Reading& reading) {
  for (std::size_t q = 0; q < items.size(); ++q) {
    if (items[q].name == name) return static_cast<Index>(q);
  }
  const std::vector<std::string_view> known = names_in(items);
  add_fault(reading, place, key, fmt::format("no {} is called \"{}\"", what, clipped(name)),
            !known.empty()  ? suggestion(name, known)
            : items.empty() ? fmt::format("the model has none: add one, or leave this out")
                            : fmt::format("give the {} that name", what));
  return none;
}

}  // namespace

std::optional<VariedRow> find_varied(const std::string& vary, Place place, const std::string& key,
                                     Reading& reading) {
  constexpr std::pair<std::string_view, Varied> by_name[] = {{"strength", Varied::strength},
                                                             {"tilt", Varied::tilt},
                                                             {"kh", Varied::kh},
                                                             {"kv", Varied::kv},
                                                             {"gravity", Varied::gravity},
                                                             {"flow", Varied::flow},
                                                             {"change", Varied::change},
                                                             {"time", Varied::time}};
  for (const auto& [word, varied] : by_name) {
    if (vary == word) return VariedRow{varied, none};
    const bool has_way = changes_gravity(varied) && varied != Varied::gravity;
    if (has_way && vary.starts_with('-') && vary.substr(1) == word)
      return VariedRow{varied, backwards};
  }
  const std::size_t colon = std::min(vary.find(':'), vary.size());
  const std::string kind = vary.substr(0, colon);
  const std::string name = vary.substr(std::min(colon + 1, vary.size()));
  const Model& model = reading.model;
  const auto find_in = [&](Varied varied, const auto& items) -> std::optional<VariedRow> {
    const Index row = row_of(items, name, kind.c_str(), place, key, reading);
    if (row == none) return {};
    return VariedRow{varied, row};
  };
  if (kind == "load") return find_in(Varied::load, model.loads);
  if (kind == "shaking") return find_in(Varied::shaking, model.shakings);
  if (kind == "water") return find_in(Varied::water, model.waters);
  if (kind != "boundary") {
    add_fault(reading, place, key, '"' + clipped(vary) + "\" is nothing that can be varied",
              "give \"strength\", \"tilt\", \"kh\", \"kv\", the same with a minus, \"gravity\", "
              "\"load:NAME\", "
              "\"shaking:NAME\", \"water:NAME\" or \"boundary:NAME\"");
    return {};
  }
  const auto found = find_in(Varied::boundary, model.boundaries);
  if (!found) return {};
  const BoundaryType type = model.boundaries[static_cast<std::size_t>(found->target)].type;
  if (type == BoundaryType::displacement || type == BoundaryType::stress) return found;
  add_fault(reading, place, key,
            '"' + clipped(name) + "\" prescribes neither a displacement nor a traction",
            "name a boundary of type \"displacement\" or \"stress\"");
  return {};
}

void complete_fos(const Value& root, Reading& reading) {
  if (!reading.model.fos) return;
  Fos& fos = *reading.model.fos;
  const Value* node = find(&root, "fos");
  if (!is_table(node)) return;
  const Model& model = reading.model;
  if (const auto found = find_varied(fos.vary, place_of(node, "vary"), "fos.vary", reading)) {
    fos.varied = found->varied;
    fos.target = found->target;
    if (found->varied == Varied::water && flow_takes_time(model))
      add_fault(reading, place_of(node, "vary"), "fos.vary",
                "trials hold the water in joints after a stage in which it takes its time, so that "
                "no factor on a water has an effect there",
                "vary the strength, or give the stages no ramp of flow");
    if (found->varied == Varied::flow || found->varied == Varied::time ||
        found->varied == Varied::change)
      add_fault(reading, place_of(node, "vary"), "fos.vary",
                '"' + fos.vary + "\" has no factor: it belongs to the ramp of a stage",
                "vary the strength at the end of a stage with such a ramp: fos.stage");
  }
  if (!fos.stage.empty()) {
    row_of(model.stages, fos.stage, "stage", place_of(node, "stage"), "fos.stage", reading);
  }
  for (const std::string& name : fos.exclude) {
    row_of(model.given_joints(), name, "joint", place_of(node, "exclude"), "fos.exclude", reading);
  }
  if (!given(node, "bracket")) {
    if (fos.varied == Varied::tilt) fos.bracket = {5.0, 45.0};
    if (fos.varied == Varied::kh || fos.varied == Varied::kv) fos.bracket = {0.05, 0.5};
  }
  if (given(node, "bracket") && fos.bracket.x >= fos.bracket.y) {
    add_fault(reading, find(node, "bracket")->place, "fos.bracket",
              "the lower factor is not below the upper one", "give two such as [0.5, 3.0]");
  }
}

}  // namespace edda
