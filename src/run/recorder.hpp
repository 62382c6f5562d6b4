// The results folder of a run, filled as it goes.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "results/files.hpp"
#include "results/frames.hpp"
#include "run/monitors.hpp"
#include "run/outcome.hpp"
#include "run/summary.hpp"

namespace edda {

/// How far the files of a run had come.
struct RecorderMemory {
  std::uint64_t history_bytes = 0, reactions_bytes = 0, bolts_bytes = 0;
  std::vector<double> frame_times;  ///< s
  std::vector<InputFile> inputs;
};

class Recorder {
 public:
  /// With an empty folder nothing is ever written.
  explicit Recorder(std::string folder) : folder_(std::move(folder)) {}

  /// Makes or empties the folder; model.toml and the heads of the tables that
  /// grow.
  Trouble begin(const Simulation& sim, const std::vector<MonitorPoint>& monitors,
                const std::vector<ConvergenceLine>& lines);
  /// Goes on with a folder as it was when a checkpoint was written: tables that grow cut to their
  /// length then, frames that came later forgotten, model.toml that of the model now.
  Trouble resume(const Simulation& sim, const RecorderMemory& memory);
  RecorderMemory memory() const;
  /// Brings to the disk what a checkpoint relies on.
  Trouble sync();
  Trouble row(const Simulation& sim, const Instant& at, const std::vector<MonitorPoint>& monitors,
              const std::vector<ConvergenceLine>& lines, const Ledger& ledger, double unbalanced);
  Trouble frame(const Simulation& sim, const Picture& picture);
  /// stages.csv, as it is by now.
  Trouble stages(const std::string& csv);
  /// joints_`stage`.csv, the contacts at its end.
  Trouble stage_joints(std::size_t stage, const Picture& picture);
  /// blocks.csv, joints.csv, and the end of history.csv.
  Trouble tables(const Picture& picture);
  /// summary.json, last of all.
  Trouble summary(const Simulation& sim, const Outcome& outcome, const std::string& governed_by);
  bool writes() const { return !folder_.empty(); }

 private:
  std::string path(const char* name) const { return folder_ + "/" + name; }
  Trouble tell_model(const Model& model);
  std::string folder_;
  std::vector<InputFile> inputs_;  ///< as they were when they were read
  FolderLock lock_;
  RowFile history_, reactions_, bolts_;
  std::optional<FrameSeries> frames_;
};

}  // namespace edda
