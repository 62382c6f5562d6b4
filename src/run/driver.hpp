// The time loop of a run, with everything that happens between the steps.
#pragma once

#include <chrono>
#include <optional>
#include <string>
#include <vector>

#include "base/threads.hpp"
#include "checkpoint/image_bytes.hpp"
#include "checkpoint/record.hpp"
#include "judge/judge.hpp"
#include "run/event_times.hpp"
#include "run/ramp.hpp"
#include "run/recorder.hpp"
#include "run/run_model.hpp"
#include "run/stage_plan.hpp"
#include "run/stages.hpp"
#include "step/instant.hpp"

namespace edda {

class Driver {
 public:
  Driver(PreparedRun& run, const RunOptions& options);
  Outcome run();
  // The parts of run(), for a caller that reads or changes the simulation in between.
  /// Opens the folder, begins the first stage and writes the first row. For a run resumed at the
  /// end of a stage, begins the next one; else nothing.
  void begin();
  /// Makes steps until the run is over, or until RunOptions::after_step asks for a pause. Call
  /// begin() first.
  void go_on();
  bool over() const { return over_; }
  /// Writes the results at the end. A run that is not over ends here, as interrupted.
  Outcome finish();
  /// Chooses the step up to the next event again, after the simulation was changed between two
  /// steps.
  void aim_again();
  /// Updates State::turns, for a caller that reads it between two steps.
  void count_revolutions_now() { count_revolutions(sim_, angle_); }
  std::size_t stage_row() const { return stage_; }
  /// Restores the run of which `record` was written; call before run(). Returns what is wrong with
  /// the record or the folder.
  Trouble restore(const Record& record);

 private:
  using Clock = std::chrono::steady_clock;

  void enter_first_stage();
  /// Steps from event to event, beginning with `event_`.
  void follow_events();
  /// Runs `part`; if memory is exhausted, the run ends.
  template <class Part>
  void within_memory(Part part);
  /// Stops counting wall time until go_on() or finish().
  void pause();
  void stop_early();
  void write_checkpoint_if_due();
  void save_checkpoint();
  /// Saves the end of the present stage, and its contacts.
  void save_stage();
  /// False: the run is over.
  bool save_stage_joints();
  /// Writes what a checkpoint contains, so many stages of the model included.
  void write_memory(ImageBytes& image, std::size_t stages);
  /// Names every field of its own that a checkpoint contains (run/driver_memory.cpp).
  template <class Archive>
  void list(Archive& archive);
  template <class Archive>
  void list_stages(Archive& archive);
  enum class Arrival { there, at_rest, no_equilibrium, paused, over };
  enum class Equilibrium {
    not_yet,
    found,
    never,  ///< all free blocks have left their places
  };
  /// Steps to the event, or until the stage has reached its equilibrium. Over: outcome_ has the
  /// reason.
  Arrival step_to(double time);
  // Stages (run/driver_stages.cpp).
  void begin_stage(std::size_t index);
  double longest_of_stage() const;
  /// The time at which the stage, or the run, ends at the latest, s.
  double latest_end_of_stage() const;
  double latest_end() const;
  /// Whether a stage until equilibrium may end the run before that.
  bool may_end_before() const;
  const Stage& stage() const { return plans_[stage_].stage; }
  /// Result for the present stage; not_yet where it does not end at an equilibrium.
  Equilibrium look_for_equilibrium();
  // Ramps (run/driver_ramp.cpp).
  /// Whether the increment that has just been held is not the last one.
  bool ramp_goes_on() const;
  /// Records the increment and begins the next. False: the run is over.
  bool begin_increment();
  /// Adds a row to the curve.
  void end_increment(bool holds);
  Trouble write_curve();
  /// "kh = 0.31".
  std::string ramp_at(int increment) const;
  /// Result of a stage with a ramp that held at its last value or failed at one.
  std::string end_of_ramp(bool holds) const;
  /// The row and the frame that are due at this step of a stage until equilibrium: 32 rows 64 steps
  /// apart, then 32 of twice that, and so on, with a frame at every eighth row. Depends on the
  /// number of steps alone, so that a resumed run has the same.
  Event search_event() const;
  /// Changes the present event to one at the present time.
  void end_stage_before(Event& event);
  /// Records the end of the stage. False: the run is over.
  bool end_stage(Arrival went);
  /// The same where a stage until equilibrium has lasted as long as it may.
  bool end_without_equilibrium(bool last);
  /// When the equilibrium was reached.
  std::string equilibrium_of_stage() const;
  std::string not_in_equilibrium() const;
  /// Message where each block has left its place.
  std::string all_left() const;
  /// Message where otherwise = "stop" ends the run.
  std::string stopped_by(const std::string& loose) const;
  /// "at rest", or what still moves, and how fast.
  std::string motion_at_end() const;
  /// Report of the stage that has just ended.
  StageReport report_of_stage() const;
  /// Also chooses the step towards its first event. False: the run is over.
  bool begin_next_stage();
  /// Makes a step, measures its time and chooses the number of threads.
  std::optional<Failure> timed_step();
  /// The present instant, until it is asked for again.
  const Instant& look();
  /// Frees its memory, for what needs more.
  void forget_instant() { instant_ = {}; }
  bool record(const Event& event);
  void measure_overlaps();
  bool energy_is_out_of_bounds();
  void end(Status status, std::string message);
  void fail(const Failure& failure);
  /// Ends the run if a file could not be written. Returns whether that was so.
  bool ended_by(const Trouble& trouble);
  void write_end();
  void scale_wall_times();
  void report(bool last);

  PreparedRun& run_;
  Simulation& sim_;
  const RunOptions& options_;
  Recorder recorder_;
  Outcome outcome_;
  std::vector<StagePlan> plans_;
  std::size_t stage_ = 0;                ///< present stage
  double stage_start_ = 0.0;             ///< s
  double stage_longest_ = 0.0;           ///< s, that it may last
  std::uint64_t stage_steps_ = 0;        ///< steps made before it
  Judge judge_;                          ///< of the present stage
  RampProgress ramp_;                    ///< of the present stage, if it has a ramp
  std::vector<CurveRow> curve_;          ///< of all ramps
  std::optional<ThreadChoice> threads_;  ///< number of threads for the steps; none: it was given
  bool stage_has_ended_ = false;         ///< the next stage has yet to begin
  std::vector<StageRecord> ends_;        ///< of the stages that have ended
  EventTimes times_;
  Event event_;  ///< the next event
  bool resumed_ = false;
  Instant instant_;            ///< of look(), kept from row to row for its memory
  std::vector<double> angle_;  ///< rad, polar angle of every block when rotations were last counted
  bool over_ = false;
  bool pause_asked_ = false, paused_ = false;
  bool disk_trouble_ = false;
  std::optional<double> last_row_, last_frame_;  ///< s

  Clock::time_point started_, reported_, saved_, paused_at_;
  RecorderMemory files_;      ///< of the checkpoint that is resumed
  double wall_before_ = 0.0;  ///< s, of the runs that this one continues
  std::uint64_t reported_steps_ = 0;
  double rate_ = 0.0;
};

/// Restores the checkpoint in RunOptions::folder, where the options ask for that. Returns what is
/// wrong with it or the folder; empty: nothing.
Faults take_up_folder(Driver& driver, const RunOptions& options);

/// The likely cause of a divergence, for the message.
std::string likely_cause(const Simulation& sim);

}  // namespace edda
