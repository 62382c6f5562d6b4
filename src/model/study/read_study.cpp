// Reads a study's file, and checks what one key cannot say alone.
#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "model/files/document.hpp"
#include "model/files/file_text.hpp"
#include "model/files/overrides.hpp"
#include "model/files/reader.hpp"
#include "model/study/complete_study.hpp"
#include "model/study/study_keys.hpp"
#include "model/table/nearest.hpp"

namespace edda {
namespace {

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
    const std::string asked(table_asked(a));
    if (a.value.empty() && a.of == Analysis::fos) a.value = "factor_of_safety";
    if (a.value.empty() && a.of == Analysis::limit) a.value = "limit.lower";
    if (a.value.empty() && a.of == Analysis::keyblocks) a.value = "key_area";
    if (a.value.empty())
      c.fault(table, "value", "ask." + a.name, "is missing",
              "name a value of summary.json, such as \"energy.friction\", or a column, such as "
              "\"history.crest.ux\"");
    if (!asked.empty() && a.of != Analysis::run)
      c.fault(table, "value", "ask." + a.name, fmt::format("{} has no {}", word_of(a.of), asked),
              "ask of = \"run\"");
    if (a.take != Taken::last && asked.empty())
      c.fault(table, "take", "ask." + a.name, "is nothing of a single value", "leave it out");
    if (a.at && asked.empty())
      c.fault(table, "at", "ask." + a.name, "is nothing of a single value", "leave it out");
    if (a.at && a.take != Taken::last)
      c.fault(table, "at", "ask." + a.name, "is given beside take", "give one of the two");
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
  complete_map(c);
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
