// The loop over the steps of a run, with everything that happens between them.
#pragma once

#include <chrono>
#include <optional>
#include <string>
#include <vector>

#include "base/threads.hpp"
#include "checkpoint/record.hpp"
#include "run/event_times.hpp"
#include "run/recorder.hpp"
#include "run/run_model.hpp"
#include "run/settling.hpp"
#include "run/stages.hpp"

namespace edda {

class Driver {
 public:
  Driver(PreparedRun& run, const RunOptions& options);
  Outcome run();
  // run() in parts, for a caller that looks on and steps in between.
  /// Opens the folder, begins the first stage and writes the first row. Of a run taken up at the
  /// end of a stage, begins the next; else nothing.
  void begin();
  /// Steps until the run is over, or until RunOptions::after_step asks for a pause. After begin().
  void go_on();
  bool over() const { return over_; }
  /// Writes what comes at the end. A run that is not over ends here, as interrupted.
  Outcome finish();
  /// Fits the step to the event ahead again: the simulation was changed between two steps.
  void aim_again();
  /// Brings State::turns up to date, for one who looks between two steps.
  void count_turns_now() { count_turns(sim_, angle_); }
  std::size_t stage() const { return stage_; }
  /// Takes up the run that `record` was written of; before run(). Returns what is wrong with the
  /// record or the folder.
  Trouble take_up(const Record& record);

 private:
  using Clock = std::chrono::steady_clock;

  void enter_first_stage();
  /// Steps from event to event, the first of them `event_`.
  void follow_events();
  /// Runs `part`; without memory for it, the run ends.
  template <class Part>
  void within_memory(Part part);
  /// Wall time stops, until go_on() or finish().
  void pause();
  void stop_early();
  void write_checkpoint_if_due();
  void save_checkpoint();
  /// Of the end of the stage in hand, and its contacts.
  void save_stage();
  Record memory(std::size_t stages);
  /// Names every field of its own that a checkpoint holds (run/driver_memory.cpp).
  template <class Archive>
  void list(Archive& archive);
  template <class Archive>
  void list_stages(Archive& archive);
  enum class Went { there, at_rest, nowhere, paused, over };
  /// Steps to the event, or until the stage has found its equilibrium. Over: outcome_ says why.
  Went step_to(double time);
  // Stages (run/driver_stages.cpp).
  void begin_stage(std::size_t index);
  void take_out(const Stage& stage);
  /// Of the stage in hand; not yet, where it does not wait for an equilibrium.
  Rest look_for_rest();
  /// The row and the frame that are due at this step of a stage until equilibrium: 32 rows 64 steps
  /// apart, 32 of twice that, and so on, a frame with every eighth. Of the steps alone, so that a
  /// resumed run has them, too.
  Event settling_event() const;
  /// The event in hand becomes one at the present time.
  void rest_before(Event& event);
  /// Writes down the end of the stage. False: the run is over.
  bool end_stage(Went went);
  /// When an equilibrium was found, and what falls all the same.
  std::string rest_of_stage() const;
  std::string not_at_rest() const;
  /// "at rest", or what still moves, and how fast.
  std::string motion_at_end() const;
  /// Of the stage that has just ended.
  StageReport report_of_stage() const;
  /// And steps towards its first event. False: the run is over.
  bool begin_next_stage();
  /// Timed, and shared among as many threads as are quickest.
  std::optional<Failure> timed_step();
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
  std::vector<Stage> stages_;
  std::size_t stage_ = 0;                ///< in hand
  double stage_start_ = 0.0;             ///< s
  std::uint64_t stage_steps_ = 0;        ///< steps before it
  Settling settling_;                    ///< of a stage until equilibrium
  std::optional<ThreadChoice> threads_;  ///< of the steps; none: somebody has said how many
  bool stage_has_ended_ = false;         ///< the next one is yet to begin
  std::vector<StageRecord> ends_;        ///< of the stages before
  EventTimes times_;
  Event event_;  ///< stepped towards
  bool resumed_ = false;
  std::vector<double> angle_;  ///< rad, of every block when turns were last counted
  bool over_ = false;
  bool pause_asked_ = false, paused_ = false;
  bool disk_trouble_ = false;
  std::optional<double> last_row_, last_frame_;  ///< s

  Clock::time_point started_, reported_, saved_, paused_at_;
  RecorderMemory files_;      ///< of the checkpoint taken up
  double wall_before_ = 0.0;  ///< s, of the runs that this one goes on from
  std::uint64_t reported_steps_ = 0;
  double rate_ = 0.0;
};

/// Takes up what the checkpoint in RunOptions::folder holds, where the options ask for that.
/// What is wrong with it or the folder; empty: nothing.
Faults take_up_folder(Driver& driver, const RunOptions& options);

/// The likely cause of a divergence, for the message.
std::string likely_cause(const Simulation& sim);

}  // namespace edda
