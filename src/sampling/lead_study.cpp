#include "sampling/lead_study.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <chrono>
#include <cmath>
#include <nlohmann/json.hpp>
#include <thread>

#include "model/study/study_keys.hpp"
#include "run/wall_clock.hpp"
#include "sampling/worker_pool.hpp"

namespace edda {
namespace {

using nlohmann::json;
using Clock = std::chrono::steady_clock;

/// Every so many samples it is asked whether the interval is narrow enough, so that the outcome
/// does not depend on which are finished when.
constexpr std::size_t asked_every = 50;

std::size_t row_of(const StudyPlan& plan, const std::string& ask) {
  for (std::size_t i = 0; i < plan.ask.size(); ++i) {
    if (plan.ask[i].name == ask) return i;
  }
  return 0;
}

Reliability reliability_in(const json& answer, const std::vector<std::size_t>& drawn) {
  const auto number = [&](const char* name) {
    return answer.contains(name) ? std::optional<double>(answer[name].get<double>()) : std::nullopt;
  };
  Reliability r;
  r.probability = answer["probability"].get<double>();
  r.low = number("low");
  r.high = number("high");
  r.index = number("reliability_index");
  r.form = number("probability_form");
  r.design_point = answer.value("design_point", r.design_point);
  r.importance = answer.value("importance", r.importance);
  r.drawn = drawn;
  return r;
}

Fitted fitted_in(const json& answer) {
  Fitted f;
  answer["values"].get_to(f.values);
  answer["errors"].get_to(f.errors);
  answer["correlation"].get_to(f.correlation);
  answer["differences"].get_to(f.differences);
  answer["sum_of_squares"].get_to(f.sum_of_squares);
  answer["converged"].get_to(f.converged);
  return f;
}

/// The request that begins a fit.
json fit_request(const StudyPlan& plan) {
  json parameters = json::array(), measured = json::array();
  for (const Vary& v : plan.vary) {
    parameters.push_back(
        {{"low", *v.low}, {"high", *v.high}, {"start", *v.start}, {"log", v.scale == Scale::log}});
  }
  for (const Ask& a : plan.ask) measured.push_back({{"value", *a.measured}, {"error", *a.error}});
  return {{"task", "fit"},
          {"parameters", parameters},
          {"measured", measured},
          {"difference", 0.1 * plan.sampling.difference},
          {"iterations", 50}};
}

class Lead {
 public:
  Lead(const StudyPlan& plan, SampleFolder& folder, const StudyOptions& options,
       SamplerProcess& sampler)
      : plan_(plan),
        folder_(folder),
        options_(options),
        sampler_(sampler),
        pool_(options.worker, options.jobs) {}

  Result<StudyRun> all_at_once();
  Result<StudyRun> as_it_goes();

 private:
  enum class Waited { finished, interrupted };
  /// Until done() holds, which is asked whenever there are new rows.
  template <class Done>
  Result<Waited> wait_until(std::size_t of, const Done& done);
  bool have_all(std::size_t first, std::size_t end) const;
  /// The number of samples after which the interval is narrow enough; nothing: not yet.
  Result<std::optional<std::size_t>> narrow_enough();
  json request(const std::vector<std::size_t>& drawn, const json& variables) const;
  Trouble add_points(const json& rows, std::size_t first, const std::vector<std::size_t>& drawn);
  Result<double> value_of(std::size_t sample, std::size_t ask) const;
  Result<json> values_of(std::size_t first, std::size_t end) const;

  const StudyPlan& plan_;
  SampleFolder& folder_;
  const StudyOptions& options_;
  SamplerProcess& sampler_;
  WorkerPool pool_;
  StudyRun run_;
  std::size_t asked_ = 0;  ///< samples for which the interval is known to be too wide
};

bool Lead::have_all(std::size_t first, std::size_t end) const {
  for (std::size_t s = first; s < end; ++s) {
    if (options_.shard.has(s) && !run_.rows.contains(s)) return false;
  }
  return true;
}

template <class Done>
Result<Lead::Waited> Lead::wait_until(std::size_t of, const Done& done) {
  auto recovered = Clock::now();
  while (true) {
    const auto start = Clock::now();
    if (options_.stop != nullptr && options_.stop->load()) return Waited::interrupted;
    if (Trouble t = pool_.look_after(folder_, plan_)) return Faults{*t};
    run_.rows = folder_.rows(plan_);
    if (options_.progress) options_.progress(run_.rows.size(), of);
    const Result<bool> is_done = done();
    if (!is_done.ok()) return is_done.faults();
    if (is_done.value() || !options_.waits) return Waited::finished;
    // Workers of other machines that were killed.
    if (since(recovered) > 5.0) {
      if (Trouble t = folder_.recover()) return Faults{*t};
      recovered = Clock::now();
    }
    // Looking takes no more than a tenth of the time.
    const double pause = std::clamp(9.0 * since(start), 0.002, 2.0);
    std::this_thread::sleep_for(std::chrono::duration<double>(pause));
  }
}

Result<std::optional<std::size_t>> Lead::narrow_enough() {
  using Number = std::optional<std::size_t>;
  if (plan_.sampling.half_width <= 0.0) return Number{};
  for (std::size_t n = asked_ + asked_every; n <= run_.samples; n += asked_every) {
    if (!have_all(0, n)) return Number{};
    std::size_t failures = 0, answers = 0;
    for (std::size_t s = 0; s < n; ++s) {
      const std::optional<bool> failed = has_failed(plan_, run_.rows.at(s));
      answers += failed.has_value();
      failures += failed.value_or(false);
    }
    const Result<Interval> interval =
        interval_of(failures, answers, plan_.sampling.confidence, sampler_);
    if (!interval.ok()) return interval.faults();
    if (interval.value().half_width() <= plan_.sampling.half_width) return Number{n};
    asked_ = n;
  }
  return Number{};
}

Result<StudyRun> Lead::all_at_once() {
  Result<Points> points = folder_.points(plan_);
  if (!points.ok()) return points.faults();
  run_.points = std::move(points.value());
  run_.samples = run_.points.size();
  // A study that has had more may be looked at with fewer.
  if (is_random(plan_.sampling.method))
    run_.samples = std::min(run_.samples, static_cast<std::size_t>(*plan_.sampling.samples));
  const auto done = [&]() -> Result<bool> {
    const auto enough = narrow_enough();
    if (!enough.ok()) return enough.faults();
    if (enough.value()) {
      run_.samples = *enough.value();
      run_.ended_early = run_.samples < run_.points.size();
      folder_.withdraw();
      return true;
    }
    return have_all(0, run_.samples);
  };
  const Result<Waited> waited = wait_until(run_.samples, done);
  if (!waited.ok()) return waited.faults();
  const auto counts = [&](const auto& row) { return row.first < run_.samples; };
  const bool whole = static_cast<std::size_t>(
                         std::count_if(run_.rows.begin(), run_.rows.end(), counts)) == run_.samples;
  run_.end = waited.value() == Waited::interrupted ? StudyEnd::interrupted
             : whole                               ? StudyEnd::complete
                                                   : StudyEnd::part;
  return std::move(run_);
}

/// The number of an answer; that of a sample without an equilibrium is 0.
Result<double> Lead::value_of(std::size_t sample, std::size_t ask) const {
  const SampleAnswer& row = run_.rows.at(sample);
  const std::string& cell = row.cells[ask];
  const std::optional<double> number = number_in(cell);
  if (number || cell == "unstable") return number.value_or(0.0);
  return Fault{{"", folder_.path(), 0, 0},
               fmt::format("sample {} gave no value of {}: {}", sample, plan_.ask[ask].name,
                           row.message.empty() ? cell : row.message),
               "the method needs one everywhere; keep the values that vary within narrower bounds"};
}

/// Of a reliability method's points the value that decides about failure, of a fit's all of them.
Result<json> Lead::values_of(std::size_t first, std::size_t end) const {
  json values = json::array();
  const bool fits = plan_.sampling.method == SamplingMethod::fit;
  for (std::size_t s = first; s < end; ++s) {
    json all = json::array();
    for (std::size_t k = 0; k < plan_.ask.size(); ++k) {
      if (!fits && k != row_of(plan_, plan_.failure->ask)) continue;
      const Result<double> value = value_of(s, k);
      if (!value.ok()) return value.faults();
      all.push_back(value.value());
    }
    values.push_back(fits ? all : all[0]);
  }
  return values;
}

/// The request that begins the method.
json Lead::request(const std::vector<std::size_t>& drawn, const json& variables) const {
  const FailureCriterion& f = *plan_.failure;
  const double threshold = f.below ? *f.below : *f.above;
  return {{"task", "reliability"},
          {"variables", variables},
          {"dependence", dependence_of(plan_, drawn)},
          {"method", word_of(plan_.sampling.method)},
          {"threshold", threshold},
          {"fails", f.below ? "below" : "above"},
          {"difference", plan_.sampling.difference},
          {"tolerance", plan_.sampling.tolerance},
          {"scale", std::max(std::abs(threshold), 1e-12)},
          {"seed", plan_.sampling.seed},
          {"count", plan_.sampling.samples.value_or(1)},
          {"block", std::max(plan_.sampling.samples.value_or(1) / 10, 1LL)},
          {"confidence", plan_.sampling.confidence}};
}

/// Adds the points to those that are there, from number `first` on; those that are there already
/// are the same.
Trouble Lead::add_points(const json& rows, std::size_t first,
                         const std::vector<std::size_t>& drawn) {
  const std::size_t before = run_.points.size(), end = first + rows.size();
  for (std::size_t s = std::max(first, before); s < end; ++s) {
    std::vector<double> point(plan_.vary.size(), 0.0);
    for (std::size_t k = 0; k < drawn.size(); ++k)
      point[drawn[k]] = rows[s - first][k].get<double>();
    run_.points.push_back(std::move(point));
  }
  if (run_.points.size() == before) return {};
  return folder_.issue(plan_, run_.points, before);
}

/// The method is begun anew each time; points that are there already it asks again in the same
/// order, and has their values at once.
Result<StudyRun> Lead::as_it_goes() {
  Result<Points> known = folder_.points(plan_);
  if (!known.ok()) return known.faults();
  run_.points = std::move(known.value());
  const bool fits = plan_.sampling.method == SamplingMethod::fit;
  std::vector<std::size_t> drawn;
  const json variables = variables_of(plan_, drawn);
  json line = fits ? fit_request(plan_) : request(drawn, variables);
  while (true) {
    const Result<json> answer = sampler_.ask(line);
    if (!answer.ok()) return answer.faults();
    if (!answer.value().contains("ask")) {
      const json& found = answer.value()["answer"];
      if (fits) {
        run_.fitted = fitted_in(found);
      } else {
        run_.reliability = reliability_in(found, drawn);
      }
      return std::move(run_);
    }
    const json& rows = answer.value()["ask"];
    const std::size_t first = run_.samples, end = first + rows.size();
    if (Trouble t = add_points(rows, first, drawn)) return Faults{*t};
    const Result<Waited> waited =
        wait_until(0, [&]() -> Result<bool> { return have_all(first, end); });
    if (!waited.ok()) return waited.faults();
    if (waited.value() == Waited::interrupted || !have_all(first, end)) {
      run_.end = StudyEnd::interrupted;
      return std::move(run_);
    }
    const Result<json> values = values_of(first, end);
    if (!values.ok()) return values.faults();
    line = json{{"values", values.value()}};
    run_.samples = end;
  }
}

}  // namespace

std::optional<double> number_in(const std::string& cell) {
  double value = 0.0;
  const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
  if (cell.empty() || error != std::errc{} || end != cell.data() + cell.size() ||
      !std::isfinite(value))
    return {};
  return value;
}

std::optional<bool> has_failed(const StudyPlan& plan, const SampleAnswer& answer) {
  if (!plan.failure) return {};
  const FailureCriterion& f = *plan.failure;
  const std::string& cell = answer.cells.at(row_of(plan, f.ask));
  const std::optional<double> value = number_in(cell);
  if (value) return f.below ? *value < *f.below : *value > *f.above;
  if (cell == "unstable" && f.below) return true;
  if (cell == "unlimited") return !f.below.has_value();
  return {};
}

Result<Interval> interval_of(std::size_t failures, std::size_t count, double confidence,
                             SamplerProcess& sampler) {
  if (count == 0) return Interval{};
  const Result<json> answer = sampler.ask(
      {{"task", "interval"}, {"failures", failures}, {"count", count}, {"confidence", confidence}});
  if (!answer.ok()) return answer.faults();
  return Interval{answer.value()["low"].get<double>(), answer.value()["high"].get<double>()};
}

Result<StudyRun> lead_study(const StudyPlan& plan, const std::string& model_text,
                            SampleFolder& folder, const StudyOptions& options,
                            SamplerProcess& sampler) {
  if (Trouble t = folder.open(plan, model_text, options.shard, sampler)) return Faults{*t};
  Lead lead(plan, folder, options, sampler);
  return chooses_as_it_goes(plan.sampling.method) ? lead.as_it_goes() : lead.all_at_once();
}

}  // namespace edda
