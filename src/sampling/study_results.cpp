#include "sampling/study_results.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numeric>

#include "base/text.hpp"
#include "model/study/study_keys.hpp"

namespace edda {
namespace {

using nlohmann::json;

/// The value below which the part p lies, linear between the order statistics.
double quantile(const std::vector<double>& sorted, double p) {
  const double at = p * static_cast<double>(sorted.size() - 1);
  const auto i = static_cast<std::size_t>(at);
  const double next = sorted[std::min(i + 1, sorted.size() - 1)];
  return sorted[i] + (at - static_cast<double>(i)) * (next - sorted[i]);
}

void add_moments(AskedNumbers& a) {
  if (a.values.empty()) return;
  const auto n = static_cast<double>(a.values.size());
  a.mean = std::accumulate(a.values.begin(), a.values.end(), 0.0) / n;
  double squares = 0.0;
  for (const double x : a.values) squares += (x - a.mean) * (x - a.mean);
  a.sd = n > 1.0 ? std::sqrt(squares / (n - 1.0)) : 0.0;
  std::vector<double> sorted = a.values;
  std::sort(sorted.begin(), sorted.end());
  a.least = sorted.front();
  a.most = sorted.back();
  a.quantile_05 = quantile(sorted, 0.05);
  a.median = quantile(sorted, 0.5);
  a.quantile_95 = quantile(sorted, 0.95);
}

bool varies(const std::vector<double>& values) {
  return std::any_of(values.begin(), values.end(), [&](double x) { return x != values.front(); });
}

std::vector<double> column_of(const StudyRun& run, const AskedNumbers& a, std::size_t quantity) {
  std::vector<double> column;
  for (const std::size_t s : a.samples) column.push_back(run.points[s][quantity]);
  return column;
}

Trouble add_ranks(const StudyPlan& plan, const StudyRun& run, AskedNumbers& a,
                  SamplerProcess& sampler) {
  constexpr std::size_t fewest = 10;
  if (a.values.size() < fewest || !varies(a.values)) return {};
  json inputs = json::array();
  std::vector<std::size_t> varied;
  for (std::size_t q = 0; q < plan.vary.size(); ++q) {
    if (varies(column_of(run, a, q))) varied.push_back(q);
  }
  if (varied.empty()) return {};
  for (const std::size_t s : a.samples) {
    json row = json::array();
    for (const std::size_t q : varied) row.push_back(run.points[s][q]);
    inputs.push_back(std::move(row));
  }
  const Result<json> answer =
      sampler.ask({{"task", "ranks"}, {"inputs", std::move(inputs)}, {"values", a.values}});
  if (!answer.ok()) return answer.faults().front();
  a.rank_correlation.assign(plan.vary.size(), 0.0);
  for (std::size_t k = 0; k < varied.size(); ++k)
    a.rank_correlation[varied[k]] = answer.value()["spearman"][k].get<double>();
  return {};
}

AskedNumbers numbers_of(const StudyRun& run, const std::string& name, std::size_t k) {
  AskedNumbers a;
  a.name = name;
  for (const auto& [sample, answer] : run.rows) {
    if (sample >= run.samples) continue;
    const std::string& cell = answer.cells[k];
    if (const auto number = number_in(cell)) {
      a.values.push_back(*number);
      a.samples.push_back(sample);
    } else {
      ++(cell == "unstable" ? a.unstable : cell == "unlimited" ? a.unlimited : a.none);
    }
  }
  add_moments(a);
  return a;
}

/// Those of the ask that decides about failure, else of the first.
Result<std::optional<SobolIndices>> sobol_of(const StudyPlan& plan, const StudyResults& r,
                                             SamplerProcess& sampler) {
  using Maybe = std::optional<SobolIndices>;
  if (plan.sampling.method != SamplingMethod::sobol_indices || r.run.end != StudyEnd::complete)
    return Maybe{};
  const AskedNumbers& a = main_of(plan, r);
  if (a.values.size() != r.run.samples || !varies(a.values)) return Maybe{};
  const Result<json> answer = sampler.ask({{"task", "sobol-indices"},
                                           {"inputs", r.run.points},
                                           {"values", a.values},
                                           {"count", plan.sampling.samples.value_or(0)}});
  if (!answer.ok()) return answer.faults();
  const auto list = [&](const char* name) {
    return answer.value()[name].get<std::vector<double>>();
  };
  return Maybe{SobolIndices{list("first"), list("first_low"), list("first_high"), list("total"),
                            list("total_low"), list("total_high")}};
}

/// P(F) = 3.1 % (95 % interval 2.7 to 3.5 %).
Trouble add_probability(const StudyPlan& plan, StudyResults& r, SamplerProcess& sampler) {
  if (r.run.reliability) {
    r.probability = r.run.reliability->probability;
    if (r.run.reliability->low)
      r.interval = Interval{*r.run.reliability->low, *r.run.reliability->high};
    return {};
  }
  if (!plan.failure || !is_random(plan.sampling.method)) return {};
  std::size_t without = 0;
  for (const auto& [sample, answer] : r.run.rows) {
    if (sample >= r.run.samples) continue;
    const std::optional<bool> failed = has_failed(plan, answer);
    if (!failed) ++without;
    if (failed.value_or(false)) r.failed.push_back(sample);
    r.answers += failed.has_value();
  }
  if (r.answers == 0) return {};
  const auto all = static_cast<double>(r.answers + without);
  r.probability = static_cast<double>(r.failed.size()) / static_cast<double>(r.answers);
  Result<Interval> interval =
      interval_of(r.failed.size(), r.answers, plan.sampling.confidence, sampler);
  if (!interval.ok()) return interval.faults().front();
  r.interval = interval.value();
  if (without > 0) {
    r.bounds = Interval{static_cast<double>(r.failed.size()) / all,
                        static_cast<double>(r.failed.size() + without) / all};
  }
  return {};
}

std::string percent(double p) {
  return number_text(100.0 * p, 3);
}

/// "friction 30.21 +- 0.35 degrees, kn 2.1 +- 0.2; 24 runs".
std::string fit_message(const StudyPlan& plan, const Fitted& f, std::size_t runs) {
  std::string text;
  for (std::size_t q = 0; q < plan.vary.size(); ++q) {
    const Vary& v = plan.vary[q];
    text += fmt::format("{}{} {} +- {}{}", q == 0 ? "" : ", ", v.name, number_text(f.values[q], 5),
                        number_text(f.errors[q], 2), v.unit.empty() ? "" : " " + v.unit);
  }
  text += fmt::format("; {}", counted(runs, "run"));
  if (!f.converged) text += "; the search did not come to an end";
  for (const auto& [a, b] : told_together(f)) {
    text += fmt::format("; the measurements do not tell {} and {} apart", plan.vary[a].name,
                        plan.vary[b].name);
  }
  for (const std::size_t q : not_told(plan, f))
    text += fmt::format("; the measurements do not tell {}", plan.vary[q].name);
  return text;
}

std::string message_of(const StudyPlan& plan, const StudyResults& r) {
  const std::string samples = counted(r.run.samples, "sample");
  if (r.run.end == StudyEnd::part)
    return fmt::format("this part of {} is done; others are not", samples);
  if (r.run.end == StudyEnd::interrupted)
    return fmt::format("interrupted with {} of {} done; start it again to go on", r.run.rows.size(),
                       samples);
  if (r.run.fitted) return fit_message(plan, *r.run.fitted, r.run.samples);
  if (r.probability) {
    std::string text = fmt::format("probability of failure {} %", percent(*r.probability));
    if (r.interval) {
      text += fmt::format(", {:.3g} % interval {} to {} %", 100.0 * plan.sampling.confidence,
                          percent(r.interval->low), percent(r.interval->high));
    }
    if (r.run.reliability && r.run.reliability->index)
      text += fmt::format(", reliability index {:.4g}", *r.run.reliability->index);
    text += fmt::format("; {}", samples);
    if (r.bounds) {
      text +=
          fmt::format("; {} gave no answer: it lies between {} and {} % whatever they are",
                      r.run.samples - r.answers, percent(r.bounds->low), percent(r.bounds->high));
    }
    return text;
  }
  if (r.asked.empty() || r.asked.front().values.empty())
    return fmt::format("{}, none of which gave a number", samples);
  const AskedNumbers& a = r.asked.front();
  return fmt::format("{}: {} of mean {:.4g}, standard deviation {:.3g}, from {:.4g} to {:.4g}",
                     samples, a.name, a.mean, a.sd, a.least, a.most);
}

}  // namespace

std::vector<std::pair<std::size_t, std::size_t>> told_together(const Fitted& f) {
  constexpr double apart = 0.98;
  std::vector<std::pair<std::size_t, std::size_t>> pairs;
  for (std::size_t a = 0; a < f.values.size(); ++a) {
    for (std::size_t b = a + 1; b < f.values.size(); ++b) {
      if (std::abs(f.correlation[a][b]) > apart) pairs.emplace_back(a, b);
    }
  }
  return pairs;
}

std::vector<std::size_t> not_told(const StudyPlan& plan, const Fitted& f) {
  constexpr double part = 0.3;  // of the range from low to high
  std::vector<std::size_t> list;
  const auto pairs = told_together(f);
  for (std::size_t q = 0; q < f.values.size(); ++q) {
    const Vary& v = plan.vary[q];
    const double range =
        v.scale == Scale::log ? f.values[q] * std::log(*v.high / *v.low) : *v.high - *v.low;
    const bool paired = std::any_of(pairs.begin(), pairs.end(),
                                    [&](const auto& p) { return p.first == q || p.second == q; });
    if (!paired && f.errors[q] > part * range) list.push_back(q);
  }
  return list;
}

const AskedNumbers& main_of(const StudyPlan& plan, const StudyResults& results) {
  for (const AskedNumbers& a : results.asked) {
    if (plan.failure && a.name == plan.failure->ask) return a;
  }
  return results.asked.front();
}

Result<StudyResults> results_of(const StudyPlan& plan, StudyRun run, SamplerProcess& sampler) {
  StudyResults r;
  r.run = std::move(run);
  for (std::size_t k = 0; k < plan.ask.size(); ++k) {
    AskedNumbers a = numbers_of(r.run, plan.ask[k].name, k);
    if (r.run.end == StudyEnd::complete) {
      if (Trouble t = add_ranks(plan, r.run, a, sampler)) return Faults{*t};
    }
    r.asked.push_back(std::move(a));
  }
  if (Trouble t = add_probability(plan, r, sampler)) return Faults{*t};
  Result<std::optional<SobolIndices>> sobol = sobol_of(plan, r, sampler);
  if (!sobol.ok()) return sobol.faults();
  r.sobol = std::move(sobol.value());
  if (plan.map) r.map = key_block_map(plan, r.run);
  r.message = message_of(plan, r);
  return r;
}

std::vector<std::size_t> worst_samples(const StudyPlan& plan, const StudyResults& r,
                                       std::size_t count) {
  const AskedNumbers& a = main_of(plan, r);
  const bool largest = plan.failure && plan.failure->above;
  // Without an equilibrium there is no number, and nothing is worse.
  std::vector<std::size_t> worst;
  for (const std::size_t s : r.failed) {
    if (!std::binary_search(a.samples.begin(), a.samples.end(), s)) worst.push_back(s);
  }
  std::vector<std::size_t> order(a.values.size());
  std::iota(order.begin(), order.end(), 0U);
  std::stable_sort(order.begin(), order.end(), [&](std::size_t i, std::size_t j) {
    return largest ? a.values[i] > a.values[j] : a.values[i] < a.values[j];
  });
  for (const std::size_t i : order) worst.push_back(a.samples[i]);
  worst.resize(std::min(count, worst.size()));
  return worst;
}

}  // namespace edda
