#include "step/leapfrog_step.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/parallel.hpp"
#include "contacts/evaluate_face.hpp"
#include "forces/dashpot_forces.hpp"
#include "step/changes.hpp"
#include "step/contact_search.hpp"
#include "step/force_jumps.hpp"
#include "step/instant.hpp"
#include "step/law_progress.hpp"
#include "step/leapfrog_motion.hpp"
#include "step/load_work.hpp"
#include "step/simulation.hpp"
#include "step/step.hpp"
#include "step/tile_step.hpp"

namespace edda {
namespace {

/// Work of the loads in the leapfrog's terms: f_n . (x_{n+1} - x_{n-1})/2.
void account_loads(Simulation& sim, double h_old, double h_new, const LoadsNow& now) {
  const State& state = sim.motion.state;
  const Pose& pose = sim.motion.pose;
  const BlockSet& b = sim.scene->blocks;
  const BodyVectors& old = sim.leapfrog.old_velocity;
  const auto moved = [&](Id i) {
    return 0.5 * (h_old * vector_of(b, old, i) + h_new * vector_of(b, state.velocity, i));
  };
  const auto nodes_moved = [&](Id i) {
    return 0.5 * (h_old * vectors_of(old, i) + h_new * vectors_of(state.velocity, i));
  };
  sim.accounts.external_work +=
      load_work(sim, now, pose.x1, pose.y1, moved) + frame_work(sim, now, nodes_moved);
}

/// Of all blocks, on all forces at n, by the velocities of the state.
void add_all_dashpots(const Simulation& sim, BodyVectors& forces, std::vector<Vec2>& on_point,
                      const DashpotStep& step) {
  const BlockSet& blocks = sim.scene->blocks;
  const Dashpots& dashpots = sim.attached.dashpots;
  const State& state = sim.motion.state;
  const DashpotScene scene{blocks, sim.motion.masses, state, state.velocity};
  add_dashpots(forces, on_point, dashpots, scene, step, 0, blocks.size());
  add_mesh_dashpots(forces, on_point, dashpots, scene, step, nullptr, 0, blocks.size());
}

/// Velocities half a step back from the start (theory, section 7.1), and the faces as if positions
/// a step before the start were x_{-1} = x_0 - h v. The forces at the start depend on these
/// positions by slip and dashpots: they are first taken with the initial velocities, then with
/// v_{-1/2}.
void start_leapfrog(Simulation& sim) {
  const BlockSet& blocks = sim.scene->blocks;
  State& state = sim.motion.state;
  Pose& pose = sim.motion.pose;
  BodyVectors& forces = sim.motion.forces;
  LeapfrogStep& own = sim.leapfrog;
  const double h = state.step;
  sim.control.step_before = h;
  auto look_back = [&] {
    const std::vector<double> old_x1 = pose.x1, old_y1 = pose.y1;
    for (std::size_t i = 0; i < blocks.size(); ++i) {
      place_vertices(blocks, state.velocity, i, pose.x1, pose.y1);
    }
    parallel_for(blocks.vertex_count(), [&](std::size_t v) {
      pose.x1[v] = pose.x[v] - h * pose.x1[v];
      pose.y1[v] = pose.y[v] - h * pose.y1[v];
    });
    start_ground(sim, h);
    change_faces(sim, [&](const FaceSet& faces, FaceStates& states) {
      correct_last_step(faces, states, blocks, pose, old_x1, old_y1);
    });
    reevaluate_at_n(sim, h);
    sum_contact_forces(sim);
  };
  look_back();
  gather_forces(forces, blocks, state, pose, sim.motion.on_contacts, sim.attached.springs,
                sim.scene->model.gravity, acting(sim), rock_of(sim));
  own.drive = dashpot_drive(sim, {}, sim.attached.free_field.columns);
  add_all_dashpots(sim, forces, sim.motion.on_dashpots,
                   {0.0, 0.0, nullptr, own.drive.reference, own.drive.push});
  start_velocities(state, blocks, sim.motion.masses, forces, h, sim.motion.damping);
  look_back();
  start_zones(sim.scene->zones, blocks, state, h, sim.motion.zones);
  // The state of the bolts does not go back: their forces at the start do F_0 . (x_0 - x_{-1})/2
  // more work than the bolts lose.
  sim.attached.bolts.work_pending = 0.5 * h * bolt_power(sim);
}

/// Moves from n to n + 1 and halves the step as long as a vertex moves beyond the displacement
/// limit. False: values are not finite, or halving is of no use.
bool move_blocks(Simulation& sim, double h_old, const LoadsNow& at_work) {
  State& state = sim.motion.state;
  Pose& pose = sim.motion.pose;
  StepControl& control = sim.control;
  LeapfrogStep& own = sim.leapfrog;
  std::swap(pose.x1, pose.x2);
  std::swap(pose.y1, pose.y2);
  if (own.old_velocity.x[0].size() != sim.scene->blocks.size()) own.old_velocity = state.velocity;
  std::swap(own.old_velocity, state.velocity);
  constexpr int most_halvings = 40;
  constexpr double lost = 1e100;  // m
  const LoadsNow* not_yet_gathered = &at_work;
  const auto take_back = [&] {
    not_yet_gathered = nullptr;
    undo_step(state, state.step, own.old_velocity);
    std::swap(pose.x, pose.x1);  // bitwise those of n, which the faces remember
    std::swap(pose.y, pose.y1);
    stop_ground(sim);
  };
  bool flows = sim.attached.loads.flow == JointFlow::timed;
  for (int halvings = 0;;) {
    const bool fits = move(sim, h_old, state.step, not_yet_gathered);
    if (fits && !flows) break;
    if (fits) {
      flow_within_step(sim, h_old);
      flows = false;
      take_back();
      continue;
    }
    if (control.last_displacement > lost || halvings++ == most_halvings) return false;
    take_back();
    flows = sim.attached.loads.flow == JointFlow::timed;
    control.cap = 0.5 * state.step;
    control.limit = std::min(control.limit, control.cap);
    fit_step_to(sim, control.target);
    ++sim.accounts.steps.redone;
  }
  return true;
}

/// Contact activation: corrects the faces that opened or closed from n to n + 1.
void switch_faces(Simulation& sim, double h_old) {
  Motion& motion = sim.motion;
  Accounts& accounts = sim.accounts;
  if (sim.scene->model.solver.switching == Switching::exact) {
    switch_in_tiles(sim, {leap_of(sim, h_old, motion.state.step), motion.state, motion.pose});
  }
  accounts.penetration = largest_closure(motion.tiled);
}

void evaluate_and_switch_faces(Simulation& sim, double h_old) {
  place_in_tiles(sim);
  switch_faces(sim, h_old);
}

/// Accounts for work and dissipation of the step, once positions and velocities are final.
void account_for_step(Simulation& sim, double h_old, const LoadsNow& at_work) {
  const State& state = sim.motion.state;
  Accounts& accounts = sim.accounts;
  const double h = state.step;
  const Leap leap = leap_of(sim, h_old, h);
  if (h != h_old) {
    accounts.step_change_energy += energy_of_step_change(state, leap);
    ++accounts.steps.changes;
  }
  accounts.steps.over_critical =
      std::max(accounts.steps.over_critical, h / sim.control.bound.critical_step);
  account_damping(state, leap, accounts.damping_work);
  account_loads(sim, h_old, h, at_work);
  account_boundaries(sim, h_old, h);
}

/// Shortens a step that exceeds the present limit, and lengthens one that may be much longer
/// (theory, section 7.3).
void adjust_step(Simulation& sim) {
  const StepControl& control = sim.control;
  const double h = sim.motion.state.step;
  constexpr double rounding = 1e-12, worth = 1.25;
  if (control.steps_left == 0) return;
  if (control.limit < h * (1.0 - rounding) || control.limit > worth * h) {
    fit_step_to(sim, control.target);
  }
}

/// Puts the vertices back to step n, at which the contacts are, where the step to n + 1 has failed;
/// the nodes keep the rejected positions, which may not be finite.
void leave_vertices_at_n(Pose& pose) {
  std::swap(pose.x, pose.x1);
  std::swap(pose.y, pose.y1);
  std::swap(pose.x1, pose.x2);
  std::swap(pose.y1, pose.y2);
}

std::optional<Failure> step_leapfrog(Simulation& sim) {
  return leap(sim, {.begin = fit_tiles, .evaluate = evaluate_and_switch_faces});
}

void set_leapfrog_limit(Simulation& sim) {
  scale_masses(sim);
  limit_leap(sim, step_bound(stiffness_inputs(sim), &sim.control.step_cache));
}

}  // namespace

std::optional<Failure> leap(Simulation& sim, const LeapContacts& contacts) {
  StepSeconds& seconds = sim.accounts.seconds;
  StepClock clock(sim.motion.state.steps);
  const double h_old = sim.control.step_before;
  split_jump(sim);
  const LoadsNow at_work = acting(sim);
  clock.lap(seconds.forces);
  contacts.begin(sim);
  if (!move_blocks(sim, h_old, at_work)) {
    const Failure failure = lost(sim);
    leave_vertices_at_n(sim.motion.pose);
    return failure;
  }
  clock.lap(seconds.integrate);
  sim.leapfrog.switching.on_fixed = {};
  if (sim.attached.ground.moves) sim.leapfrog.on_fixed = force_on_fixed(sim);
  contacts.evaluate(sim, h_old);
  sim.accounts.max_penetration = std::max(sim.accounts.max_penetration, sim.accounts.penetration);
  clock.lap(seconds.forces);
  account_for_step(sim, h_old, at_work);
  update_bolts(sim.attached.bolts, sim.scene->blocks, sim.motion.state);
  finish_step(sim);
  update_relaxation(sim, at_work);
  clock.lap(seconds.integrate);
  search_if_due(sim);
  if (sim.motion.state.steps % steps_between_flows == 0 &&
      sim.attached.loads.flow == JointFlow::steady)
    update_flow(sim);
  update_laws(sim);
  adjust_step(sim);
  clock.lap(seconds.search);
  return inspect(sim);
}

void scale_masses(Simulation& sim) {
  const StepControl& control = sim.control;
  if (sim.scene->model.solver.mass_scaling > 0.0 || control.scaled_step > 0.0 ||
      control.sliver_step > 0.0)
    raise_masses(sim);
}

void limit_leap(Simulation& sim, const StepBound& bound) {
  const Model& model = sim.scene->model;
  const State& state = sim.motion.state;
  StepControl& control = sim.control;
  control.bound = bound;
  if (model.solver.time_step) {
    const double most = model.solver.allow_unstable
                            ? control.cap
                            : std::min(control.bound.critical_step, control.cap);
    control.limit = std::min(*model.solver.time_step, most);
    return;
  }
  // The limit is lowered at once, and raised only when it is much larger for a long time, since a
  // change of the step costs energy.
  constexpr double worth = 1.25;
  constexpr std::uint64_t lasting = 20000;  // steps
  const double allowed = std::min({model.solver.safety * control.bound.critical_step, control.cap,
                                   sim.attached.free_field.largest_step()});
  if (allowed <= worth * control.limit) control.larger_allowed_since = state.steps;
  if (allowed < control.limit || state.steps >= control.larger_allowed_since + lasting ||
      state.steps == 0) {
    control.limit = allowed;
    control.larger_allowed_since = state.steps;
  }
}

namespace {

/// v_n = (v_{n-1/2} + v_{n+1/2})/2; the next step is made on copies.
void complete_leapfrog(const Simulation& sim, Instant& at) {
  const BlockSet& blocks = sim.scene->blocks;
  const Masses& masses = sim.motion.masses;
  const State& state = sim.motion.state;
  const double h = state.step;
  at.on_dashpots = sim.motion.on_dashpots;
  DampingOfStep damps;
  prepare_damping(sim, h, damps);
  const StepDamping& damping = damps.in_force;
  const Vec2 ground = ground_velocity(sim);
  const DashpotDrive drive = dashpot_drive(sim, ground, next_free_field(sim, ground, h, h));
  add_all_dashpots(sim, at.forces, at.on_dashpots,
                   {h, 0.5 * damping.mass * h, damping.kicks ? &damping.kicks->mass : nullptr,
                    drive.reference, drive.push});
  const Leap leap{blocks, masses, at.forces, state.velocity, h, h, damping};
  advance_modes(at.state, leap, at.forces, 0, blocks.size());
  advance(at.state, leap);
  at.state.position = state.position;
  BodyVectors& velocity = at.state.velocity;
  for (std::size_t i = 0; i < blocks.size(); ++i)
    store(0.5 * (vector_of(blocks, velocity, i) + vector_of(blocks, state.velocity, i)), blocks,
          velocity, i);
  for (const Id i : sim.attached.ground.fixed_blocks) store(at_every_node(ground), velocity, i);
}

/// v/w + R/(m w^2) with the frequency w of the motion of the block (FrequencyEstimate).
double remaining_travel_of_leapfrog(const Simulation& sim, std::size_t i, double force) {
  const double w = sim.relaxation.estimate.frequency_of(i),
               speed = norm(centroid(sim.motion.state.velocity, i));
  if (speed == 0.0 && force == 0.0) return 0.0;
  if (w == 0.0) return std::numeric_limits<double>::infinity();
  return speed / w + force / (inertia_of(sim.motion.masses, i) * w * w);
}

double ahead_of_leapfrog(const Simulation& sim) {
  return 2.0 * sim.control.last_displacement;
}

}  // namespace

const Stepper leapfrog_stepper{.start = start_leapfrog,
                               .set_limit = set_leapfrog_limit,
                               .step = step_leapfrog,
                               .complete_instant = complete_leapfrog,
                               .remaining_travel = remaining_travel_of_leapfrog,
                               .search = search_in_tiles,
                               .begin_contacts = begin_faces,
                               .sum_contacts = sum_face_forces,
                               .deep_overlap = deep_overlap_of_faces,
                               .ahead = ahead_of_leapfrog,
                               .margin = 2.0,
                               .least_reach = 0.0,
                               .velocity_lag = 0.5,
                               .conditionally_stable = true};

}  // namespace edda
