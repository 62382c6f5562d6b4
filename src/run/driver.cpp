#include "run/driver.hpp"

#include <fmt/format.h>
#include <omp.h>

#include <algorithm>
#include <cmath>
#include <new>

#include "contacts/face_reading.hpp"
#include "run/labels.hpp"
#include "run/motion.hpp"
#include "run/summary.hpp"

namespace edda {
namespace {

/// Blocks turn by less than half a turn in so many steps: none moves by more than a tenth of an
/// edge in one.
constexpr std::uint64_t look_every = 8;
constexpr double largest_gain = 0.05;
// The leapfrog's own energy is kept even by a step that is too large, while kinetic energy grows
// without bound against stored energy below zero. Below the critical step the ratio stays under
// 1/(1 - (h/h_c)^2).
constexpr double kinetic_bound = 20.0;

double since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

bool all_finite(const Simulation& sim) {
  for (std::size_t k = 0; k < 3; ++k) {
    for (std::size_t i = 0; i < sim.blocks.size(); ++i) {
      if (!std::isfinite(sim.state.x[k][i] + sim.state.y[k][i] + sim.state.vx[k][i] +
                         sim.state.vy[k][i])) {
        return false;
      }
    }
  }
  return true;
}

/// The fastest block: where energy out of nothing shows first.
std::size_t fastest_block(const Simulation& sim) {
  std::size_t best = 0;
  double most = -1.0;
  for (std::size_t i = 0; i < sim.blocks.size(); ++i) {
    if (sim.blocks.fixed[i] || !sim.state.alive[i]) continue;
    const double speed =
        kinetic_energy(sim.blocks, sim.state.vx, sim.state.vy, i) / sim.blocks.mass[i];
    if (speed > most) {
      most = speed;
      best = i;
    }
  }
  return best;
}

/// Sum of boundary springs and of contacts with held blocks, plus the weight of the blocks that
/// move and the loads on them: 0 at rest. Over the size of weights and loads; 0 where there are
/// none.
double reaction_error(const Simulation& sim, const Instant& at) {
  Vec2 sum;
  double weight = 0.0;
  const LoadsNow acting = loads_at(sim.model, sim.loads, sim.state.time);
  for (std::size_t i = 0; i < sim.blocks.size(); ++i) {
    if (sim.blocks.fixed[i] || !sim.state.alive[i]) continue;
    sum += 3.0 * centroid(at.forces.x, at.forces.y, i);
    weight += sim.blocks.mass[i] * norm(sim.model.gravity) +
              norm(load_on(sim.blocks, acting, sim.pose, i));
  }
  // Without weight, or with loads that cancel, there are only contacts to measure by.
  double pressed = 0.0;
  const FaceSet& f = at.contacts;
  for (std::size_t k = 0; k < f.size(); ++k) pressed += std::abs(normal_force(f, k));
  if (weight < 1e-6 * pressed) weight = pressed;
  return weight > 0.0 ? norm(sum) / weight : 0.0;
}

}  // namespace

std::string likely_cause(const Simulation& sim) {
  const Solver& solver = sim.model.solver;
  if (!sim.explicit_method()) {
    return "loads or speeds that the contact springs cannot bear, or a step too large for them: "
           "lower solver.time_step, or raise contact.normal_stiffness";
  }
  if (solver.time_step && *solver.time_step > sim.bound.critical_step) {
    return fmt::format("time_step {:.6g} s is above the critical step {:.6g} s", *solver.time_step,
                       sim.bound.critical_step);
  }
  if (sim.steps.over_critical > 1.0) {
    return fmt::format("the step was {:.3g} times the critical one: make solver.time_step smaller",
                       sim.steps.over_critical);
  }
  if (solver.switching == Switching::plain) {
    return "switching = \"plain\" creates energy at every impact: use \"exact\" or a "
           "smaller "
           "solver.safety";
  }
  if (solver.safety > 0.5 || solver.time_step) {
    return "loads or speeds that the contact springs cannot bear, or a step too large for them: "
           "lower "
           "solver.safety, raise contact.normal_stiffness, or lower solver.max_displacement_ratio";
  }
  return "loads or speeds that the contact springs cannot bear: raise "
         "contact.normal_stiffness, or lower solver.max_displacement_ratio";
}

Driver::Driver(PreparedRun& run, const RunOptions& options)
    : run_(run),
      sim_(run.sim),
      options_(options),
      recorder_(options.folder),
      stages_(stages_of(run.sim.model)),
      times_(run.sim.model.output.history_every, run.sim.model.output.every) {
  outcome_.on_nothing = run.on_nothing;
}

Outcome Driver::run() {
  begin();
  go_on();
  return finish();
}

void Driver::begin() {
  started_ = reported_ = saved_ = Clock::now();
  reported_steps_ = sim_.state.steps;  // of a run taken up, those made before
  if (!resumed_) {
    outcome_.critical_step = sim_.bound.critical_step;
    within_memory([&] {
      if (!ended_by(recorder_.begin(sim_, run_.monitors, run_.convergences))) enter_first_stage();
    });
  } else if (stage_has_ended_) {
    stage_has_ended_ = false;
    within_memory([&] { begin_next_stage(); });
  }
  pause();
}

void Driver::go_on() {
  if (over_) return;
  const SameThreads afterwards;
  if (threads_are_said()) {
    threads_.reset();
  } else if (!threads_) {
    threads_.emplace(omp_get_num_procs());
  }
  started_ = Clock::now();
  if (paused_) reported_ += started_ - paused_at_;
  paused_ = pause_asked_ = false;
  within_memory([&] { follow_events(); });
  if (!over_) pause();
}

Outcome Driver::finish() {
  if (paused_) started_ = Clock::now();
  if (!over_) stop_early();
  write_end();
  return outcome_;
}

void Driver::aim_again() {
  // At an event itself the next aim comes once it is recorded.
  if (event_.time > sim_.state.time) sim_.aim_at(event_.time);
}

template <class Part>
void Driver::within_memory(Part part) {
  try {
    part();
  } catch (const std::bad_alloc&) {
    end(Status::failed,
        "out of memory: close other programs, write fewer frames, or run a smaller model");
  }
}

void Driver::pause() {
  wall_before_ += since(started_);
  paused_at_ = Clock::now();
  paused_ = true;
}

void Driver::stop_early() {
  if (recorder_.writes()) save_checkpoint();
  end(Status::interrupted,
      fmt::format("stopped at {:.6g} s of {:.6g} s", sim_.state.time, sim_.model.solver.duration));
}

void Driver::enter_first_stage() {
  begin_stage(0);
  if (over_) return;
  const Event first = times_.next();
  event_ = times_.next();
  sim_.start(event_.time);
  count_turns(sim_, angle_);
  if (!record(first)) return;
  sim_.aim_at(event_.time);
}

void Driver::follow_events() {
  while (true) {
    const Went went = step_to(event_.time);
    if (went == Went::over || went == Went::paused) return;
    if (went != Went::there) rest_before(event_);
    if (!record(event_)) return;
    const bool next_stage = event_.end || went != Went::there;
    if (next_stage) {
      if (!end_stage(went) || !begin_next_stage()) return;
    } else {
      event_ = times_.next();
      sim_.aim_at(event_.time);
    }
    if (next_stage && recorder_.writes()) save_checkpoint();
  }
}

void Driver::write_checkpoint_if_due() {
  constexpr std::uint64_t look = 16;  // steps: the clock is not free
  if (!recorder_.writes() || sim_.state.steps % look != 0) return;
  if (since(saved_) >= 60.0 * sim_.model.output.checkpoint_every) save_checkpoint();
}

std::optional<Failure> Driver::timed_step() {
  if (threads_) omp_set_num_threads(threads_->now());
  const auto start = Clock::now();
  std::optional<Failure> failure = sim_.step();
  const double seconds = since(start);
  if (threads_) threads_->stepped(seconds);
  outcome_.wall.stepping += seconds;
  return failure;
}

Driver::Went Driver::step_to(double time) {
  while (sim_.state.time < time) {
    if (options_.stop != nullptr && options_.stop->load(std::memory_order_relaxed)) {
      stop_early();
      return Went::over;
    }
    if (pause_asked_) return Went::paused;
    const std::optional<Failure> failure = timed_step();
    outcome_.critical_step = std::min(outcome_.critical_step, sim_.bound.critical_step);
    outcome_.step_over_critical = sim_.steps.over_critical;
    if (failure) {
      fail(*failure);
      return Went::over;
    }
    if (sim_.state.steps % look_every == 0) {
      count_turns(sim_, angle_);
      measure_overlaps();
      look_for_chatter(outcome_.chatter, sim_);
    }
    const Rest rest = look_for_rest();
    const bool goes_on = rest == Rest::not_yet;
    if (goes_on && sim_.state.time < time) {
      if (const Event event = settling_event(); event.row && !record(event)) return Went::over;
    }
    if (goes_on) write_checkpoint_if_due();  // after the look, which a resumed run must not miss
    if (options_.progress && since(reported_) >= options_.progress_every) report(false);
    if (options_.after_step && options_.after_step()) pause_asked_ = true;
    if (!goes_on) return rest == Rest::found ? Went::at_rest : Went::nowhere;
  }
  return Went::there;
}

bool Driver::record(const Event& event) {
  const auto start = Clock::now();
  count_turns(sim_, angle_);
  measure_overlaps();
  Instant instant;
  observe(sim_, instant);
  bool fine = true;
  if (event.row) {
    const Ledger ledger = sim_.ledger();
    outcome_.ledger = ledger;
    outcome_.largest_drift = std::max(outcome_.largest_drift, std::abs(ledger.drift));
    outcome_.largest_transfer =
        std::max(outcome_.largest_transfer, std::abs(ledger.transfer) / sim_.largest_energy);
    outcome_.unbalanced = unbalanced_ratio(sim_, instant);
    outcome_.reaction_error = reaction_error(sim_, instant);
    look_at_motion(sim_, instant, outcome_);
    outcome_.held_back = std::max(outcome_.held_back, held_back_in_fall(sim_));
    last_row_ = sim_.state.time;
    fine = !ended_by(recorder_.row(sim_, instant, run_.monitors, run_.convergences, ledger,
                                   outcome_.unbalanced));
  }
  if (fine && event.frame && recorder_.writes()) {
    last_frame_ = sim_.state.time;
    fine = !ended_by(recorder_.frame(sim_, picture_of(sim_, instant)));
  }
  outcome_.wall.output += since(start);
  if (!fine || over_ || !event.row) return fine;
  return !energy_is_out_of_bounds();
}

bool Driver::energy_is_out_of_bounds() {
  const Ledger& l = outcome_.ledger;
  const double scale = sim_.largest_energy;
  const double created = scale > 0.0 ? -l.step_change / scale : 0.0;
  const bool runaway = l.kinetic > kinetic_bound * scale && l.kinetic > 0.0;
  if (l.drift <= largest_gain && created <= largest_gain && !runaway) return false;
  Failure failure;
  failure.block = static_cast<Id>(fastest_block(sim_));
  failure.place = centroid(sim_.state.x, sim_.state.y, failure.block) + sim_.blocks.origin;
  failure.time = sim_.state.time;
  const std::string how =
      runaway ? fmt::format("kinetic energy is {:.3g} times all that there is", l.kinetic / scale)
              : fmt::format("the ledger has gained {:.3g} %", 100.0 * std::max(l.drift, created));
  failure.message = fmt::format("energy out of nothing: {}, fastest is {}: {}", how,
                                block_label(sim_.blocks, failure.block), likely_cause(sim_));
  fail(failure);
  return true;
}

void Driver::end(Status status, std::string message) {
  if (over_) return;
  over_ = true;
  outcome_.status = status;
  outcome_.message = std::move(message);
}

void Driver::fail(const Failure& f) {
  const std::string where = f.block == no_id ? std::string{} : " at " + place_label(f.place);
  end(Status::failed, fmt::format("diverged{}, t = {:.6g} s: {}", where, f.time, f.message));
}

bool Driver::ended_by(const Trouble& trouble) {
  if (!trouble) return false;
  disk_trouble_ = true;
  end(Status::failed, to_string(*trouble));
  return true;
}

void Driver::write_end() {
  const auto start = Clock::now();
  outcome_.time = sim_.state.time;
  outcome_.steps = sim_.state.steps;
  const bool begun = last_row_.has_value();
  if (begun && all_finite(sim_) && !disk_trouble_) {
    Event event{sim_.state.time, last_row_ != sim_.state.time, last_frame_ != sim_.state.time,
                true};
    const double wall = outcome_.wall.output;
    if (event.row || event.frame) record(event);
    outcome_.wall.output = wall;
  }
  outcome_.contacts = closed_contacts(sim_.contacts) + closed_points(sim_.point_contacts);
  if (begun && recorder_.writes()) {
    count_turns(sim_, angle_);
    Instant instant;
    observe(sim_, instant);
    const Picture picture = picture_of(sim_, instant);
    const Trouble trouble = recorder_.tables(picture);
    if (trouble && !disk_trouble_) {
      outcome_.status = Status::failed;
      outcome_.message = to_string(*trouble);
    }
  }
  outcome_.wall.output += since(start);
  outcome_.wall.cut = run_.cut_seconds;
  share_out_time();
  outcome_.wall.total = wall_before_ + since(started_) + run_.cut_seconds;
  for (const Check& c : checks_of(sim_, outcome_)) {
    if (c.pass) continue;
    outcome_.failed_checks.push_back(sentence_of(c, sim_, outcome_));
  }
  const Trouble trouble = recorder_.summary(sim_, outcome_, run_.governed_by);
  if (trouble && !disk_trouble_) {  // else the first file that could not be written says why
    outcome_.status = Status::failed;
    outcome_.message = to_string(*trouble);
  }
  if (options_.progress) report(true);
}

void Driver::share_out_time() {
  WallSeconds& w = outcome_.wall;
  const StageSeconds& sampled = sim_.seconds;
  const double scale = sampled.sum() > 0.0 ? w.stepping / sampled.sum() : 0.0;
  w.search = scale * sampled.search;
  w.forces = scale * sampled.forces;
  w.integrate = scale * sampled.integrate;
}

void Driver::report(bool last) {
  const double seconds = since(reported_);
  if (seconds > 0.0 && sim_.state.steps > reported_steps_) {
    const double rate = static_cast<double>(sim_.state.steps - reported_steps_) / seconds;
    rate_ = rate_ == 0.0 ? rate : 0.7 * rate_ + 0.3 * rate;
  }
  reported_ = Clock::now();
  reported_steps_ = sim_.state.steps;
  Progress p;
  p.time = sim_.state.time;
  // Stages before may have ended early, those to come may, too.
  double end = stage_start_ + stages_[stage_].duration;
  for (std::size_t q = stage_ + 1; q < stages_.size(); ++q) end += stages_[q].duration;
  p.fraction = sim_.state.time / end;
  // Equilibria come before their longest time.
  const bool arrived =
      outcome_.status == Status::completed || outcome_.status == Status::equilibrium;
  if (last && arrived) p.fraction = 1.0;
  p.steps = sim_.state.steps;
  p.rate = rate_;
  const double left = std::max(end - sim_.state.time, 0.0) / sim_.state.step;
  p.seconds_left = last ? 0.0 : rate_ > 0.0 ? left / rate_ : -1.0;
  for (std::size_t i = 0; i < sim_.blocks.size(); ++i) {
    if (sim_.blocks.fixed[i] || !sim_.state.alive[i]) continue;
    p.kinetic += kinetic_energy(sim_.blocks, sim_.state.vx, sim_.state.vy, i);
    p.largest_velocity =
        std::max(p.largest_velocity, norm(centroid(sim_.state.vx, sim_.state.vy, i)));
  }
  for (const double depth : sim_.contacts.deepest) {
    p.largest_overlap = std::max(p.largest_overlap, depth);
  }
  p.at_most = std::any_of(stages_.begin() + static_cast<std::ptrdiff_t>(stage_), stages_.end(),
                          [](const Stage& stage) { return stage.until == StageEnd::equilibrium; });
  p.stage = stage_;
  p.stages = stages_.size();
  if (!sim_.model.stages.empty()) p.stage_name = stages_[stage_].name;
  options_.progress(p);
}

}  // namespace edda
