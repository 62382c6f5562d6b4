// The end of a run, and the progress reports of the driver.
#include <algorithm>
#include <cmath>

#include "observe/summary.hpp"
#include "run/driver.hpp"
#include "run/wall_clock.hpp"
#include "step/contact_pairs.hpp"

namespace edda {
namespace {

bool all_finite(const Simulation& sim) {
  const State& s = sim.motion.state;
  for (std::size_t i = 0; i < sim.scene->blocks.size(); ++i) {
    if (!is_finite(sim.scene->blocks, s.position, i) ||
        !is_finite(sim.scene->blocks, s.velocity, i))
      return false;
  }
  return true;
}

}  // namespace

void Driver::write_end() {
  const auto start = Clock::now();
  outcome_.time = sim_.motion.state.time;
  outcome_.steps = sim_.motion.state.steps;
  const bool begun = last_row_.has_value();
  if (begun && all_finite(sim_) && !disk_trouble_) {
    Event event{sim_.motion.state.time, last_row_ != sim_.motion.state.time,
                last_frame_ != sim_.motion.state.time, true};
    const double wall = outcome_.wall.output;
    if (event.row || event.frame) record(event);
    outcome_.wall.output = wall;
  }
  if (begun && all_finite(sim_)) outcome_.overlap_now = deepest_now(sim_, 0.0).ratio;
  outcome_.ramps = ramp_outcomes(sim_.scene->model, curve_);
  outcome_.contacts = blocks_in_contact(sim_, Nearness::closed).size();
  if (const Trouble trouble = disk_trouble_ ? Trouble{} : write_curve()) ended_by(trouble);
  if (begun && recorder_.writes()) {
    count_revolutions(sim_, angle_);
    recorder_.finish_frame();  // its trouble comes back with the tables
    const Picture picture = picture_of(sim_, look());
    forget_instant();
    const Trouble trouble = recorder_.tables(sim_, picture);
    if (trouble && !disk_trouble_) {
      outcome_.status = Status::failed;
      outcome_.message = to_string(*trouble);
    }
  }
  outcome_.wall.output += since(start);
  const std::vector<Stage>& stages = sim_.scene->model.stages;
  const bool may_ask = options_.stop == nullptr || !*options_.stop;
  if (options_.rigid_factor && may_ask && outcome_.status == Status::equilibrium &&
      outcome_.loose == 0 && !stages.empty() && stages.back().until == StageEnd::equilibrium)
    outcome_.rigid_factor = options_.rigid_factor(sim_);
  outcome_.wall.cut = run_.cut_seconds;
  scale_wall_times();
  outcome_.wall.total = wall_before_ + since(started_) + run_.cut_seconds;
  for (const Check& c : checks_of(sim_, outcome_)) {
    if (c.pass) continue;
    outcome_.failed_checks.push_back(message_of(c, sim_, outcome_));
  }
  const Trouble trouble = recorder_.summary(sim_, outcome_, run_.governed_by);
  if (trouble && !disk_trouble_) {  // otherwise the message is that of the first file that could
                                    // not be written
    outcome_.status = Status::failed;
    outcome_.message = to_string(*trouble);
  }
  if (options_.progress) report(true);
}

void Driver::scale_wall_times() {
  WallSeconds& w = outcome_.wall;
  const StepSeconds& sampled = sim_.accounts.seconds;
  const double scale = sampled.sum() > 0.0 ? w.stepping / sampled.sum() : 0.0;
  w.search = scale * sampled.search;
  w.forces = scale * sampled.forces;
  w.integrate = scale * sampled.integrate;
}

void Driver::report(bool last) {
  const double seconds = since(reported_);
  if (seconds > 0.0 && sim_.motion.state.steps > reported_steps_) {
    const double rate = static_cast<double>(sim_.motion.state.steps - reported_steps_) / seconds;
    rate_ = rate_ == 0.0 ? rate : 0.7 * rate_ + 0.3 * rate;
  }
  reported_ = Clock::now();
  reported_steps_ = sim_.motion.state.steps;
  Progress p;
  p.time = sim_.motion.state.time;
  const double end = latest_end(), later = end - latest_end_of_stage();
  double gone = sim_.motion.state.time;
  double left = std::max(end - gone, 0.0) / sim_.motion.state.step;
  if (stage().ramp) p.ramp_at = ramp_at(ramp_.increment);
  if (ramp_.increment > 0) {  // increments are a better measure than the longest duration
    const double part = static_cast<double>(ramp_.increment) / stage().ramp->steps;
    gone = stage_start_ + part * stage().longest();
    left = static_cast<double>(sim_.motion.state.steps - stage_steps_) * (1.0 / part - 1.0) +
           later / sim_.motion.state.step;
  }
  p.fraction = gone / end;
  // A stage until equilibrium may end before its longest duration.
  const bool arrived =
      outcome_.status == Status::completed || outcome_.status == Status::equilibrium;
  if (last && arrived) p.fraction = 1.0;
  p.steps = sim_.motion.state.steps;
  p.rate = rate_;
  p.seconds_left = last ? 0.0 : rate_ > 0.0 ? left / rate_ : -1.0;
  for (std::size_t i = 0; i < sim_.scene->blocks.size(); ++i) {
    if (sim_.scene->blocks.fixed[i] || !sim_.motion.state.alive[i]) continue;
    p.kinetic +=
        kinetic_energy(sim_.motion.masses, sim_.scene->blocks, sim_.motion.state.velocity, i);
    p.largest_velocity =
        std::max(p.largest_velocity, norm(centroid(sim_.motion.state.velocity, i)));
  }
  p.largest_overlap = sim_.accounts.penetration;
  p.at_most = may_end_before();
  p.stage = stage_;
  p.stages = plans_.size();
  if (!sim_.scene->model.stages.empty()) p.stage_name = stage().name;
  options_.progress(p);
}

}  // namespace edda
