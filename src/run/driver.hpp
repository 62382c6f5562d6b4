// The loop over the steps of a run, with everything that happens between them.
#pragma once

#include <chrono>
#include <optional>
#include <string>
#include <vector>

#include "checkpoint/record.hpp"
#include "run/event_times.hpp"
#include "run/recorder.hpp"
#include "run/run_model.hpp"

namespace edda {

class Driver {
 public:
  Driver(PreparedRun& run, const RunOptions& options);
  Outcome run();
  /// Takes up the run that `record` was written of; before run(). Returns what is wrong with the
  /// record or the folder.
  Trouble take_up(const Record& record);

 private:
  using Clock = std::chrono::steady_clock;

  void go();
  /// Steps from event to event, the first of them `event_`.
  void go_on();
  void write_checkpoint_if_due();
  void save_checkpoint();
  /// Names every field of its own that a checkpoint holds (run/driver_memory.cpp).
  template <class Archive>
  void list(Archive& archive);
  /// Steps to the event. False: the run is over (outcome_ says why).
  bool step_to(double time);
  bool record(const Event& event);
  void measure_overlaps();
  bool energy_is_out_of_bounds();
  void end(Status status, std::string message);
  void fail(const Failure& failure);
  /// Ends the run over a file that could not be written. True if there was trouble.
  bool ended_by(const Trouble& trouble);
  void write_end();
  void share_out_time();
  void report(bool last);

  PreparedRun& run_;
  Simulation& sim_;
  const RunOptions& options_;
  Recorder recorder_;
  Outcome outcome_;
  EventTimes times_;
  Event event_;  ///< stepped towards
  bool resumed_ = false;
  Instant instant_;
  std::vector<double> angle_;  ///< rad, of every block when turns were last counted
  bool over_ = false;
  bool disk_trouble_ = false;
  std::optional<double> last_row_, last_frame_;  ///< s

  Clock::time_point started_, reported_, saved_;
  RecorderMemory files_;      ///< of the checkpoint taken up
  double wall_before_ = 0.0;  ///< s, of the runs that this one goes on from
  std::uint64_t reported_steps_ = 0;
  double rate_ = 0.0;
};

/// The likely cause of a divergence, for the message.
std::string likely_cause(const Simulation& sim);

}  // namespace edda
