// The driver's way from stage to stage.
#include <fmt/format.h>

#include "run/driver.hpp"

namespace edda {

void Driver::begin_stage(std::size_t index) {
  stage_ = index;
  stage_start_ = sim_.state.time;
  stage_steps_ = sim_.state.steps;
  calm_ = 0;
  const Stage& stage = stages_[index];
  times_.end_at(stage_start_ + stage.duration);
  if (sim_.model.stages.empty()) return;
  const bool settles = stage.until == StageEnd::equilibrium;
  sim_.change_damping(stage.damping, sim_.model.solver.dynamic && !settles);
  sim_.set_strength_factor(stage.strength_factor);
  if (stage.reset_displacements) sim_.reset_displacements();
}

bool Driver::is_at_rest() {
  constexpr std::uint64_t look = 64;   // steps between looks
  constexpr std::uint64_t enough = 4;  // looks: forces may vanish for a moment while all moves
  const Stage& stage = stages_[stage_];
  const std::uint64_t every = sim_.explicit_method() ? look : 1;
  if (stage.until != StageEnd::equilibrium || sim_.state.steps % every != 0) return false;
  const Balance balance = balance_of(sim_);
  const bool calm = balance.resting > 0 && balance.mean <= stage.ratio;
  calm_ = calm ? calm_ + 1 : 0;
  return calm_ >= enough;
}

void Driver::rest_before(Event& event) {
  times_.put_back(event);
  event = {sim_.state.time, true, true, true, false, false};
}

bool Driver::end_stage(bool at_rest) {
  const Stage& stage = stages_[stage_];
  const bool reached = at_rest || stage.until == StageEnd::time;
  if (!sim_.model.stages.empty()) {
    ends_.push_back(stage_record(sim_, outcome_.ledger, stage_start_, stage_steps_, reached));
    if (ended_by(recorder_.stages(stages_csv(sim_.model, ends_)))) return false;
  }
  const std::string label = stage_label(sim_.model, stage_);
  if (!reached) {
    end(Status::collapsed,
        fmt::format("{} found no equilibrium in {:.6g} s: {}; give it a longer duration, more "
                    "damping, or see what gives way",
                    label, stage.duration, still_moving(sim_, ends_.back().balance)));
    return false;
  }
  if (stage_ + 1 == stages_.size()) {
    if (at_rest) {
      end(Status::equilibrium,
          fmt::format("at rest after {:.6g} s", sim_.state.time - stage_start_));
    } else {
      end(Status::completed, "the run has reached its duration");
    }
    return false;
  }
  begin_stage(stage_ + 1);
  return true;
}

}  // namespace edda
