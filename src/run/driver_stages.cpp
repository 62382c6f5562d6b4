// Stages in the driver.
#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <utility>
#include <vector>

#include "base/text.hpp"
#include "contacts/face_reading.hpp"
#include "run/driver.hpp"
#include "step/faces_now.hpp"
#include "step/labels.hpp"

namespace edda {

void Driver::begin_stage(std::size_t index) {
  stage_ = index;
  stage_start_ = sim_.motion.state.time;
  stage_steps_ = sim_.motion.state.steps;
  seek_equilibrium(sim_, stage());
  ramp_ = {};
  ramp_.since = stage_steps_;
  stage_longest_ = stage().longest();
  times_.end_at(stage_start_ + stage_longest_);
  if (!sim_.scene->model.stages.empty()) {
    if (const auto fault = enter_stage(sim_, plans_[index], index == 0)) {
      end(Status::failed, stage_label(sim_.scene->model, stage_) + ": " + fault->problem);
    }
    stage_longest_ = longest_of_stage();
    times_.end_at(stage_start_ + stage_longest_);
  }
  judge_ = Judge(sim_);  // with what the stage has installed where it is now
}

/// A search for equilibrium has its own time: where masses are scaled, steps alone tell its length.
double Driver::longest_of_stage() const {
  const double longest = stage().longest();
  return stage().may_last ? std::max(longest, most_steps * sim_.control.limit) : longest;
}

double Driver::latest_end_of_stage() const {
  return stage_start_ + std::max(stage_longest_, stage().longest());
}

double Driver::latest_end() const {
  double end = latest_end_of_stage();
  for (std::size_t q = stage_ + 1; q < plans_.size(); ++q) end += plans_[q].stage.longest();
  return end;
}

bool Driver::may_end_before() const {
  return std::any_of(plans_.begin() + static_cast<std::ptrdiff_t>(stage_), plans_.end(),
                     [](const StagePlan& plan) { return plan.stage.to_equilibrium(); });
}

Driver::Equilibrium Driver::look_for_equilibrium() {
  const Stage& now = stage();
  if (!now.to_equilibrium()) return Equilibrium::not_yet;
  if (ramp_.search) {
    const Verdict verdict = look_at_increment(ramp_, sim_, now);
    return verdict == Verdict::not_yet ? Equilibrium::not_yet
           : verdict == Verdict::holds ? Equilibrium::found
                                       : Equilibrium::never;
  }
  if (!judge_.look(sim_) || !gradual_change_complete(sim_)) return Equilibrium::not_yet;
  const bool waits = now.falling == FallingBlocks::wait;
  if (!waits && judge_.all_left(sim_)) return Equilibrium::never;
  const bool found = waits ? judge_.all_at_rest() : judge_.in_equilibrium();
  const bool balanced = found && (balance_of(sim_).mean <= now.ratio || forces_are_rounding(sim_));
  return balanced ? Equilibrium::found : Equilibrium::not_yet;
}

Event Driver::search_event() const {
  constexpr std::uint64_t first = 64, rows = 32, rows_a_frame = 8;
  const std::uint64_t n = sim_.motion.state.steps - stage_steps_;
  std::uint64_t interval = first;
  for (std::uint64_t end = rows * first; n > end; end += rows * interval) interval *= 2;
  const bool seeks_equilibrium =
      sim_.scene->model.output.settling && stage().to_equilibrium() && !ramp_.search;
  Event e;
  e.time = sim_.motion.state.time;
  e.row = seeks_equilibrium && n % interval == 0;
  e.frame = e.row && n % (rows_a_frame * interval) == 0;
  return e;
}

void Driver::end_stage_before(Event& event) {
  if (event.time > sim_.motion.state.time) times_.put_back(event);
  event = {sim_.motion.state.time, true, true, true, false, false};
}

bool Driver::end_stage(Arrival went) {
  const Stage& now = stage();
  const bool at_rest = went == Arrival::at_rest;
  const bool failed = went == Arrival::no_equilibrium && ramp_.search;  // of a ramp
  const bool reached =
      now.until == StageEnd::collapse ? failed : at_rest || now.until == StageEnd::time;
  if (now.ramp && went != Arrival::there) {
    end_increment(at_rest);
    if (ended_by(write_curve())) return false;
  }
  if (!sim_.scene->model.stages.empty()) {
    ends_.push_back(stage_record(sim_, outcome_.energy, stage_start_, stage_steps_, reached));
    for (const ConvergenceLine& line : run_.gauges.convergences) {
      ends_.back().convergences.push_back(convergence(sim_.scene->blocks, sim_.motion.state, line));
    }
    if (options_.stage_ended) options_.stage_ended(report_of_stage());
    if (ended_by(recorder_.stages(stages_csv(sim_.scene->model, ends_)))) return false;
    save_stage();
  }
  if (now.to_equilibrium() && now.falling != FallingBlocks::wait)
    outcome_.loose = std::max(outcome_.loose, loose_blocks(sim_).size());
  const bool last = stage_ + 1 == plans_.size() || options_.last_stage == stage_;
  if (went == Arrival::there && !reached) return end_without_equilibrium(last);
  const bool stops = at_rest && now.otherwise == LooseBlocks::stop;
  const std::string loose = stops || last || failed ? not_in_equilibrium() : std::string();
  // The first that applies ends the run.
  const struct {
    bool applies;
    Status status;
    std::function<std::string()> message;
  } endings[] = {
      {failed && !reached, Status::collapsed, [&] { return end_of_ramp(false) + loose; }},
      {went == Arrival::no_equilibrium && !reached, Status::collapsed, [&] { return all_left(); }},
      {stops && !loose.empty(), Status::collapsed, [&] { return stopped_by(loose); }},
      {last && now.ramp, at_rest ? Status::equilibrium : Status::completed,
       [&] { return end_of_ramp(at_rest) + loose; }},
      {last && at_rest, Status::equilibrium, [&] { return equilibrium_of_stage() + loose; }},
      {last, Status::completed,
       [&] { return "the run has reached its duration, " + motion_at_end(); }}};
  for (const auto& ending : endings) {
    if (!ending.applies) continue;
    end(ending.status, ending.message());
    return false;
  }
  return true;
}

std::string Driver::all_left() const {
  return fmt::format(
      "{} does not reach equilibrium: each block slides or falls, and has left its place: {}",
      stage_label(sim_.scene->model, stage_), still_moving(sim_, ends_.back().balance));
}

bool Driver::end_without_equilibrium(bool last) {
  const Stage& now = stage();
  ++outcome_.unsettled;
  const std::string text =
      fmt::format("{} is not in equilibrium after {:.6g} s, the longest that it may last{}: {}{}",
                  stage_label(sim_.scene->model, stage_), stage_longest_,
                  now.ramp ? ", at " + ramp_at(ramp_.increment) : "",
                  still_moving(sim_, ends_.back().balance), not_in_equilibrium());
  const bool stops = now.otherwise == LooseBlocks::stop;
  if (last || now.ramp || stops) {
    end(stops ? Status::collapsed : Status::completed, text);
    return false;
  }
  if (options_.warn) options_.warn(text + "; the run goes on");
  return true;
}

std::string Driver::equilibrium_of_stage() const {
  const double time = sim_.motion.state.time;
  return stage_ == 0
             ? fmt::format("the model is in equilibrium after {:.6g} s", time)
             : fmt::format(
                   "the model is in equilibrium at {:.6g} s, {:.6g} s after the start of {}", time,
                   time - stage_start_, stage_label(sim_.scene->model, stage_));
}

std::string Driver::stopped_by(const std::string& loose) const {
  return fmt::format("{}{}; otherwise = \"stop\" of {} ends the run here", equilibrium_of_stage(),
                     loose, stage_label(sim_.scene->model, stage_));
}

/// Blocks that are not in equilibrium at the end of the stage, beginning with a comma; else empty.
std::string Driver::not_in_equilibrium() const {
  return stage().falling == FallingBlocks::wait ? std::string() : judge_.left_text(sim_);
}

std::string Driver::motion_at_end() const {
  if (outcome_.fastest == no_id) return "no block is free to move";
  if (outcome_.at_rest) return "in equilibrium";
  return fmt::format("still moving: fastest is {}, at {:.3g} m/s",
                     block_label(sim_.scene->blocks, outcome_.fastest), outcome_.speed);
}

StageReport Driver::report_of_stage() const {
  const StageRecord& r = ends_.back();
  const bool ramped = stage().ramp && ramp_.search && !curve_.empty() &&
                      curve_.back().value == ramp_value(*stage().ramp, ramp_.increment);
  return {stage_,         stage().name,
          r.reached,      r.start,
          r.end,          r.steps,
          r.balance.mean, ramped ? end_of_ramp(curve_.back().holds) : std::string{}};
}

bool Driver::begin_next_stage() {
  if (stage_ + 1 == plans_.size()) {
    end(Status::completed, "all stages of the model have ended already");
    return false;
  }
  begin_stage(stage_ + 1);
  event_ = times_.next();
  fit_step_to(sim_, event_.time);
  recorder_.begin_stage(sim_, look(), run_.gauges);
  return !over_;
}

void Driver::measure_overlaps() {
  const DeepestNow deepest = deepest_now(sim_, outcome_.overlap.ratio);
  if (!(deepest.ratio > 0.0)) return;
  const FaceSet& f = sim_.motion.contacts;
  outcome_.overlap = {deepest.ratio,
                      deepest.depth,
                      deepest.place + sim_.scene->blocks.origin,
                      block_of_facing(sim_.scene->blocks, f, deepest.face),
                      block_of_edge(sim_.scene->blocks, f, deepest.face),
                      sim_.motion.state.time};
}

}  // namespace edda
