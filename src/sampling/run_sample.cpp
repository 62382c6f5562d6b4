#include "sampling/run_sample.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>

#include "model/read_model.hpp"
#include "results/files.hpp"
#include "results/number.hpp"
#include "results/read_table.hpp"
#include "run/run_model.hpp"
#include "sampling/place_map.hpp"
#include "sampling/sample_points.hpp"
#include "study/fos.hpp"
#include "study/key_blocks.hpp"
#include "study/limit_analysis.hpp"

namespace edda {
namespace {

using nlohmann::json;

constexpr std::string_view unstable = "unstable", unlimited = "unlimited";
/// The results of one analysis of a sample: a summary, and the tables of a run.
struct Analysed {
  std::string summary;
  std::string word;                       ///< in place of its main value
  std::string places{};                   ///< of plan.map
  std::map<std::string, Table> tables{};  ///< by name
};

std::string first_of(const Faults& faults) {
  return to_string(faults.front());
}

/// The path without the name in front, or the whole of it where the text is the last name.
const json* step_into(const json& node, std::string_view& path) {
  // Names may contain dots: the longest that is there is taken.
  for (std::size_t end = path.size(); end != std::string_view::npos && end > 0;
       end = path.rfind('.', end - 1)) {
    const std::string name(path.substr(0, end));
    const json* found = nullptr;
    if (node.is_object() && node.contains(name)) found = &node[name];
    if (node.is_array()) {
      for (const json& item : node) {
        if (item.is_object() && item.value("name", "") == name) found = &item;
      }
      const bool digits =
          std::all_of(name.begin(), name.end(), [](char c) { return c >= '0' && c <= '9'; });
      if (found == nullptr && digits && name.size() < 9 && std::stoul(name) < node.size())
        found = &node[std::stoul(name)];
    }
    if (found == nullptr) continue;
    path.remove_prefix(std::min(end + 1, path.size()));
    return found;
  }
  return nullptr;
}

/// The value at a time, linear between rows; empty where the table does not reach it.
std::string at_time(const std::vector<double>& times, const std::vector<double>& values,
                    double at) {
  const auto after = std::find_if(times.begin(), times.end(), [&](double t) { return t >= at; });
  if (after == times.end() || at < times.front()) return {};
  const auto n = static_cast<std::size_t>(after - times.begin());
  if (times[n] == at) return shortest(values[n]);
  const double part = (at - times[n - 1]) / (times[n] - times[n - 1]);
  return shortest(values[n - 1] + part * (values[n] - values[n - 1]));
}

std::string in_table(const Table& table, const Ask& ask) {
  const Column* column = table.column(ask.value.substr(table_asked(ask).size() + 1));
  if (column == nullptr || column->values.empty()) return {};
  const std::vector<double>& v = column->values;
  if (ask.at) return at_time(table.column("time")->values, v, *ask.at);
  if (ask.take == Taken::largest) return shortest(*std::max_element(v.begin(), v.end()));
  if (ask.take == Taken::smallest) return shortest(*std::min_element(v.begin(), v.end()));
  return shortest(v.back());
}

/// The factor where there is one, else what is known of it.
Result<Analysed> analyse_fos(const Model& model) {
  const Result<FosResult> found = find_factor(model, {});
  if (!found.ok()) return found.faults();
  const FosResult& r = found.value();
  Analysed a{fos_summary(model, r, 1), {}};
  if (r.status == FosStatus::below || r.status == FosStatus::unstable) a.word = unstable;
  if (r.status == FosStatus::above) a.word = unlimited;
  return a;
}

Result<Analysed> analyse_limit(const Model& model, const StudyPlan& plan) {
  const bool largest_alone = std::all_of(plan.ask.begin(), plan.ask.end(), [](const Ask& a) {
    return a.of != Analysis::limit || a.value.starts_with("limit.");
  });
  const Result<LimitResult> found = limit_analysis(
      model, {.extent = largest_alone ? LimitExtent::largest_alone : LimitExtent::all});
  if (!found.ok()) return found.faults();
  const LimitResult& r = found.value();
  Analysed a{limit_summary(model, r), {}};
  if (r.largest.status == LimitEnd::no_equilibrium) a.word = unstable;
  if (r.largest.status == LimitEnd::no_limit) a.word = unlimited;
  return a;
}

Result<Analysed> analyse_key_blocks(const Model& model, const StudyPlan& plan) {
  KeyBlockOptions options;
  if (plan.map) options.places = places_of(*plan.map);
  const Result<KeyBlocks> found = key_blocks(model, options);
  if (!found.ok()) return found.faults();
  std::vector<AtPlace> there;
  for (const auto& generation : found.value().at_place)
    there.push_back(what_is_at(generation, plan.map->generations));
  return Analysed{key_blocks_summary(model, found.value()), {}, places_text(there)};
}

Result<Analysed> analyse_run(Model model, const std::string& scratch) {
  Result<PreparedRun> run = prepare_run(std::move(model));
  if (!run.ok()) return run.faults();
  RunOptions options;
  options.folder = scratch;
  const Result<Outcome> outcome = run_model(run.value(), options);
  if (!outcome.ok()) return outcome.faults();
  const Result<std::string> summary = read_file(scratch + "/summary.json");
  if (!summary.ok()) return summary.faults();
  Analysed a{summary.value(), {}};
  for (const std::string name : {"history", "reactions"}) {
    if (const Result<Table> table = read_table(scratch + "/" + name + ".csv"); table.ok())
      a.tables[name] = table.value();
  }
  std::error_code error;
  std::filesystem::remove_all(scratch, error);
  return a;
}

Result<Analysed> analyse(Analysis analysis, const StudyPlan& plan, std::string_view model_text,
                         const std::vector<std::string>& overrides, const std::string& scratch) {
  const ReadFor what_for = analysis == Analysis::run ? ReadFor::run : ReadFor::no_run;
  Result<Model> model = read_model_text(model_text, plan.model, overrides, what_for);
  if (!model.ok()) return model.faults();
  switch (analysis) {
    case Analysis::run:
      return analyse_run(std::move(model.value()), scratch);
    case Analysis::fos:
      return analyse_fos(model.value());
    case Analysis::keyblocks:
      return analyse_key_blocks(model.value(), plan);
    case Analysis::limit:
      break;
  }
  return analyse_limit(model.value(), plan);
}

/// Somewhere within each distribution.
std::vector<double> middle_of(const StudyPlan& plan) {
  std::vector<double> point;
  for (const Vary& v : plan.vary) {
    const double ends = 0.5 * (v.low.value_or(0.0) + v.high.value_or(0.0));
    const double middle = v.mean ? *v.mean : v.mode ? *v.mode : ends;
    point.push_back(std::clamp(middle, v.at_least.value_or(-1e300), v.at_most.value_or(1e300)));
  }
  return point;
}

/// A fault of a --set, where the quantity that gave it is defined.
Fault in_study(const StudyPlan& plan, Fault fault) {
  if (fault.where.file != "--set") return fault;
  int number = fault.where.line;
  for (const Vary& v : plan.vary) {
    number -= static_cast<int>(v.keys.size());
    if (number > 0) continue;
    fault.problem = fault.where.key + ": " + fault.problem;
    fault.where = v.where;
    break;
  }
  return fault;
}

std::string cell_of(const Analysed& a, const Ask& ask) {
  if (const auto table = a.tables.find(std::string(table_asked(ask))); table != a.tables.end())
    return in_table(table->second, ask);
  const std::string value = value_in(a.summary, ask.value);
  return value.empty() ? a.word : value;
}

}  // namespace

std::string value_in(std::string_view json_text, std::string_view path) {
  const json root = json::parse(json_text, nullptr, false);
  const json* node = root.is_discarded() ? nullptr : &root;
  while (node != nullptr && !path.empty()) node = step_into(*node, path);
  if (node == nullptr) return {};
  if (node->is_number()) return shortest(node->get<double>());
  if (node->is_boolean()) return node->get<bool>() ? "1" : "0";
  return node->is_string() ? node->get<std::string>() : std::string();
}

std::optional<Fault> no_sample_can_be_read(const StudyPlan& plan, std::string_view model_text,
                                           const std::vector<std::vector<double>>& points) {
  const bool runs = std::any_of(plan.ask.begin(), plan.ask.end(),
                                [](const Ask& a) { return a.of == Analysis::run; });
  const ReadFor what_for = runs ? ReadFor::run : ReadFor::no_run;
  if (const Result<Model> model = read_model_text(model_text, plan.model, {}, what_for);
      !model.ok())
    return model.faults().front();
  std::optional<Fault> first;
  constexpr std::size_t most = 20;
  for (std::size_t i = 0; i < std::min(most, std::max<std::size_t>(points.size(), 1)); ++i) {
    const std::vector<double> point = points.empty() ? middle_of(plan) : points[i];
    const Result<Model> model =
        read_model_text(model_text, plan.model, overrides_of(plan, point), what_for);
    if (model.ok()) return {};
    if (!first) first = in_study(plan, model.faults().front());
  }
  return first;
}

SampleAnswer run_sample(const StudyPlan& plan, std::string_view model_text,
                        const std::vector<double>& point, const std::string& scratch) {
  const std::vector<std::string> overrides = overrides_of(plan, point);
  SampleAnswer answer;
  answer.cells.resize(answer_cells(plan));
  for (const Analysis analysis :
       {Analysis::run, Analysis::fos, Analysis::limit, Analysis::keyblocks}) {
    const auto asks = [&](const Ask& a) { return a.of == analysis; };
    if (std::none_of(plan.ask.begin(), plan.ask.end(), asks)) continue;
    const Result<Analysed> made = analyse(analysis, plan, model_text, overrides, scratch);
    if (!made.ok()) {
      answer.message = first_of(made.faults());
      continue;
    }
    for (std::size_t i = 0; i < plan.ask.size(); ++i) {
      const Ask& ask = plan.ask[i];
      if (!asks(ask)) continue;
      answer.cells[i] = cell_of(made.value(), ask);
      if (answer.cells[i].empty())
        answer.message = fmt::format("there is no {}{} in the results", ask.value,
                                     ask.at ? fmt::format(" at {} s", shortest(*ask.at)) : "");
    }
    if (plan.map && analysis == Analysis::keyblocks) answer.cells.back() = made.value().places;
  }
  return answer;
}

}  // namespace edda
