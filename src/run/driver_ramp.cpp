// Ramps in the driver.
#include <fmt/format.h>

#include <algorithm>

#include "model/stage_names.hpp"
#include "run/driver.hpp"
#include "step/labels.hpp"
#include "step/step.hpp"

namespace edda {
namespace {

/// Frames and rewritten curves of a ramp.
constexpr int pictures_of_ramp = 20;

}  // namespace

bool Driver::ramp_goes_on() const {
  return stage().ramp && ramp_.increment < stage().ramp->steps;
}

bool Driver::begin_increment() {
  const int between = std::max(1, stage().ramp->steps / pictures_of_ramp);
  Event event;
  event.time = sim_.motion.state.time;
  event.row = true;
  event.frame = ramp_.increment % between == 0;
  if (!record(event)) return false;
  end_increment(true);
  if (event.frame && ended_by(write_curve())) return false;
  if (ramp_.increment == 0 && stage().otherwise == LooseBlocks::stop) {
    if (const std::string loose = not_in_equilibrium(); !loose.empty()) {
      end(Status::collapsed, stopped_by(loose));
      return false;
    }
  }
  edda::begin_increment(ramp_, sim_, stage());
  fit_step_to(sim_, event_.time);
  return true;
}

void Driver::end_increment(bool holds) {
  CurveRow row;
  row.stage = stage_;
  row.value = ramp_value(*stage().ramp, ramp_.increment);
  row.holds = holds;
  row.time = sim_.motion.state.time;
  row.steps = sim_.motion.state.steps - ramp_.since;
  row.moved = moved_in_increment(ramp_, sim_);
  row.reason = ramp_.search ? ramp_.search->reason() : holds ? "in equilibrium" : "keeps moving";
  const Instant& at = look();
  row.force = ramped_force(sim_, at, *stage().ramp);
  for (const MonitorPoint& monitor : run_.gauges.monitors)
    row.monitors.push_back(read_monitor(sim_, at, monitor).displacement);
  curve_.push_back(std::move(row));
}

Trouble Driver::write_curve() {
  if (curve_.empty()) return {};
  return recorder_.curve(curve_csv(sim_.scene->model, curve_));
}

std::string Driver::ramp_at(int increment) const {
  const Ramp& ramp = *stage().ramp;
  const bool is_time = ramp.varied == Varied::flow || ramp.varied == Varied::time;
  return fmt::format("{} = {:.6g}{}", ramp.what.vary, ramp_value(ramp, increment),
                     is_time ? " s" : "");
}

std::string Driver::end_of_ramp(bool holds) const {
  const std::string label = stage_label(sim_.scene->model, stage_);
  if (holds) {
    const std::string end =
        fmt::format("{} is in equilibrium at {}", label, ramp_at(ramp_.increment));
    return stage().until == StageEnd::collapse
               ? end + ": it does not collapse; give the ramp a larger range"
               : end;
  }
  const Id block = ramp_.search->block();
  return fmt::format(
      "{} holds at {} and fails at {}: {} {}", label, ramp_at(ramp_.increment - 1),
      ramp_at(ramp_.increment),
      block == no_id ? std::string("the model") : block_label(sim_.scene->blocks, block),
      ramp_.search->reason());
}

}  // namespace edda
