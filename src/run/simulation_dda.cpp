// The step of method "dda": Newmark with a global solve in place of the leapfrog. Blocks, contacts,
// laws and results are the same.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/parallel.hpp"
#include "contacts/joint_laws.hpp"
#include "contacts/place_faces.hpp"
#include "run/face_switching.hpp"
#include "run/labels.hpp"
#include "run/load_work.hpp"
#include "run/observe.hpp"
#include "run/simulation.hpp"

namespace edda {
namespace {

/// Step in which nothing that starts at its present velocity and falls freely goes beyond `limit`.
double step_within(const BlockSet& b, const State& s, Vec2 gravity, double limit) {
  double speed = 0.0;
  for (std::size_t v = 0; v < b.vertex_count(); ++v) {
    if (!b.fixed[b.vertex_block[v]]) speed = std::max(speed, norm(vertex_at(b, s.vx, s.vy, v)));
  }
  // v h + g h^2/2 = limit
  const double root = std::sqrt(speed * speed + 2.0 * norm(gravity) * limit);
  return 2.0 * limit / (speed + root);
}

/// After the last cut.
Failure out_of_balance(const Simulation& sim, Attempt last) {
  if (last == Attempt::too_far) {
    Failure fast;
    fast.time = sim.state.time;
    double most = -1.0;
    for (std::size_t i = 0; i < sim.blocks.size(); ++i) {
      const double speed = norm(centroid(sim.state.vx, sim.state.vy, i));
      if (sim.blocks.fixed[i] || !(speed > most)) continue;
      most = speed;
      fast.block = static_cast<Id>(i);
    }
    fast.place = centroid(sim.state.x, sim.state.y, fast.block) + sim.blocks.origin;
    fast.message = fmt::format(
        "{} moves at {:.3g} m/s, further than solver.max_displacement_ratio allows even in a step "
        "of {:.3g} s: check velocities and loads, and their units",
        block_label(sim.blocks, fast.block), most, sim.state.step);
    return fast;
  }
  const std::vector<double>& error = sim.implicit.error;
  const auto worst = std::max_element(error.begin(), error.end(), [](double a, double b) {
    return (std::isnan(a) ? 1e300 : a) < (std::isnan(b) ? 1e300 : b);
  });
  Failure f;
  f.time = sim.state.time;
  f.block = sim.implicit.block_of[static_cast<std::size_t>(worst - error.begin())];
  f.place = centroid(sim.state.x, sim.state.y, f.block) + sim.blocks.origin;
  f.message = fmt::format(
      "forces and contacts of {} come to no agreement, not even in a step of {:.3g} s: loads or "
      "stiffnesses are out of proportion: check units, and what the block rests on",
      block_label(sim.blocks, f.block), sim.state.step);
  return f;
}

}  // namespace

void Simulation::set_implicit_limit() {
  if (state.steps > 0 && step_limit <= nominal_step_) return;
  step_limit = model.solver.time_step
                   ? *model.solver.time_step
                   : std::min(step_within(blocks, state, model.gravity, displacement_limit),
                              std::min(model.output.history_every, model.output.every));
  nominal_step_ = step_limit;
  // Friction in a step has its limit from the forces before it: the first has none, and is short.
  constexpr double first_part = 1e-3;
  if (state.steps == 0 && !model.solver.time_step) step_limit *= first_part;
  // What the explicit method could take, for whoever compares.
  bound = step_bound(blocks, state, contacts, springs, laws, damping);
}

void Simulation::start_implicit() {
  step_before_ = state.step;
  pose.x1 = pose.x;
  pose.y1 = pose.y;
  place_faces(contacts, blocks, pose, laws, state.step);
  stand_still(contacts);
}

/// Work of the loads as the scheme sees it: f_{n+1} . D.
void Simulation::book_implicit_loads(const LoadsNow& now) {
  const auto moved = [&](Id i, std::size_t k) {
    const auto at = static_cast<Eigen::Index>(6 * std::size_t{implicit.row_of[i]} + 2 * k);
    return Vec2{implicit.moved[at], implicit.moved[at + 1]};
  };
  external_work += load_work(*this, now, pose.x, pose.y, moved) + frame_work(*this, now, moved);
}

std::optional<Failure> Simulation::step_implicit() {
  StageClock clock(state.steps);
  if (laws.any_changes) update_joint_laws(contacts, blocks, pose, laws);
  ImplicitScene scene{blocks, laws, springs, model.gravity};
  ImplicitSettings settings;
  settings.dynamic = dynamic;
  settings.mass_damping = damping.drag();
  settings.contact_damping = damping.contact;
  settings.displacement_limit = displacement_limit;
  // What is to be seen at rest must not hide behind what rounds leave.
  constexpr double finer = 0.1;
  if (settles) settings.balance = std::min(settings.balance, finer * rest_ratio);
  constexpr int most_cuts = 40;
  for (int cuts = 0;; ++cuts) {
    settings.step = state.step;
    scene.loads = loads_at(model, loads, state.time + state.step);
    const Attempt attempt =
        newmark_step(implicit, scene, settings, state, pose, contacts, forces, damping_work.joules);
    open_close.passes += static_cast<std::uint64_t>(implicit.rounds);
    open_close.most = std::max(open_close.most, static_cast<std::uint64_t>(implicit.rounds));
    open_close.switched += implicit.switched;
    if (attempt == Attempt::accepted) break;
    if (attempt == Attempt::unsettled) ++open_close.unsettled;
    if (cuts == most_cuts) return out_of_balance(*this, attempt);
    step_limit = 0.5 * state.step;
    aim_at(target_);
    ++steps.redone;
  }
  ++open_close.steps;
  clock.lap(seconds.integrate);

  last_displacement = implicit.last_displacement;
  book_implicit_loads(scene.loads);
  if (state.step != step_before_) ++steps.changes;
  finish_step();
  penetration = largest_closure(contacts);
  max_penetration = std::max(max_penetration, penetration);
  pose.x1 = pose.x;
  pose.y1 = pose.y;
  search_if_due();

  // A step that had been cut grows again once it is easy.
  constexpr int easy = 3;  // rounds
  if (step_limit < nominal_step_ && implicit.rounds <= easy &&
      last_displacement < 0.5 * displacement_limit) {
    step_limit = std::min(nominal_step_, 2.0 * step_limit);
  }
  if (steps_left_ > 0 && step_limit > 1.25 * state.step) aim_at(target_);
  clock.lap(seconds.search);
  return inspect();
}

}  // namespace edda
