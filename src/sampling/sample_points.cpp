#include "sampling/sample_points.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "base/random.hpp"
#include "model/study/study_keys.hpp"
#include "results/csv.hpp"
#include "results/read_table.hpp"

namespace edda {
namespace {

using nlohmann::json;

Points grid_of(const StudyPlan& plan) {
  Points points{{}};
  for (const Vary& v : plan.vary) {
    Points longer;
    for (const std::vector<double>& p : points) {
      for (const double value : v.values) {
        longer.push_back(p);
        longer.back().push_back(value);
      }
    }
    points = std::move(longer);
  }
  return points;
}

Result<Points> columns_of(const StudyPlan& plan, const std::string& path) {
  const Result<Table> table = read_table(path);
  if (!table.ok()) return table.faults();
  Points points(table.value().rows());
  for (const Vary& v : plan.vary) {
    const Column* column = table.value().column(v.name);
    if (column == nullptr) {
      return Fault{{v.name, path, 1, 1}, "has no such column", "add one for each [vary.NAME]"};
    }
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (!std::isfinite(column->values[i])) {
        return Fault{{v.name, path, static_cast<int>(i) + 2, 1},
                     fmt::format("\"{}\" is no number", column->text(i)),
                     "give a number"};
      }
      points[i].push_back(column->values[i]);
    }
  }
  return points;
}

/// Of OpenTURNS's generator, which takes 32 bits.
std::uint64_t seed_of(const StudyPlan& plan, std::size_t first) {
  const auto seed = static_cast<std::uint64_t>(plan.sampling.seed);
  const bool continued = plan.sampling.method == SamplingMethod::latin_hypercube && first > 0;
  return continued ? mixed(seed, first) >> 32U : seed;
}

}  // namespace

json variables_of(const StudyPlan& plan, std::vector<std::size_t>& drawn) {
  json variables = json::array();
  for (std::size_t i = 0; i < plan.vary.size(); ++i) {
    const Vary& v = plan.vary[i];
    if (v.distribution == Distribution::seed) continue;
    drawn.push_back(i);
    json one{{"distribution", word_of(v.distribution)}};
    const auto add = [&](const char* name, const std::optional<double>& value) {
      if (value) one[name] = *value;
    };
    add("mean", v.mean);
    add("sd", v.sd);
    add("low", v.low);
    add("high", v.high);
    add("mode", v.mode);
    add("concentration", v.concentration);
    add("at_least", v.at_least);
    add("at_most", v.at_most);
    if (!v.values.empty()) one["values"] = v.values;
    if (!v.weights.empty()) one["weights"] = v.weights;
    if (!v.with.empty()) one["with"] = v.with;
    one["name"] = v.name;
    variables.push_back(std::move(one));
  }
  return variables;
}

json dependence_of(const StudyPlan& plan, const std::vector<std::size_t>& drawn) {
  const auto number = [&](const std::string& name) {
    const auto at = std::find_if(drawn.begin(), drawn.end(),
                                 [&](std::size_t i) { return plan.vary[i].name == name; });
    return static_cast<std::size_t>(at - drawn.begin());
  };
  json dependence = json::array();
  for (const Correlated& c : plan.correlated) {
    json one{{"between", {number(c.between[0]), number(c.between[1])}},
             {"copula", word_of(c.copula)}};
    if (c.rank) one["rank"] = *c.rank;
    if (c.theta) one["theta"] = *c.theta;
    dependence.push_back(std::move(one));
  }
  return dependence;
}

Result<Points> points_of(const StudyPlan& plan, std::size_t first, SamplerProcess& sampler) {
  const SamplingMethod method = plan.sampling.method;
  if (method == SamplingMethod::grid) return grid_of(plan);
  if (method == SamplingMethod::table) return columns_of(plan, plan.sampling.table);
  std::vector<std::size_t> drawn;
  const json variables = variables_of(plan, drawn);
  const auto samples = static_cast<std::size_t>(plan.sampling.samples.value_or(0));
  const bool anew = method == SamplingMethod::latin_hypercube;  // each is one of its own
  Points points(samples - first);
  if (!drawn.empty()) {
    const Result<json> answer = sampler.ask({{"task", "points"},
                                             {"variables", variables},
                                             {"dependence", dependence_of(plan, drawn)},
                                             {"method", word_of(method)},
                                             {"count", anew ? samples - first : samples},
                                             {"seed", seed_of(plan, first)}});
    if (!answer.ok()) return answer.faults();
    const json& rows = answer.value()["points"];
    const std::size_t skipped = anew ? 0 : first;
    points.assign(rows.size() - skipped, {});
    for (std::size_t i = 0; i < points.size(); ++i) {
      points[i].assign(plan.vary.size(), 0.0);
      for (std::size_t k = 0; k < drawn.size(); ++k)
        points[i][drawn[k]] = rows[i + skipped][k].get<double>();
    }
  }
  for (std::size_t i = 0; i < points.size(); ++i) {
    points[i].resize(plan.vary.size(), 0.0);
    for (std::size_t q = 0; q < plan.vary.size(); ++q) {
      const Vary& v = plan.vary[q];
      if (v.distribution == Distribution::seed)
        points[i][q] = v.low.value_or(1.0) + static_cast<double>(first + i);
    }
  }
  return points;
}

std::vector<std::string> overrides_of(const StudyPlan& plan, const std::vector<double>& point) {
  std::vector<std::string> overrides;
  for (std::size_t q = 0; q < plan.vary.size(); ++q) {
    const Vary& v = plan.vary[q];
    const std::string number = shortest(point[q]);
    for (const std::string& key : v.keys) {
      overrides.push_back(v.unit.empty() ? fmt::format("{}={}", key, number)
                                         : fmt::format("{}=\"{} {}\"", key, number, v.unit));
    }
  }
  return overrides;
}

std::string points_csv(const StudyPlan& plan, const Points& points) {
  Csv csv;
  for (const Vary& v : plan.vary) csv.add(v.name);
  csv.end();
  for (const std::vector<double>& p : points) {
    for (const double x : p) csv.add(x);
    csv.end();
  }
  return csv.text();
}

Result<Points> read_points(const StudyPlan& plan, const std::string& path) {
  return columns_of(plan, path);
}

}  // namespace edda
