// Runs a model from t = 0 to its duration: rows, frames, progress, checks, results folder.
#pragma once

#include <atomic>
#include <functional>
#include <string>
#include <vector>

#include "model/read_model.hpp"
#include "observe/gauges.hpp"
#include "observe/outcome.hpp"
#include "step/simulation.hpp"

namespace edda {

struct Progress {
  double fraction = 0.0;  ///< of the duration
  double time = 0.0;      ///< s simulated
  std::uint64_t steps = 0;
  double rate = 0.0;              ///< steps per second of wall time, recent average
  double seconds_left = 0.0;      ///< of wall time, at most where stages may end early; -1 while
                                  ///< unknown
  double kinetic = 0.0;           ///< J
  double largest_overlap = 0.0;   ///< m, of contacts that carry load
  double largest_velocity = 0.0;  ///< m/s, of the blocks' centroids
  bool at_most =
      false;  ///< seconds_left: this stage or a later one may end earlier, at an equilibrium
  std::size_t stage = 0;     ///< present stage, from 0
  std::size_t stages = 1;    ///< of the model; 1 where it has none
  std::string stage_name{};  ///< empty where it has none
  std::string ramp_at{};     ///< "kh = 0.31" in a stage with a ramp
};

/// Report of the end of a stage.
struct StageReport {
  std::size_t stage = 0;  ///< from 0
  std::string name;
  bool reached = true;            ///< its end; false: no equilibrium within its duration
  double start = 0.0, end = 0.0;  ///< s
  std::uint64_t steps = 0;        ///< steps made in it
  double ratio = 0.0;             ///< mean ratio of unbalanced forces at its end
  std::string ramp{};  ///< of a stage with a ramp: between which values it fails, or that
                       ///< it does not
};

struct RunOptions {
  std::string folder;                              ///< for results; empty: nothing is written
  std::function<void(const Progress&)> progress;   ///< may be empty
  double progress_every = 0.2;                     ///< s of wall time
  bool resume = false;                             ///< continue from the checkpoint in the folder
  std::optional<std::size_t> from_stage{};         ///< continue from the end of this stage instead
  std::function<void(const std::string&)> warn{};  ///< for warnings that do not end the run; may be
                                                   ///< empty
  std::optional<std::size_t> last_stage{};         ///< the run ends after this stage
  const std::atomic<bool>* stop = nullptr;  ///< set from any thread: the run ends as interrupted
  std::function<bool()> after_step{};       ///< true: Driver::go_on() returns; may be empty
  std::function<void(const StageReport&)> stage_ended{};  ///< may be empty
  /// Factor of safety of the blocks as rigid ones, asked at the end of a stage until equilibrium
  /// that ends the run; may be empty.
  std::function<std::optional<double>(const Simulation&)> rigid_factor{};
};

/// A run ready to start. Of its polygons only the report of the cut remains.
struct PreparedRun {
  Simulation sim;
  Gauges gauges;
  std::string governed_by;            ///< what governs the step
  std::vector<std::string> warnings;  ///< guard rails
  double cut_seconds = 0.0;           ///< s, wall time of cutting and building
  std::size_t on_nothing = 0;  ///< number of blocks without support at the start (resting.hpp)
};

/// Cuts, builds and checks. Faults: geometry, monitors and convergence lines outside every block, a
/// time_step above the critical step (unless allow_unstable), too much mass scaling, and a missing
/// duration, unless the model is only checked.
Result<PreparedRun> prepare_run(Model model, BlockOrder order = BlockOrder::as_cut,
                                ReadFor what_for = ReadFor::run);

/// Runs to the end. Faults only where the folder cannot be used; later problems are reported in the
/// Outcome, and what has been computed is kept.
Result<Outcome> run_model(PreparedRun& run, const RunOptions& options);

}  // namespace edda
