#include "model/stage_names.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "model/table/slots.hpp"

namespace edda {
namespace {

bool holds(const std::vector<std::string>& names, const std::string& name) {
  return !name.empty() && std::find(names.begin(), names.end(), name) != names.end();
}

template <class Item>
std::vector<Index> rows_of(const std::vector<Item>& items, const std::vector<std::string>& names) {
  std::vector<Index> rows;
  for (std::size_t q = 0; q < items.size(); ++q) {
    if (holds(names, items[q].name)) rows.push_back(static_cast<Index>(q));
  }
  return rows;
}

}  // namespace

NamedRows rows_called(const Model& model, const std::vector<std::string>& names) {
  return {rows_of(model.loads, names), rows_of(model.waters, names),
          rows_of(model.boundaries, names), rows_of(model.shakings, names)};
}

std::vector<Index> bolts_called(const Model& model, const std::vector<std::string>& names) {
  std::vector<Index> rows = rows_of(model.bolts, names);
  auto row = static_cast<Index>(model.bolts.size());
  for (const BoltPattern& pattern : model.bolt_patterns) {
    for (int q = 0; q < pattern.count; ++q, ++row) {
      if (holds(names, pattern.name)) rows.push_back(row);
    }
  }
  return rows;
}

std::vector<Index> linings_called(const Model& model, const std::vector<std::string>& names) {
  return rows_of(model.linings, names);
}

std::vector<Index> fills_called(const Model& model, const std::vector<std::string>& names) {
  return rows_of(model.fills, names);
}

namespace {

std::optional<std::size_t> stage_that(const Model& model, std::vector<std::string> Stage::*list,
                                      const std::string& name) {
  for (std::size_t q = 0; q < model.stages.size(); ++q) {
    if (holds(model.stages[q].*list, name)) return q;
  }
  return {};
}

}  // namespace

std::optional<std::size_t> installed_in(const Model& model, const std::string& name) {
  return stage_that(model, &Stage::install, name);
}

std::optional<std::size_t> placed_in(const Model& model, const std::string& name) {
  return stage_that(model, &Stage::fill, name);
}

std::optional<std::size_t> excavated_in(const Model& model, const std::string& name) {
  return stage_that(model, &Stage::excavate, name);
}

std::optional<std::size_t> stage_called(const Model& model, const std::string& name) {
  for (std::size_t q = 0; q < model.stages.size(); ++q) {
    if (model.stages[q].name == name || std::to_string(q + 1) == name) return q;
  }
  return {};
}

bool acts_at_first(const Model& model, const std::string& name) {
  for (const Stage& stage : model.stages) {
    if (holds(stage.deactivate, name)) return true;
    if (holds(stage.activate, name)) return &stage == &model.stages.front();
  }
  return true;
}

std::vector<bool> acts_in_stages(const Model& model, const std::string& name) {
  bool acts = acts_at_first(model, name);
  std::vector<bool> in;
  for (const Stage& stage : stages_of(model)) {
    acts = holds(stage.activate, name) || (acts && !holds(stage.deactivate, name));
    in.push_back(acts);
  }
  return in;
}

bool flow_takes_time(const Model& model) {
  return std::any_of(model.stages.begin(), model.stages.end(), [](const Stage& stage) {
    return stage.ramp && stage.ramp->varied == Varied::flow;
  });
}

bool installed_at_first(const Model& model, const std::string& name) {
  return !installed_in(model, name);
}

std::vector<std::uint8_t> linings_before(const Model& model, std::size_t stage) {
  std::vector<std::uint8_t> there;
  for (const Lining& lining : model.linings)
    there.push_back(lining.name.empty() || installed_at_first(model, lining.name));
  for (std::size_t q = 0; q < stage; ++q) {
    for (const Index row : linings_called(model, model.stages[q].install))
      there[static_cast<std::size_t>(row)] = 1;
  }
  return there;
}

std::vector<Stage> stages_of(const Model& model) {
  if (!model.stages.empty()) return model.stages;
  Stage only;
  only.duration = model.solver.duration;
  only.damping = model.solver.damping;
  return {only};
}

std::string_view stage_end_name(StageEnd end) {
  return stage_end_names[static_cast<std::size_t>(end)];
}

std::string stage_label(const Model& model, std::size_t stage) {
  const std::string name = stages_of(model)[stage].name;
  return name.empty() ? fmt::format("stage {}", stage + 1)
                      : fmt::format("stage {} ({})", stage + 1, name);
}

}  // namespace edda
