// The folder of a study, which any number of processes fill.
//
//   study.toml, model.toml   the plan and the model's text, as the study began with them
//   points.csv               the values of every sample
//   free/0000017             a sample that nobody has begun
//   workers/NAME/0000017     one that the worker NAME has begun
//   workers/NAME/rows.csv    those that it has finished
//   rows.csv                 all that were finished when the study was last complete
//
// A worker takes a sample by moving it from free/ to its own folder, which succeeds for one of them
// alone, and removes it once its row is written. It holds a lock on its folder, which ends with it
// however it ends: what it had begun is then moved back.
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "base/fault.hpp"
#include "model/study/study_plan.hpp"
#include "results/files.hpp"
#include "sampling/run_sample.hpp"
#include "sampling/sample_points.hpp"

namespace edda {

/// Finished samples, by their numbers.
using Rows = std::map<std::size_t, SampleAnswer>;

/// A part of the samples: those whose number leaves `part` when divided by `parts`.
struct Shard {
  std::size_t part = 0, parts = 1;
  bool has(std::size_t sample) const { return sample % parts == part; }
};

class SampleFolder {
 public:
  explicit SampleFolder(std::string path) : path_(std::move(path)) {}
  const std::string& path() const { return path_; }
  std::string file(const std::string& name) const { return path_ + '/' + name; }

  /// Makes the folder, or joins a study that has begun in it, whose plan and model must be the
  /// same, but for more samples. Samples are issued in full, unless the method chooses them as it
  /// goes.
  Trouble open(const StudyPlan& plan, const std::string& model_text, const Shard& shard,
               SamplerProcess& sampler);
  /// For a worker, or to look at: the plan and the model as the study began.
  static Result<StudyPlan> plan_in(const std::string& path);
  Result<std::string> model_text() const { return read_file(file("model.toml")); }

  Result<Points> points(const StudyPlan& plan) const {
    return read_points(plan, file("points.csv"));
  }
  /// Adds points, whose numbers follow those that are there, and makes them free.
  Trouble issue(const StudyPlan& plan, const Points& all, std::size_t first);
  /// Makes a new folder of the finished samples of several, which are parts of one study.
  Trouble merge(const std::vector<std::string>& parts);
  /// All finished samples.
  Rows rows(const StudyPlan& plan) const;
  /// Gives back what workers that have ended had begun.
  Trouble recover() const;
  /// Takes away all samples that nobody has begun.
  void withdraw() const;
  /// Writes all rows into one file, removes what only workers need, and calls write(), while no
  /// other process does.
  Trouble tidy(const StudyPlan& plan, const std::function<Trouble()>& write) const;

  std::vector<std::size_t> free_samples() const;

 private:
  bool is_someone_elses() const;
  Trouble join(const StudyPlan& plan, const std::string& model_text, const Shard& shard,
               SamplerProcess& sampler);
  Trouble begin(const StudyPlan& plan, const std::string& model_text, const Shard& shard,
                const Points& first);
  Trouble widen(const StudyPlan& plan, const Points& points, SamplerProcess& sampler);
  void give_back() const;
  Trouble make_free(std::size_t sample) const;
  Trouble free_missing(const StudyPlan& plan, std::size_t count, const Shard& shard) const;
  std::string path_;
};

/// One process that runs samples, one after the other.
class Worker {
 public:
  /// A folder of its own, locked.
  Trouble join(const SampleFolder& folder);
  /// The next sample that is free; nothing where none is left.
  std::optional<std::size_t> take(const Shard& shard);
  /// Writes its row and ends it.
  Trouble finish(std::size_t sample, const SampleAnswer& answer);
  /// A folder for the results of a run.
  std::string scratch() const { return own_ + "/run"; }

 private:
  const SampleFolder* folder_ = nullptr;
  std::string own_;
  FolderLock lock_;
  RowFile rows_;
  std::vector<std::size_t> seen_;  ///< free samples when the folder was last read, the last first
};

/// Samples that the worker in this folder has begun.
std::vector<std::size_t> samples_begun(const std::string& own);
/// Writes a sample's row into a worker's folder that has ended, and ends it.
void end_sample(const std::string& own, std::size_t sample, const SampleAnswer& answer);

/// A row of rows.csv.
std::string row_text(std::size_t sample, const SampleAnswer& answer);

}  // namespace edda
