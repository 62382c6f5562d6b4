// The step of method "dda": Newmark with a global solve instead of the leapfrog. Blocks, contacts,
// laws and results are the same.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/parallel.hpp"
#include "contacts/tile_trials.hpp"
#include "step/contact_search.hpp"
#include "step/instant.hpp"
#include "step/labels.hpp"
#include "step/load_work.hpp"
#include "step/simulation.hpp"
#include "step/step.hpp"
#include "step/tile_step.hpp"

namespace edda {
namespace {

/// The step in which no vertex at its present speed, in free fall, moves beyond `limit`.
double step_within(const BlockSet& b, const State& s, Vec2 gravity, double limit) {
  double speed = 0.0;
  for (std::size_t v = 0; v < b.vertex_count(); ++v) {
    if (!b.fixed[b.vertex_block[v]]) speed = std::max(speed, norm(corner_at(b, s.velocity, v)));
  }
  // v h + g h^2/2 = limit
  const double root = std::sqrt(speed * speed + 2.0 * norm(gravity) * limit);
  return 2.0 * limit / (speed + root);
}

/// The failure of a step that was halved most_cuts times.
Failure out_of_balance(const Simulation& sim, Attempt last) {
  if (last == Attempt::too_far) {
    Failure fast;
    fast.time = sim.motion.state.time;
    double most = -1.0;
    for (std::size_t i = 0; i < sim.scene->blocks.size(); ++i) {
      const double speed = norm(centroid(sim.motion.state.velocity, i));
      if (sim.scene->blocks.fixed[i] || !(speed > most)) continue;
      most = speed;
      fast.block = static_cast<Id>(i);
    }
    fast.place = centroid(sim.motion.state.position, fast.block) + sim.scene->blocks.origin;
    fast.message = fmt::format(
        "{} moves at {:.3g} m/s, further than solver.max_displacement_ratio allows even in a step "
        "of {:.3g} s: check velocities and loads, and their units",
        block_label(sim.scene->blocks, fast.block), most, sim.motion.state.step);
    return fast;
  }
  const std::vector<double>& error = sim.implicit.error;
  const auto worst = std::max_element(error.begin(), error.end(), [](double a, double b) {
    return (std::isnan(a) ? 1e300 : a) < (std::isnan(b) ? 1e300 : b);
  });
  Failure f;
  f.time = sim.motion.state.time;
  f.block = sim.implicit.block_of[static_cast<std::size_t>(worst - error.begin())];
  f.place = centroid(sim.motion.state.position, f.block) + sim.scene->blocks.origin;
  f.message = fmt::format(
      "forces and contacts of {} do not converge, not even in a step of {:.3g} s: loads or "
      "stiffnesses are out of proportion: check units, and the support of the block",
      block_label(sim.scene->blocks, f.block), sim.motion.state.step);
  return f;
}

void set_newmark_limit(Simulation& sim) {
  const Model& model = sim.scene->model;
  const BlockSet& blocks = sim.scene->blocks;
  const State& state = sim.motion.state;
  StepControl& control = sim.control;
  if (state.steps > 0 && control.limit <= control.nominal) return;
  control.limit =
      model.solver.time_step
          ? *model.solver.time_step
          : std::min(step_within(blocks, state, model.gravity, sim.scene->displacement_limit),
                     std::min(model.output.history_every, model.output.every));
  control.nominal = control.limit;
  // The friction limit in a step comes from the normal forces before it. There are none before the
  // first step, so that one is short.
  constexpr double first_part = 1e-3;
  if (state.steps == 0 && !model.solver.time_step) control.limit *= first_part;
  // The bound of the explicit method, for comparison.
  control.bound = step_bound(stiffness_inputs(sim));
}

void start_newmark(Simulation& sim) {
  const State& state = sim.motion.state;
  Pose& pose = sim.motion.pose;
  sim.control.step_before = state.step;
  pose.x1 = pose.x;
  pose.y1 = pose.y;
  reevaluate_at_n(sim, state.step);
  end_at_rest(sim.motion.contacts, sim.motion.tiled.tiles, sim.scene->blocks, pose);
}

/// Work of the loads in the terms of the scheme: f_{n+1} . D.
void account_loads(Simulation& sim, const LoadsNow& now) {
  const Pose& pose = sim.motion.pose;
  const BlockSet& b = sim.scene->blocks;
  const ImplicitSolver& own = sim.implicit;
  const auto nodes_moved = [&](Id i) {
    return vectors_of(own.matrix.part(own.moved, own.row_of[i]).head<degrees_of_freedom>());
  };
  const auto moved = [&](Id i) {
    BodyVector u = vector_of(b, sim.motion.state.position, i) - vector_of(b, own.start, i);
    u.nodes = nodes_moved(i);
    return u;
  };
  sim.accounts.external_work +=
      load_work(sim, now, pose.x, pose.y, moved) + frame_work(sim, now, nodes_moved);
}

ImplicitSettings settings_of(const Simulation& sim) {
  const Damping& damping = sim.motion.damping;
  ImplicitSettings settings;
  settings.dynamic = sim.motion.dynamic;
  settings.damping = damping;
  settings.contact_damping = damping.contact;
  settings.displacement_limit = sim.scene->displacement_limit;
  // The equilibrium ratio to be reached must lie above what the iterations leave unbalanced.
  constexpr double finer = 0.1;
  if (sim.relaxation.seeks_equilibrium) {
    settings.balance = std::min(settings.balance, finer * sim.relaxation.equilibrium_ratio);
  }
  return settings;
}

/// Moves from n to n + 1 and halves the step until the open-close iteration converges. `now`: loads
/// at n + 1.
std::optional<Failure> move_blocks(Simulation& sim, LoadsNow& now) {
  State& state = sim.motion.state;
  OpenCloseCounts& counts = sim.accounts.open_close;
  const ImplicitSolver& own = sim.implicit;
  ImplicitScene scene{sim.scene->blocks,    sim.motion.masses,        sim.motion.laws,
                      sim.attached.springs, sim.scene->model.gravity, {},
                      sim.motion.locked};
  ImplicitSettings settings = settings_of(sim);
  constexpr int most_cuts = 40;
  for (int cuts = 0;; ++cuts) {
    settings.step = state.step;
    scene.loads = loads_at(sim.scene->model, sim.attached.loads, state.time + state.step);
    const Attempt attempt = newmark_step(sim.implicit, scene, settings, state, sim.motion.pose,
                                         {sim.motion.contacts, sim.motion.tiled}, sim.motion.forces,
                                         sim.accounts.damping_work.joules);
    const auto iterations = static_cast<std::uint64_t>(own.iterations);
    counts.passes += iterations;
    counts.most = std::max(counts.most, iterations);
    counts.switched += own.switched;
    if (attempt == Attempt::accepted) break;
    if (attempt == Attempt::not_converged) ++counts.not_converged;
    if (cuts == most_cuts) return out_of_balance(sim, attempt);
    sim.control.limit = 0.5 * state.step;
    fit_step_to(sim, sim.control.target);
    ++sim.accounts.steps.redone;
  }
  ++counts.steps;
  sim.control.last_displacement = own.last_displacement;
  now = std::move(scene.loads);
  return {};
}

/// Lengthens a step that was cut, once it converges easily.
void lengthen_step(Simulation& sim) {
  StepControl& control = sim.control;
  constexpr int easy = 3;  // iterations
  constexpr double worth = 1.25;
  if (control.limit < control.nominal && sim.implicit.iterations <= easy &&
      control.last_displacement < 0.5 * sim.scene->displacement_limit) {
    control.limit = std::min(control.nominal, 2.0 * control.limit);
  }
  if (control.steps_left > 0 && control.limit > worth * sim.motion.state.step) {
    fit_step_to(sim, control.target);
  }
}

std::optional<Failure> step_newmark(Simulation& sim) {
  Motion& motion = sim.motion;
  Accounts& accounts = sim.accounts;
  StepClock clock(motion.state.steps);
  TiledFaces& tiled = sim.motion.tiled;
  fit_tiles(sim);
  // A step begins at the end of the last one, whatever the faces were evaluated for since.
  drop_trial(tiled.tiles);
  LoadsNow at_work;
  if (std::optional<Failure> failure = move_blocks(sim, at_work)) return failure;
  motion.on_contacts = sim.implicit.on_faces;
  account_loads(sim, at_work);
  if (motion.state.step != sim.control.step_before) ++accounts.steps.changes;
  finish_step(sim);
  accounts.penetration = largest_closure(tiled);
  accounts.max_penetration = std::max(accounts.max_penetration, accounts.penetration);
  motion.pose.x1 = motion.pose.x;
  motion.pose.y1 = motion.pose.y;
  clock.lap(accounts.seconds.integrate);
  search_if_due(sim);
  lengthen_step(sim);
  clock.lap(accounts.seconds.search);
  return inspect(sim);
}

/// All values belong to one instant already.
void complete_newmark(const Simulation&, Instant&) {}

/// The distance that the last static step moved the block.
double remaining_travel_of_newmark(const Simulation& sim, std::size_t i, double) {
  const ImplicitSolver& own = sim.implicit;
  if (is_empty(own.mean_velocity)) return std::numeric_limits<double>::infinity();
  return sim.motion.state.step * norm(centroid(own.mean_velocity, i));
}

/// Steps may move vertices up to the limit from the first one on.
double ahead_of_newmark(const Simulation& sim) {
  return sim.scene->displacement_limit;
}

}  // namespace

const Stepper newmark_stepper{.start = start_newmark,
                              .set_limit = set_newmark_limit,
                              .step = step_newmark,
                              .complete_instant = complete_newmark,
                              .remaining_travel = remaining_travel_of_newmark,
                              .search = search_in_tiles,
                              .begin_contacts = begin_faces,
                              .sum_contacts = sum_face_forces,
                              .deep_overlap = deep_overlap_of_faces,
                              .ahead = ahead_of_newmark,
                              .margin = 1.0,
                              .least_reach = 6.0,
                              .velocity_lag = 0.0,
                              .conditionally_stable = false};

}  // namespace edda
