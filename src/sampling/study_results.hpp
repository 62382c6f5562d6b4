// What a study says: probability of failure, distributions, sensitivities.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "results/columns.hpp"
#include "sampling/lead_study.hpp"
#include "sampling/place_map.hpp"

namespace edda {

/// The numbers that one [ask] gave.
struct AskedNumbers {
  std::string name;
  std::vector<double> values;        ///< in the order of the samples
  std::vector<std::size_t> samples;  ///< of each of them
  double mean = 0.0, sd = 0.0, least = 0.0, most = 0.0;
  double quantile_05 = 0.0, median = 0.0, quantile_95 = 0.0;
  std::size_t unstable = 0, unlimited = 0, none = 0;  ///< samples that gave a word, or nothing
  /// [quantities] Spearman's rank correlation with each; empty where samples are too few, or a
  /// quantity never varied.
  std::vector<double> rank_correlation;
};

/// Sobol's indices with their confidence intervals (Saltelli 2010), [quantities].
struct SobolIndices {
  std::vector<double> first, first_low, first_high, total, total_low, total_high;
};

struct StudyResults {
  StudyRun run;
  std::vector<AskedNumbers> asked;
  std::vector<std::size_t> failed;    ///< numbers of the samples that failed
  std::size_t answers = 0;            ///< samples of which it is known whether they fail
  std::optional<double> probability;  ///< of failure
  std::optional<Interval> interval;   ///< its confidence interval
  std::optional<Interval> bounds;     ///< if those without an answer all stood, or all failed
  std::optional<SobolIndices> sobol;
  std::optional<KeyBlockMap> map;
  std::string message;  ///< one sentence
};

Result<StudyResults> results_of(const StudyPlan& plan, StudyRun run, SamplerProcess& sampler);

/// Pairs of quantities that the measurements of a fit do not tell apart: the correlation of their
/// errors is nearly 1 or -1.
std::vector<std::pair<std::size_t, std::size_t>> told_together(const Fitted& fitted);
/// Quantities on which the measurements hardly depend: their error is a good part of their range.
std::vector<std::size_t> not_told(const StudyPlan& plan, const Fitted& fitted);

/// The numbers that decide about failure; without [failure] those of the first [ask].
const AskedNumbers& main_of(const StudyPlan& plan, const StudyResults& results);

/// Those of study.csv.
ColumnOwners columns_of(const StudyPlan& plan);
/// A row a sample: its values, its answers, whether it failed, and why there is no answer.
std::string study_csv(const StudyPlan& plan, const StudyResults& results);
std::string study_summary(const StudyPlan& plan, const StudyResults& results);

/// Those that failed by most, or came nearest to it; of a study without [failure] the smallest of
/// the first answer.
std::vector<std::size_t> worst_samples(const StudyPlan& plan, const StudyResults& results,
                                       std::size_t count);

}  // namespace edda
