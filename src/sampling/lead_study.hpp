// A study from its beginning to its end: samples issued, workers looked after, rows collected.
#pragma once

#include <atomic>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "sampling/sample_folder.hpp"

namespace edda {

struct StudyOptions {
  std::vector<std::string> worker;  ///< its command
  std::size_t jobs = 1;             ///< workers of this process; 0: others fill the folder
  bool waits = true;                ///< false: only what is done already counts
  Shard shard{};
  const std::atomic<bool>* stop = nullptr;
  /// Finished samples, and how many there are; 0: not known beforehand.
  std::function<void(std::size_t, std::size_t)> progress{};
};

/// What FORM, SORM and subset simulation find.
struct Reliability {
  double probability = 0.0;
  std::optional<double> low{}, high{};               ///< subset: its confidence interval
  std::optional<double> index{};                     ///< generalised reliability index
  std::optional<double> form{};                      ///< SORM: the probability by FORM
  std::vector<double> design_point{}, importance{};  ///< [quantities drawn]
  std::vector<std::size_t> drawn{};                  ///< rows of plan.vary
};

/// What a fit finds, in the order of plan.vary and plan.ask.
struct Fitted {
  std::vector<double> values, errors;            ///< [quantities] with their standard errors
  std::vector<std::vector<double>> correlation;  ///< [quantities][quantities] of the errors
  std::vector<double> differences;  ///< [measurements] computed less measured, over its error
  double sum_of_squares = 0.0;      ///< of these
  bool converged = false;
};

enum class StudyEnd {
  complete,
  part,  ///< this shard is complete, others are not
  interrupted,
};

struct StudyRun {
  StudyEnd end = StudyEnd::complete;
  std::size_t samples = 0;  ///< those that count, from the first on
  Points points;
  Rows rows;
  std::optional<Reliability> reliability{};
  std::optional<Fitted> fitted{};
  bool ended_early = false;  ///< sampling.half_width was reached
};

/// Whether the sample fails; nothing where it gave no answer.
std::optional<bool> has_failed(const StudyPlan& plan, const SampleAnswer& answer);
/// The number in a cell; nothing where it is a word or empty.
std::optional<double> number_in(const std::string& cell);

/// Confidence interval of a probability, by Clopper and Pearson.
struct Interval {
  double low = 0.0, high = 1.0;
  double half_width() const { return 0.5 * (high - low); }
};
Result<Interval> interval_of(std::size_t failures, std::size_t count, double confidence,
                             SamplerProcess& sampler);

/// Makes or continues the study in `folder`.
Result<StudyRun> lead_study(const StudyPlan& plan, const std::string& model_text,
                            SampleFolder& folder, const StudyOptions& options,
                            SamplerProcess& sampler);

}  // namespace edda
