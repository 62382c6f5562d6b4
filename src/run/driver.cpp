#include "run/driver.hpp"

#include <fmt/format.h>
#include <omp.h>

#include <algorithm>
#include <cmath>
#include <new>

#include "model/stage_names.hpp"
#include "observe/motion.hpp"
#include "observe/summary.hpp"
#include "run/wall_clock.hpp"
#include "step/energy_balance.hpp"
#include "step/faces_now.hpp"
#include "step/labels.hpp"
#include "step/step.hpp"
#include "step/tile_step.hpp"

namespace edda {
namespace {

/// Blocks rotate by less than pi in this many steps, since no vertex moves by more than a tenth of
/// an edge in one.
constexpr std::uint64_t revolutions_every = 8;
constexpr double largest_gain = 0.05;
// The leapfrog's own energy is conserved even with a step that is too large, while kinetic energy
// grows without bound against negative stored energy. Below the critical step the ratio stays under
// 1/(1 - (h/h_c)^2).
constexpr double kinetic_bound = 20.0;

/// The block with the most energy per mass, where spurious energy shows first.
Id most_energetic(const Simulation& sim) {
  Id best = 0;
  double most = -1.0;
  for (Id i = 0; i < sim.scene->blocks.size(); ++i) {
    if (!is_free(sim.scene->blocks, sim.motion.state, i)) continue;
    const double energy =
        kinetic_energy(sim.motion.masses, sim.scene->blocks, sim.motion.state.velocity, i) /
        sim.scene->blocks.mass[i];
    if (energy > most) {
      most = energy;
      best = i;
    }
  }
  return best;
}

/// Resultant of the forces on all free blocks, over the sum of their weights and loads: in
/// equilibrium it is 0, and boundary reactions balance weight and loads. 0 where there are none.
double reaction_error(const Simulation& sim, const Instant& at, const NormalForces& contacts) {
  Vec2 sum;
  double weight = 0.0;
  const LoadsNow acting = loads_at(sim.scene->model, sim.attached.loads, sim.motion.state.time);
  for (std::size_t i = 0; i < sim.scene->blocks.size(); ++i) {
    if (sim.scene->blocks.fixed[i] || !sim.motion.state.alive[i]) continue;
    sum += nodes_per_block * centroid(at.forces, i);
    weight += sim.scene->blocks.mass[i] * norm(sim.scene->model.gravity) +
              norm(load_on(sim.scene->blocks, acting, sim.motion.pose, i));
  }
  // Without weight, or where loads cancel, the contact forces are the only reference.
  if (weight < 1e-6 * contacts.size) weight = contacts.size;
  return weight > 0.0 ? norm(sum) / weight : 0.0;
}

}  // namespace

std::string likely_cause(const Simulation& sim) {
  const Solver& solver = sim.scene->model.solver;
  if (!is_explicit(sim)) {
    return "loads or velocities too large for the contact springs, or a time step too large: lower "
           "solver.time_step, or raise contact.normal_stiffness";
  }
  if (solver.time_step && *solver.time_step > sim.control.bound.critical_step) {
    return fmt::format("time_step {:.6g} s is above the critical step {:.6g} s", *solver.time_step,
                       sim.control.bound.critical_step);
  }
  if (sim.accounts.steps.over_critical > 1.0) {
    return fmt::format("the step was {:.3g} times the critical one: make solver.time_step smaller",
                       sim.accounts.steps.over_critical);
  }
  if (solver.switching == Switching::plain) {
    return "switching = \"plain\" creates energy at every impact: use \"exact\" or a "
           "smaller "
           "solver.safety";
  }
  if (solver.safety > 0.5 || solver.time_step) {
    return "loads or velocities too large for the contact springs, or a time step too large: lower "
           "solver.safety, raise contact.normal_stiffness, or lower solver.max_displacement_ratio";
  }
  return "loads or velocities too large for the contact springs: raise contact.normal_stiffness, "
         "or lower solver.max_displacement_ratio";
}

Driver::Driver(PreparedRun& run, const RunOptions& options)
    : run_(run),
      sim_(run.sim),
      options_(options),
      recorder_(options.folder),
      plans_(plan_stages(run.sim.scene->model)),
      times_(run.sim.scene->model.output.history_every, run.sim.scene->model.output.every) {
  outcome_.on_nothing = run.on_nothing;
}

Outcome Driver::run() {
  begin();
  go_on();
  return finish();
}

void Driver::begin() {
  started_ = reported_ = saved_ = Clock::now();
  reported_steps_ = sim_.motion.state.steps;  // of a resumed run, the steps made before
  if (!resumed_) {
    outcome_.critical_step = sim_.control.bound.critical_step;
    within_memory([&] {
      if (!ended_by(recorder_.begin(sim_, run_.gauges))) enter_first_stage();
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
  if (threads_are_given()) {
    threads_.reset();
  } else if (!threads_) {
    threads_.emplace(most_threads());
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
  // At an event the step is chosen again after it has been recorded.
  if (event_.time > sim_.motion.state.time) fit_step_to(sim_, event_.time);
}

template <class Part>
void Driver::within_memory(Part part) {
  try {
    part();
  } catch (const std::bad_alloc&) {
    lose_faces(sim_);
    end(Status::failed,
        "out of memory: close other programs, write fewer frames, or run a smaller model");
  }
}

void Driver::pause() {
  if (ended_by(recorder_.finish_frame())) return;
  wall_before_ += since(started_);
  paused_at_ = Clock::now();
  paused_ = true;
}

void Driver::stop_early() {
  if (recorder_.writes()) save_checkpoint();
  const double time = sim_.motion.state.time;
  end(Status::interrupted,
      stage().ramp ? fmt::format("stopped at {:.6g} s, at {}", time, ramp_at(ramp_.increment))
                   : fmt::format("stopped at {:.6g} s of {}{:.6g} s", time,
                                 may_end_before() ? "at most " : "", latest_end()));
}

void Driver::enter_first_stage() {
  begin_stage(0);
  if (over_) return;
  const Event first = times_.next();
  event_ = times_.next();
  start(sim_, event_.time);
  count_revolutions(sim_, angle_);
  if (!record(first)) return;
  fit_step_to(sim_, event_.time);
}

void Driver::follow_events() {
  while (true) {
    const Arrival went = step_to(event_.time);
    if (went == Arrival::over || went == Arrival::paused) return;
    if (went == Arrival::at_rest && ramp_goes_on()) {
      if (!begin_increment()) return;
      continue;
    }
    if (went != Arrival::there) end_stage_before(event_);
    if (!record(event_)) return;
    const bool next_stage = event_.end || went != Arrival::there;
    if (next_stage) {
      if (!end_stage(went) || !begin_next_stage()) return;
    } else {
      event_ = times_.next();
      fit_step_to(sim_, event_.time);
    }
    if (next_stage && recorder_.writes()) save_checkpoint();
  }
}

void Driver::write_checkpoint_if_due() {
  constexpr std::uint64_t look = 16;  // steps: reading the clock takes time
  if (!recorder_.writes() || sim_.motion.state.steps % look != 0) return;
  if (since(saved_) >= 60.0 * sim_.scene->model.output.checkpoint_every) save_checkpoint();
}

std::optional<Failure> Driver::timed_step() {
  if (threads_) omp_set_num_threads(threads_->now());
  const auto start = Clock::now();
  std::optional<Failure> failure = step(sim_);
  const double seconds = since(start);
  if (threads_) threads_->stepped(seconds);
  outcome_.wall.stepping += seconds;
  return failure;
}

Driver::Arrival Driver::step_to(double time) {
  while (sim_.motion.state.time < time) {
    if (options_.stop != nullptr && options_.stop->load(std::memory_order_relaxed)) {
      stop_early();
      return Arrival::over;
    }
    if (pause_asked_) return Arrival::paused;
    const std::optional<Failure> failure = timed_step();
    outcome_.critical_step = std::min(outcome_.critical_step, sim_.control.bound.critical_step);
    outcome_.step_over_critical = sim_.accounts.steps.over_critical;
    if (failure) {
      fail(*failure);
      return Arrival::over;
    }
    if (sim_.motion.state.steps % revolutions_every == 0) {
      count_revolutions(sim_, angle_);
      measure_overlaps();
      look_for_chatter(outcome_.chatter, sim_);
    }
    const Equilibrium rest = look_for_equilibrium();
    const bool goes_on = rest == Equilibrium::not_yet;
    if (goes_on && sim_.motion.state.time < time) {
      if (const Event event = search_event(); event.row && !record(event)) return Arrival::over;
    }
    // After the equilibrium check, which a resumed run must not miss.
    if (goes_on) write_checkpoint_if_due();
    if (options_.progress && since(reported_) >= options_.progress_every) report(false);
    if (options_.after_step && options_.after_step()) pause_asked_ = true;
    if (!goes_on) return rest == Equilibrium::found ? Arrival::at_rest : Arrival::no_equilibrium;
  }
  return Arrival::there;
}

const Instant& Driver::look() {
  observe(sim_, instant_);
  return instant_;
}

bool Driver::record(const Event& event) {
  const auto start = Clock::now();
  count_revolutions(sim_, angle_);
  measure_overlaps();
  const Instant& instant = look();
  bool fine = true;
  if (event.row) {
    const FaceMeasures faces = measure_faces(sim_);
    const NormalForces contacts = normal_forces(sim_, faces.normal);
    const EnergyBalance energy = account_energy(sim_, faces);
    outcome_.energy = energy;
    outcome_.largest_energy_error = std::max(outcome_.largest_energy_error, std::abs(energy.error));
    outcome_.largest_transfer = std::max(outcome_.largest_transfer,
                                         std::abs(energy.transfer) / sim_.accounts.largest_energy);
    outcome_.unbalanced = unbalanced_ratio(sim_, instant, contacts);
    outcome_.reaction_error = reaction_error(sim_, instant, contacts);
    look_at_motion(sim_, instant, outcome_);
    outcome_.slowed_in_fall = std::max(outcome_.slowed_in_fall, slowed_down_in_fall(sim_));
    last_row_ = sim_.motion.state.time;
    fine = !ended_by(recorder_.row(sim_, instant, run_.gauges, energy, outcome_.unbalanced));
  }
  if (fine && event.frame && recorder_.writes()) {
    last_frame_ = sim_.motion.state.time;
    fine = !ended_by(recorder_.finish_frame());
    if (fine) {
      Picture picture = picture_of(sim_, instant);
      forget_instant();
      fine = !ended_by(recorder_.frame(sim_, std::move(picture)));
    }
  }
  outcome_.wall.output += since(start);
  if (!fine || over_ || !event.row) return fine;
  return !energy_is_out_of_bounds();
}

bool Driver::energy_is_out_of_bounds() {
  const EnergyBalance& l = outcome_.energy;
  const double scale = sim_.accounts.largest_energy;
  const double created = scale > 0.0 ? -l.step_change / scale : 0.0;
  const bool runaway = l.kinetic > kinetic_bound * scale && l.kinetic > 0.0;
  // On the way to an equilibrium nothing but the equilibrium counts; the drift is checked at the
  // end.
  const bool created_much =
      !sim_.relaxation.seeks_equilibrium && std::max(l.error, created) > largest_gain;
  if (!created_much && !runaway) return false;
  Failure failure;
  failure.block = most_energetic(sim_);
  failure.place = centroid(sim_.motion.state.position, failure.block) + sim_.scene->blocks.origin;
  failure.time = sim_.motion.state.time;
  const std::string how =
      runaway ? fmt::format("the kinetic energy is {:.3g} times the largest energy so far",
                            l.kinetic / scale)
              : fmt::format("the energy balance has an error of {:.3g} %",
                            100.0 * std::max(l.error, created));
  failure.message = fmt::format("energy has been created: {}, fastest is {}: {}", how,
                                block_label(sim_.scene->blocks, failure.block), likely_cause(sim_));
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

}  // namespace edda
