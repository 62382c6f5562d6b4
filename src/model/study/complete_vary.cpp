// What the distributions of a study need, and what their parameters must be to each other.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "model/study/complete_study.hpp"
#include "model/study/study_keys.hpp"
#include "model/table/nearest.hpp"

namespace edda {
namespace {

struct Parameter {
  std::string_view name;
  std::optional<double> Vary::*field;
};
constexpr Parameter mean{"mean", &Vary::mean}, sd{"sd", &Vary::sd}, low{"low", &Vary::low},
    high{"high", &Vary::high}, mode{"mode", &Vary::mode},
    concentration{"concentration", &Vary::concentration};

/// What a distribution needs, and what else it may have.
struct Needs {
  std::vector<Parameter> required, optional;
};

Needs needs_of(Distribution d) {
  switch (d) {
    case Distribution::normal:
      return {{mean, sd}, {}};
    case Distribution::lognormal:
    case Distribution::weibull:
      return {{mean, sd}, {low}};
    case Distribution::uniform:
      return {{low, high}, {}};
    case Distribution::triangular:
      return {{low, mode, high}, {}};
    case Distribution::exponential:
      return {{mean}, {low}};
    case Distribution::beta:
      return {{mean, sd, low, high}, {}};
    case Distribution::von_mises:
      return {{mean, concentration}, {}};
    case Distribution::fisher:
      return {{mean}, {concentration}};
    case Distribution::seed:
      return {{}, {low}};
    case Distribution::choice:
      return {};
  }
  return {};
}

bool has(const std::vector<Parameter>& list, std::string_view name) {
  return std::any_of(list.begin(), list.end(), [&](const Parameter& p) { return p.name == name; });
}

/// Standard deviation from the coefficient of variation.
void complete_spread(const Completing& c, const Value* table, const std::string& path, Vary& v) {
  if (!v.cv) return;
  if (v.sd) {
    c.fault(table, "cv", path, "is given beside sd", "give one of them");
  } else if (!v.mean || *v.mean == 0.0) {
    c.fault(table, "cv", path, "needs a mean other than 0", "give sd");
  } else {
    v.sd = *v.cv * std::abs(*v.mean);
  }
  v.cv.reset();
}

void check_parameters(const Completing& c, const Value* table, const std::string& path,
                      const Vary& v) {
  const std::string_view word = word_of(v.distribution);
  const Needs needs = needs_of(v.distribution);
  for (const Parameter& p : needs.required) {
    if (v.*(p.field)) continue;
    const bool spread = p.name == "sd";
    c.fault(table, "distribution", path, fmt::format("\"{}\" needs {}", word, p.name),
            fmt::format("give {}{}", p.name, spread ? ", or cv" : ""));
  }
  for (const Parameter& p : {mean, sd, low, high, mode, concentration}) {
    if (!(v.*(p.field)) || has(needs.required, p.name) || has(needs.optional, p.name)) continue;
    c.fault(table, given(table, p.name) ? p.name : "cv", path,
            fmt::format("is nothing of a distribution \"{}\"", word), "leave it out");
  }
}

/// What the parameters must be to each other.
void check_order(const Completing& c, const Value* table, const std::string& path, const Vary& v) {
  const auto wrong = [&](std::string_view key, const std::string& problem,
                         const std::string& remedy) { c.fault(table, key, path, problem, remedy); };
  if (v.low && v.high && *v.low >= *v.high)
    return wrong("low", "is not below high", "give the smallest value as low");
  if (v.mode && v.low && v.high && (*v.mode < *v.low || *v.mode > *v.high))
    return wrong("mode", "lies outside low and high", "give a mode between them");
  const bool above_low =
      v.distribution == Distribution::lognormal || v.distribution == Distribution::weibull ||
      v.distribution == Distribution::exponential || v.distribution == Distribution::beta;
  if (above_low && v.mean && *v.mean <= v.low.value_or(0.0))
    return wrong("mean", fmt::format("is not above the smallest value, {}", v.low.value_or(0.0)),
                 "give a mean above it, or low");
  if (v.distribution == Distribution::beta && v.mean && v.high && v.low && v.sd) {
    if (*v.mean >= *v.high) return wrong("mean", "is not below high", "give a mean below it");
    if (*v.sd * *v.sd >= (*v.mean - *v.low) * (*v.high - *v.mean))
      return wrong("sd", "is more than any distribution between low and high has",
                   "give a smaller one");
  }
  if (v.at_least && v.at_most && *v.at_least >= *v.at_most)
    wrong("at_least", "is not below at_most", "exchange them");
}

void check_values(const Completing& c, const Value* table, const std::string& path, const Vary& v) {
  const bool grid = c.plan.sampling.method == SamplingMethod::grid;
  if (v.values.empty() && (v.distribution == Distribution::choice || grid)) {
    c.fault(table, "values", path, given(table, "values") ? "has no values" : "is missing",
            grid ? "give the values of the grid" : "give the values of which each sample has one");
  }
  if (!v.weights.empty() && v.weights.size() != v.values.size())
    c.fault(table, "weights", path, "are not as many as values", "give one for each value");
  if (std::any_of(v.weights.begin(), v.weights.end(), [](double w) { return w < 0.0; }) ||
      (!v.weights.empty() &&
       std::all_of(v.weights.begin(), v.weights.end(), [](double w) { return w == 0.0; })))
    c.fault(table, "weights", path, "must be 0 or above, and not all 0",
            "count how often each comes");
  if (chooses_as_it_goes(c.plan.sampling.method) ||
      c.plan.sampling.method == SamplingMethod::sobol_indices) {
    if (v.distribution == Distribution::choice || v.distribution == Distribution::seed)
      c.fault(table, "distribution", path,
              fmt::format("method {} needs quantities that vary continuously",
                          word_of(c.plan.sampling.method)),
              "use monte-carlo, latin-hypercube or sobol, or keep it constant");
  }
  if ((v.at_least || v.at_most) &&
      (v.distribution == Distribution::choice || v.distribution == Distribution::seed ||
       v.distribution == Distribution::fisher))
    c.fault(table, v.at_least ? "at_least" : "at_most", path,
            fmt::format("is nothing of a distribution \"{}\"", word_of(v.distribution)),
            "leave it out");
}

/// Of Fisher's distribution: a dip with its concentration, and a dip direction with that dip.
void check_orientation(const Completing& c, const Value* table, const std::string& path,
                       const Vary& v) {
  if (v.distribution != Distribution::fisher) {
    if (!v.with.empty())
      c.fault(table, "with", path, "belongs to distribution \"fisher\"", "leave it out");
    return;
  }
  const auto is_partner = [&](const Vary& other) {
    return other.distribution == Distribution::fisher &&
           (v.with.empty() ? other.with == v.name : other.name == v.with && other.with.empty());
  };
  if (std::count_if(c.plan.vary.begin(), c.plan.vary.end(), is_partner) != 1) {
    c.fault(
        table, "with", path,
        v.with.empty() ? "the dip direction is missing" : "names no dip of distribution \"fisher\"",
        v.with.empty() ? fmt::format("add another [vary] with with = \"{}\"", v.name)
                       : "name the [vary] that is its dip");
  }
  if (v.with.empty() != v.concentration.has_value())
    c.fault(table, "concentration", path, v.with.empty() ? "is missing" : "is that of the dip",
            v.with.empty() ? "give the concentration kappa" : "leave it out");
}

/// Of method fit: the search begins somewhere between bounds.
void complete_bounds(const Completing& c, const Value* table, const std::string& path, Vary& v) {
  for (const Parameter& p : {low, high}) {
    if (!(v.*(p.field)))
      c.fault(table, p.name, path, "is missing", "method fit looks between low and high");
  }
  if (!v.low || !v.high) return;
  if (*v.low >= *v.high) {
    c.fault(table, "low", path, "is not below high", "give the smallest value as low");
    return;
  }
  const bool logarithmic = v.scale == Scale::log;
  if (logarithmic && *v.low <= 0.0) {
    c.fault(table, "low", path, "must be above 0 where scale is \"log\"", "give a small number");
    return;
  }
  if (!v.start) v.start = logarithmic ? std::sqrt(*v.low * *v.high) : 0.5 * (*v.low + *v.high);
  if (*v.start < *v.low || *v.start > *v.high)
    c.fault(table, "start", path, "lies outside low and high", "give a value between them");
}

}  // namespace

void complete_vary(const Completing& c) {
  const Value* all = find(&c.root, "vary");
  if (c.plan.vary.empty() && c.reading.faults.empty())
    add_fault(c.reading, {1, 1, false}, "vary", "is missing",
              "add [vary.NAME] with key and distribution");
  const SamplingMethod method = c.plan.sampling.method;
  const bool drawn = method != SamplingMethod::grid && method != SamplingMethod::table &&
                     method != SamplingMethod::fit;
  for (Vary& v : c.plan.vary) {
    const Value* table = find(all, v.name);
    const std::string path = "vary." + v.name;
    if (!v.key.empty() && !v.keys.empty())
      c.fault(table, "keys", path, "is given beside key", "give one of them");
    if (v.keys.empty() && v.key.empty())
      c.fault(table, "key", path, "is missing",
              "name the key of the model that varies, as --set does");
    if (!v.key.empty()) v.keys = {v.key};
    v.key.clear();
    if (drawn && !given(table, "distribution"))
      c.fault(table, "distribution", path, "is missing",
              "give one of " + quoted_list(distribution_words));
    if (!drawn) {
      if (method == SamplingMethod::grid) check_values(c, table, path, v);
      if (method == SamplingMethod::fit) complete_bounds(c, table, path, v);
      continue;
    }
    if (!given(table, "distribution")) continue;
    complete_spread(c, table, path, v);
    check_parameters(c, table, path, v);
    check_order(c, table, path, v);
    check_values(c, table, path, v);
    check_orientation(c, table, path, v);
  }
}

}  // namespace edda
