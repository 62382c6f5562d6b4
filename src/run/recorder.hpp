// The results folder of a run, written during the run.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "observe/bolt_summary.hpp"
#include "observe/gauges.hpp"
#include "observe/outcome.hpp"
#include "observe/summary.hpp"
#include "results/columns.hpp"
#include "results/files.hpp"
#include "results/frames.hpp"

namespace edda {

/// Lengths of the files of a run at a checkpoint.
struct RecorderMemory {
  std::uint64_t history_bytes = 0, reactions_bytes = 0, bolts_bytes = 0, linings_bytes = 0,
                flow_bytes = 0;
  std::vector<double> frame_times;  ///< s
  std::vector<BoltPeak> bolt_peaks;
  std::vector<InputFile> inputs;
  std::vector<double> velocities;  ///< Recorder::velocities_
};

class Recorder {
 public:
  /// With an empty folder nothing is written.
  explicit Recorder(std::string folder) : folder_(std::move(folder)) {}

  /// Creates or empties the folder; writes model.toml and the headers of the tables that grow. From
  /// here on columns.csv lists the columns of the tables that are there.
  Trouble begin(const Simulation& sim, const Gauges& gauges);
  /// Restores a folder to its state at a checkpoint: tables that grow are cut to their length then,
  /// later frames are removed, and model.toml is that of the present model.
  Trouble resume(const Simulation& sim, const Gauges& gauges, const RecorderMemory& memory);
  RecorderMemory memory() const;
  /// Writes to disk everything that a checkpoint relies on.
  Trouble sync();
  Trouble row(const Simulation& sim, const Instant& at, const Gauges& gauges,
              const EnergyBalance& energy, double unbalanced);
  /// Where a stage begins, which may change velocities at once: the accelerations of the next row
  /// are means from here on.
  void begin_stage(const Simulation& sim, const Instant& at, const Gauges& gauges);
  /// Waits until the last frame is written, so that one picture at a time is in memory.
  Trouble finish_frame() { return frames_ ? frames_->finish() : Trouble{}; }
  Trouble frame(const Simulation& sim, Picture picture);
  /// stages.csv, with the stages so far.
  Trouble stages(const std::string& csv);
  /// curve.csv, with the increments of ramps so far.
  Trouble curve(const std::string& csv);
  /// joints_`stage`.csv, the contacts at the end of the stage.
  Trouble stage_joints(std::size_t stage, const Picture& picture);
  /// blocks.csv, joints.csv, bolt_summary.csv, and the end of history.csv.
  Trouble tables(const Simulation& sim, const Picture& picture);
  /// summary.json, last of all.
  Trouble summary(const Simulation& sim, const Outcome& outcome, const std::string& governed_by);
  bool writes() const { return !folder_.empty(); }

 private:
  std::string path(const char* name) const { return folder_ + "/" + name; }
  Trouble write_model_file(const Model& model);
  std::string folder_;
  std::vector<InputFile> inputs_;  ///< as they were when they were read
  ColumnOwners owners_;
  FolderLock lock_;
  /// At the last row, or at the start of the stage: the time (s), then vx and vy (m/s) of each
  /// monitor in a frame at rest.
  std::vector<double> velocities_;
  RowFile history_, reactions_, bolts_, linings_, flow_;
  std::optional<FrameSeries> frames_;
  std::vector<BoltPeak> bolt_peaks_;
};

}  // namespace edda
