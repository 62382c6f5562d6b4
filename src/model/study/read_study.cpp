// Reads a study's file, and checks what one key cannot say alone.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <set>

#include "base/text.hpp"
#include "model/completion/complete_tools.hpp"
#include "model/files/document.hpp"
#include "model/files/file_text.hpp"
#include "model/files/overrides.hpp"
#include "model/files/reader.hpp"
#include "model/study/study_keys.hpp"
#include "model/table/nearest.hpp"

namespace edda {
namespace {

/// The plan with the file's values, where faults can be placed.
struct Completing {
  StudyPlan& plan;
  const Value& root;
  Reading& reading;

  void fault(const Value* table, std::string_view key, const std::string& path, std::string problem,
             std::string remedy) const {
    const Place place = table == nullptr ? Place{1, 1, false} : place_of(table, key);
    add_fault(reading, place, path + '.' + std::string(key), std::move(problem), std::move(remedy));
  }
};

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
      (v.distribution == Distribution::choice || v.distribution == Distribution::seed))
    c.fault(table, v.at_least ? "at_least" : "at_most", path,
            fmt::format("is nothing of a distribution \"{}\"", word_of(v.distribution)),
            "leave it out");
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
  }
}

void complete_sampling(const Completing& c) {
  Sampling& s = c.plan.sampling;
  const Value* table = find(&c.root, "sampling");
  const SamplingMethod m = s.method;
  const auto wrong = [&](std::string_view key, const std::string& problem,
                         const std::string& remedy) {
    c.fault(table, key, "sampling", problem, remedy);
  };
  const bool counted =
      is_random(m) || m == SamplingMethod::subset || m == SamplingMethod::sobol_indices;
  if (counted && !s.samples && !given(table, "samples"))
    wrong("samples", "is missing", "give the number of samples");
  if (!counted && s.samples)
    wrong("samples", fmt::format("is nothing of method {}", word_of(m)), "leave it out");
  if ((m == SamplingMethod::table) != !s.table.empty())
    wrong("table",
          s.table.empty() ? "is missing" : fmt::format("is nothing of method {}", word_of(m)),
          s.table.empty() ? "name a CSV file with a column for each quantity" : "leave it out");
  if (!s.table.empty()) s.table = beside_model(s.table, c.plan.file);
  if (s.half_width > 0.0 && m != SamplingMethod::monte_carlo)
    wrong("half_width", fmt::format("is nothing of method {}", word_of(m)),
          "use monte-carlo, whose samples may end anywhere, or leave it out");
  const bool fits = m == SamplingMethod::fit;
  if (fits && c.plan.failure) wrong("method", "\"fit\" knows no failures", "leave [failure] out");
  if ((s.half_width > 0.0 || (chooses_as_it_goes(m) && !fits)) && !c.plan.failure)
    wrong(s.half_width > 0.0 ? "half_width" : "method", "needs to know what a failure is",
          "add [failure] with below or above");
}

void complete_correlated(const Completing& c) {
  std::set<std::string> paired;
  for (std::size_t i = 0; i < c.plan.correlated.size(); ++i) {
    const Correlated& r = c.plan.correlated[i];
    const Value* table = element(c.root, "correlated", i);
    const std::string path = fmt::format("correlated.{}", i);
    if (r.between.size() != 2) {
      c.fault(table, "between", path, "must be two names", "name two quantities of [vary]");
      continue;
    }
    const std::vector<std::string_view> known = [&] {
      std::vector<std::string_view> names;
      for (const Vary& v : c.plan.vary) names.push_back(v.name);
      return names;
    }();
    for (const std::string& name : r.between) {
      const auto v = std::find_if(c.plan.vary.begin(), c.plan.vary.end(),
                                  [&](const Vary& x) { return x.name == name; });
      if (v == c.plan.vary.end()) {
        c.fault(table, "between", path, fmt::format("no [vary] is called \"{}\"", clipped(name)),
                suggestion(name, known));
      } else if (v->distribution == Distribution::seed || v->distribution == Distribution::choice) {
        c.fault(table, "between", path, fmt::format("\"{}\" does not vary continuously", name),
                "leave it out");
      }
      if (r.copula != Copula::normal && !paired.insert(name).second)
        c.fault(table, "between", path,
                fmt::format("\"{}\" depends on another quantity, too", name),
                "use copula normal for more than two");
      if (r.copula == Copula::normal && paired.contains(name))
        c.fault(table, "between", path,
                fmt::format("\"{}\" depends on another quantity, too", name),
                "use copula normal for both");
    }
    const bool normal = r.copula == Copula::normal;
    if (normal != r.rank.has_value())
      c.fault(table, "rank", path, normal ? "is missing" : "belongs to copula normal",
              normal ? "give the coefficient of rank correlation" : "give theta");
    if (normal == r.theta.has_value())
      c.fault(table, "theta", path, normal ? "belongs to the other copulas" : "is missing",
              normal ? "give rank" : "give the copula's parameter");
    const bool too_small = (r.copula == Copula::clayton && r.theta && *r.theta <= 0.0) ||
                           (r.copula == Copula::gumbel && r.theta && *r.theta < 1.0) ||
                           (r.copula == Copula::frank && r.theta && *r.theta == 0.0);
    if (too_small)
      c.fault(table, "theta", path, "is too small",
              "clayton needs theta above 0, gumbel 1 or above, frank any but 0");
  }
  if (!c.plan.correlated.empty() && c.plan.sampling.method == SamplingMethod::sobol_indices)
    c.fault(element(c.root, "correlated", 0), "between", "correlated.0",
            "method sobol-indices needs independent quantities", "leave [[correlated]] out");
}

void complete_ask(const Completing& c) {
  const Value* all = find(&c.root, "ask");
  if (c.plan.ask.empty() && c.reading.faults.empty())
    add_fault(c.reading, {1, 1, false}, "ask", "is missing",
              "add [ask.NAME] with of = \"limit\", \"fos\", \"keyblocks\" or \"run\"");
  for (Ask& a : c.plan.ask) {
    const Value* table = find(all, a.name);
    const bool history = a.value.starts_with("history.");
    if (a.value.empty() && a.of == Analysis::fos) a.value = "factor_of_safety";
    if (a.value.empty() && a.of == Analysis::limit) a.value = "limit.lower";
    if (a.value.empty() && a.of == Analysis::keyblocks) a.value = "key_area";
    if (a.value.empty())
      c.fault(table, "value", "ask." + a.name, "is missing",
              "name a value of summary.json, such as \"energy.friction\", or a column, such as "
              "\"history.crest.ux\"");
    if (history && a.of != Analysis::run)
      c.fault(table, "value", "ask." + a.name, fmt::format("{} has no history", word_of(a.of)),
              "ask of = \"run\"");
    if (a.take != Taken::last && !history)
      c.fault(table, "take", "ask." + a.name, "is nothing of a single value", "leave it out");
    if (std::any_of(c.plan.vary.begin(), c.plan.vary.end(),
                    [&](const Vary& v) { return v.name == a.name; }) ||
        a.name == "sample" || a.name == "failed" || a.name == "message")
      c.fault(table, "", "ask." + a.name, "the name is taken",
              "columns of study.csv need names of their own");
  }
}

/// Measurements that method fit compares with.
void check_measured(const Completing& c) {
  const Value* all = find(&c.root, "ask");
  const bool fits = c.plan.sampling.method == SamplingMethod::fit;
  std::size_t measured = 0;
  for (const Ask& a : c.plan.ask) {
    const Value* table = find(all, a.name);
    if (fits && !a.measured)
      c.fault(table, "measured", "ask." + a.name, "is missing", "give what was measured");
    if (a.measured && !a.error)
      c.fault(table, "error", "ask." + a.name, "is missing",
              "give the standard deviation of the measurement");
    measured += a.measured.has_value();
  }
  if (fits && measured < c.plan.vary.size() && c.reading.faults.empty())
    add_fault(c.reading, {1, 1, false}, "ask",
              fmt::format("has {} for {} quantities", measured, c.plan.vary.size()),
              "fit no more quantities than there are measurements");
}

void complete_failure(const Completing& c) {
  if (!c.plan.failure) return;
  FailureCriterion& f = *c.plan.failure;
  const Value* table = find(&c.root, "failure");
  std::vector<std::string_view> known;
  for (const Ask& a : c.plan.ask) known.push_back(a.name);
  if (f.ask.empty() && known.size() == 1) f.ask = known.front();
  if (f.ask.empty() && known.size() > 1)
    c.fault(table, "ask", "failure", "is missing", "name one of " + quoted_list(known));
  if (!f.ask.empty() && std::find(known.begin(), known.end(), f.ask) == known.end() &&
      !known.empty())
    c.fault(table, "ask", "failure", fmt::format("no [ask] is called \"{}\"", clipped(f.ask)),
            suggestion(f.ask, known));
  one_of(table, "failure", "below", "above", "below = 1.0", c.reading);
}

}  // namespace

Result<StudyPlan> read_study_text(std::string_view text, const std::string& path,
                                  const std::vector<std::string>& overrides) {
  Result<Value> document =
      read_document(text, path, "study", "write a study; docs/study.md has one");
  if (!document) return document.faults();
  Value& root = document.value();
  StudyPlan plan;
  plan.file = path;
  Reading reading;
  reading.file = path;
  reading.sections = study_sections();
  apply_overrides(root, overrides, reading);
  read_sections(root, &plan, reading);
  const Completing c{plan, root, reading};
  complete_sampling(c);
  complete_vary(c);
  complete_correlated(c);
  complete_ask(c);
  check_measured(c);
  complete_failure(c);
  if (reading.faults.empty()) {
    plan.model = beside_model(plan.model, path);
    return plan;
  }
  sort_by_place(reading.faults);
  return std::move(reading.faults);
}

Result<StudyPlan> read_study(const std::string& path, const std::vector<std::string>& overrides) {
  const std::variant<std::string, Fault> text = file_text(path);
  if (const Fault* fault = std::get_if<Fault>(&text)) return *fault;
  return read_study_text(std::get<std::string>(text), path, overrides);
}

}  // namespace edda
