// Samples of a study (edda study) by processes of one's own. It is the base of edda.study() in
// Python and not part of edda.hpp.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "library/edda.hpp"

namespace edda::api {

struct StudySample {
  std::size_t number = 0;
  std::vector<double> point;  ///< value of each [vary], in its unit
};

struct StudyAnswer {
  std::vector<std::string> cells;  ///< of each [ask], as in study.csv; then of [map]
  std::string message;             ///< why there is no answer
};

/// The answer of one sample. study: the text of study.toml in the study's folder; model: that of
/// model.toml; `scratch`: a folder for a run's results, made and removed.
StudyAnswer study_sample(const std::string& study, const std::string& model,
                         const std::vector<double>& point, const std::string& scratch);

/// A worker in the folder of a study that `edda study` leads. Raises an Error where there is none.
class StudyWorker {
 public:
  explicit StudyWorker(const std::string& folder);
  ~StudyWorker();
  StudyWorker(const StudyWorker&) = delete;
  StudyWorker& operator=(const StudyWorker&) = delete;

  const std::string& study() const;
  const std::string& model() const;
  /// The next sample, which nobody else then has; nothing where none is free now.
  std::optional<StudySample> take();
  void finish(std::size_t number, const StudyAnswer& answer);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace edda::api
