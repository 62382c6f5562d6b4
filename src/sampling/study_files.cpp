// Table and summary of a study.
#include <algorithm>

#include "model/study/study_keys.hpp"
#include "results/json.hpp"
#include "results/version.hpp"
#include "sampling/study_results.hpp"

namespace edda {
namespace {

void add_list(Json& j, std::string_view name, const std::vector<double>& values) {
  j.key(name).open_list();
  for (const double x : values) j.value(x);
  j.close();
}

/// One number for each quantity, by its name.
void add_by_quantity(Json& j, std::string_view name, const StudyPlan& plan,
                     const std::vector<double>& values) {
  if (values.empty()) return;
  j.key(name).open_object();
  for (std::size_t q = 0; q < plan.vary.size() && q < values.size(); ++q)
    j.pair(plan.vary[q].name, values[q]);
  j.close();
}

void add_asked(Json& j, const StudyPlan& plan, const AskedNumbers& a) {
  j.open_object().pair("name", a.name).pair("numbers", a.values.size());
  j.pair("unstable", a.unstable).pair("unlimited", a.unlimited).pair("without_answer", a.none);
  if (!a.values.empty()) {
    j.pair("mean", a.mean).pair("sd", a.sd).pair("least", a.least).pair("most", a.most);
    j.pair("quantile_05", a.quantile_05).pair("median", a.median);
    j.pair("quantile_95", a.quantile_95);
  }
  add_by_quantity(j, "rank_correlation", plan, a.rank_correlation);
  j.close();
}

void add_failure(Json& j, const StudyPlan& plan, const StudyResults& r) {
  if (!r.probability) return;
  j.key("failure").open_object().pair("ask", plan.failure->ask);
  j.pair("below", plan.failure->below).pair("above", plan.failure->above);
  j.pair("probability", *r.probability).pair("confidence", plan.sampling.confidence);
  if (r.interval) j.pair("low", r.interval->low).pair("high", r.interval->high);
  if (!r.run.reliability) j.pair("failed", r.failed.size()).pair("of", r.answers);
  if (r.bounds) j.pair("at_least", r.bounds->low).pair("at_most", r.bounds->high);
  if (r.run.reliability && r.run.reliability->index)
    j.pair("reliability_index", *r.run.reliability->index);
  if (r.run.reliability && r.run.reliability->form)
    j.pair("probability_form", *r.run.reliability->form);
  if (r.run.reliability && !r.run.reliability->design_point.empty()) {
    const Reliability& found = *r.run.reliability;
    const auto spread = [&](const std::vector<double>& drawn) {
      std::vector<double> all(plan.vary.size(), 0.0);
      for (std::size_t k = 0; k < drawn.size(); ++k) all[found.drawn[k]] = drawn[k];
      return all;
    };
    add_by_quantity(j, "design_point", plan, spread(found.design_point));
    add_by_quantity(j, "importance", plan, spread(found.importance));
  }
  j.close();
}

void add_fitted(Json& j, const StudyPlan& plan, const Fitted& f) {
  j.key("fit").open_object().pair("converged", f.converged);
  j.pair("sum_of_squares", f.sum_of_squares);
  add_by_quantity(j, "values", plan, f.values);
  add_by_quantity(j, "errors", plan, f.errors);
  j.key("correlation").open_object();
  for (std::size_t q = 0; q < plan.vary.size(); ++q)
    add_by_quantity(j, plan.vary[q].name, plan, f.correlation[q]);
  j.close();
  j.key("measurements").open_list();
  for (std::size_t k = 0; k < plan.ask.size(); ++k) {
    const Ask& a = plan.ask[k];
    j.open_object().pair("name", a.name).pair("measured", a.measured).pair("error", a.error);
    j.pair("computed", *a.measured + f.differences[k] * *a.error);
    j.pair("difference_over_error", f.differences[k]).close();
  }
  j.close().key("not_told_apart").open_list();
  for (const auto& [a, b] : told_together(f))
    j.open_list().value(plan.vary[a].name).value(plan.vary[b].name).close();
  j.close().key("not_told").open_list();
  for (const std::size_t q : not_told(plan, f)) j.value(plan.vary[q].name);
  j.close().close();
}

void add_sobol(Json& j, const StudyPlan& plan, const SobolIndices& s) {
  j.key("sobol_indices")
      .open_object()
      .pair("ask", plan.failure ? plan.failure->ask : plan.ask[0].name);
  add_by_quantity(j, "first", plan, s.first);
  add_by_quantity(j, "first_low", plan, s.first_low);
  add_by_quantity(j, "first_high", plan, s.first_high);
  add_by_quantity(j, "total", plan, s.total);
  add_by_quantity(j, "total_low", plan, s.total_low);
  add_by_quantity(j, "total_high", plan, s.total_high);
  j.close();
}

}  // namespace

ColumnOwners columns_of(const StudyPlan& plan) {
  ColumnOwners owners;
  owners.quantities = names_in(plan.vary);
  owners.answers = names_in(plan.ask);
  return owners;
}

std::string study_csv(const StudyPlan& plan, const StudyResults& r) {
  Csv csv = begin_table(ResultFile::study, columns_of(plan));
  for (const auto& [sample, answer] : r.run.rows) {
    if (sample >= r.run.samples) continue;
    csv.add(sample);
    for (const double x : r.run.points[sample]) csv.add(x);
    for (std::size_t k = 0; k < plan.ask.size(); ++k) csv.add(answer.cells[k]);
    const std::optional<bool> failed = has_failed(plan, answer);
    csv.add(!failed ? "" : *failed ? "1" : "0").add(answer.message).end();
  }
  return csv.text();
}

std::string study_summary(const StudyPlan& plan, const StudyResults& r) {
  constexpr std::string_view ends[] = {"complete", "part", "interrupted"};
  Json j;
  j.open_object().pair("version", version).pair("title", plan.title);
  j.pair("status", ends[static_cast<int>(r.run.end)]).pair("message", r.message);
  j.pair("method", word_of(plan.sampling.method)).pair("seed", plan.sampling.seed);
  j.pair("samples", r.run.samples).pair("ended_early", r.run.ended_early);
  add_failure(j, plan, r);
  j.key("asked").open_list();
  for (const AskedNumbers& a : r.asked) add_asked(j, plan, a);
  j.close();
  if (r.run.fitted) add_fitted(j, plan, *r.run.fitted);
  if (r.sobol) add_sobol(j, plan, *r.sobol);
  if (r.map) {
    const KeyBlockMap& m = *r.map;
    const Vec2 at = m.places[m.most()];
    j.key("map").open_object().pair("places", m.places.size()).pair("samples", m.samples);
    j.pair("most", m.part(m.most()));
    if (m.part(m.most()) > 0.0) j.key("at").open_list().value(at.x).value(at.y).close();
    j.close();
  }
  if (!r.run.fitted) {
    const std::vector<std::size_t> worst = worst_samples(plan, r, 10);
    add_list(j, "worst", {worst.begin(), worst.end()});
  }
  return j.close().text();
}

}  // namespace edda
