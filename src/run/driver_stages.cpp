// The driver's way from stage to stage.
#include <fmt/format.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "base/text.hpp"
#include "contacts/face_reading.hpp"
#include "run/driver.hpp"
#include "run/labels.hpp"

namespace edda {

void Driver::begin_stage(std::size_t index) {
  stage_ = index;
  stage_start_ = sim_.state.time;
  stage_steps_ = sim_.state.steps;
  const Stage& stage = stages_[index];
  begin_settling(settling_, sim_, stage);
  times_.end_at(stage_start_ + stage.duration);
  if (sim_.model.stages.empty()) return;
  const bool glued = stage.joints == StageJoints::glued;
  if (!glued) sim_.glue_joints(false);
  take_out(stage);
  NamedRows off = rows_called(sim_.model, stage.deactivate);
  NamedRows on = rows_called(sim_.model, stage.activate);
  std::vector<Index> bolts = bolts_called(sim_.model, stage.install);
  if (index > 0) {  // a change from outside may have done some of it before
    off = rows_that(true, sim_.loads.spells, off);
    on = rows_that(false, sim_.loads.spells, on);
    std::erase_if(bolts, [&](Index row) { return is_installed(sim_.bolts, row); });
  }
  sim_.switch_over(off, on);
  if (!bolts.empty()) {
    if (const auto fault = sim_.install(bolts)) {
      return end(Status::failed, stage_label(sim_.model, stage_) + ": " + fault->problem);
    }
  }
  sim_.glue_joints(glued);
  sim_.scale_masses(stage.masses);
  const bool settles = stage.until == StageEnd::equilibrium;
  sim_.change_damping(stage.damping, sim_.model.solver.dynamic && !settles);
  const std::vector<double> strength(sim_.laws.rows.size(), stage.strength_factor);
  if (settles && stage.damping.adaptive > 0.0) {
    sim_.begin_gently(strength);
  } else {
    sim_.set_strength_factors(strength);
  }
  if (stage.reset_displacements) sim_.reset_displacements();
}

/// Openings of the stage, and what they let go.
void Driver::take_out(const Stage& stage) {
  const std::vector<Opening>& all = sim_.model.openings;
  const auto row_of = [&](const std::string& name) {
    const auto found =
        std::find_if(all.begin(), all.end(), [&](const Opening& o) { return o.name == name; });
    return static_cast<Index>(found - all.begin());
  };
  // Where a change from outside has let go more than the stage would, it stays so.
  const auto let_go = [&](Index row) {
    const double part = sim_.loads.held[static_cast<std::size_t>(row)].part;
    return is_taken_out(sim_, row) ? 1.0 - part : 0.0;
  };
  std::vector<std::pair<Index, double>> relaxed;
  for (const auto& [name, part] : stage.relax) {
    const Index row = row_of(name);
    if (part >= let_go(row)) relaxed.emplace_back(row, part);
  }
  std::vector<Index> out;
  for (const std::string& name : stage.excavate) out.push_back(row_of(name));
  if (!out.empty()) sim_.excavate(out);
  for (const auto& [row, part] : relaxed) sim_.relax(row, part);
}

Rest Driver::look_for_rest() {
  const Stage& stage = stages_[stage_];
  if (stage.until != StageEnd::equilibrium) return Rest::not_yet;
  return edda::look_for_rest(settling_, sim_, stage);
}

Event Driver::settling_event() const {
  constexpr std::uint64_t first = 64, rows = 32, rows_a_frame = 8;
  const std::uint64_t n = sim_.state.steps - stage_steps_;
  std::uint64_t interval = first;
  for (std::uint64_t end = rows * first; n > end; end += rows * interval) interval *= 2;
  const bool settles = sim_.model.output.settling && stages_[stage_].until == StageEnd::equilibrium;
  Event e;
  e.time = sim_.state.time;
  e.row = settles && n % interval == 0;
  e.frame = e.row && n % (rows_a_frame * interval) == 0;
  return e;
}

void Driver::rest_before(Event& event) {
  if (event.time > sim_.state.time) times_.put_back(event);
  event = {sim_.state.time, true, true, true, false, false};
}

bool Driver::end_stage(Went went) {
  const Stage& stage = stages_[stage_];
  const bool at_rest = went == Went::at_rest;
  const bool reached = at_rest || stage.until == StageEnd::time;
  if (!sim_.model.stages.empty()) {
    ends_.push_back(stage_record(sim_, outcome_.ledger, stage_start_, stage_steps_, reached));
    for (const ConvergenceLine& line : run_.convergences) {
      ends_.back().convergences.push_back(convergence(sim_.state, line));
    }
    if (options_.stage_ended) options_.stage_ended(report_of_stage());
    if (ended_by(recorder_.stages(stages_csv(sim_.model, ends_)))) return false;
    save_stage();
  }
  if (stage.until == StageEnd::equilibrium)
    outcome_.loose = std::max(outcome_.loose, loose_ones(sim_).size());
  const std::string label = stage_label(sim_.model, stage_);
  if (went == Went::nowhere) {
    end(Status::collapsed,
        fmt::format("{} finds no equilibrium: each block slides or falls, and has "
                    "gone further than its own size: {}",
                    label, still_moving(sim_, ends_.back().balance)));
    return false;
  }
  if (!reached) {
    end(Status::collapsed,
        fmt::format("{} found no equilibrium in {:.6g} s: {}; give it a longer duration, more "
                    "damping, or see what gives way",
                    label, stage.duration, still_moving(sim_, ends_.back().balance)));
    return false;
  }
  if (at_rest && stage.otherwise == LooseBlocks::stop) {
    if (const std::string loose = not_at_rest(); !loose.empty()) {
      end(Status::collapsed, fmt::format("{}{}; otherwise = \"stop\" of {} ends the run here",
                                         rest_of_stage(), loose, label));
      return false;
    }
  }
  if (stage_ + 1 == stages_.size() || options_.last_stage == stage_) {
    if (at_rest) {
      end(Status::equilibrium, rest_of_stage() + not_at_rest());
    } else {
      end(Status::completed, "the run has reached its duration, " + motion_at_end());
    }
    return false;
  }
  return true;
}

std::string Driver::rest_of_stage() const {
  const double time = sim_.state.time;
  return stage_ == 0 ? fmt::format("at rest after {:.6g} s", time)
                     : fmt::format("at rest at {:.6g} s, {:.6g} s after the start of {}", time,
                                   time - stage_start_, stage_label(sim_.model, stage_));
}

/// What a stage that has come to rest leaves out, beginning with a comma; else empty.
std::string Driver::not_at_rest() const {
  const std::string loose = loose_blocks(settling_, sim_);
  const std::string apart = loose.empty() ? "" : ", but for what has come loose: " + loose;
  const std::size_t falling = balance_of(sim_).detached;
  if (falling == 0) return apart;
  return fmt::format("{}, {} for {} that {} freely: fastest is {}, at {:.3g} m/s", apart,
                     loose.empty() ? "but" : "and", counted(falling, "block"),
                     falling == 1 ? "falls" : "fall", block_label(sim_.blocks, outcome_.fastest),
                     outcome_.speed);
}

std::string Driver::motion_at_end() const {
  if (outcome_.fastest == no_id) return "no block is free to move";
  if (outcome_.at_rest) return "at rest";
  return fmt::format("still moving: fastest is {}, at {:.3g} m/s",
                     block_label(sim_.blocks, outcome_.fastest), outcome_.speed);
}

StageReport Driver::report_of_stage() const {
  const StageRecord& r = ends_.back();
  return {stage_, stages_[stage_].name, r.reached, r.start, r.end, r.steps, r.balance.mean};
}

bool Driver::begin_next_stage() {
  if (stage_ + 1 == stages_.size()) {
    end(Status::completed, "all stages of the model have ended before");
    return false;
  }
  begin_stage(stage_ + 1);
  event_ = times_.next();
  sim_.aim_at(event_.time);
  return !over_;
}

void Driver::measure_overlaps() {
  const FaceSet& f = sim_.contacts;
  const DeepestFace deepest = deepest_face(f, sim_.blocks);
  outcome_.overlap_now = deepest.ratio;
  if (!(deepest.ratio > outcome_.overlap.ratio)) return;
  outcome_.overlap = {deepest.ratio,
                      closure_of(f, deepest.face),
                      deeper_end(f, sim_.pose, deepest.face) + sim_.blocks.origin,
                      block_of_facing(sim_.blocks, f, deepest.face),
                      block_of_edge(sim_.blocks, f, deepest.face),
                      sim_.state.time};
}

}  // namespace edda
