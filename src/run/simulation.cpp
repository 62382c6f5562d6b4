#include "run/simulation.hpp"
#include "run/restitution.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/parallel.hpp"
#include "base/polygon.hpp"
#include "blocks/build_blocks.hpp"
#include "contacts/face_bonds.hpp"
#include "contacts/find_faces.hpp"
#include "contacts/joint_laws.hpp"
#include "contacts/strength.hpp"
#include "forces/dashpot_forces.hpp"
#include "forces/mass_scaling.hpp"
#include "forces/viscosity.hpp"
#include "lines/build_polygons.hpp"
#include "run/load_work.hpp"

namespace edda {
namespace {

double median_edge(const BlockSet& b) {
  std::vector<double> edges;
  for (std::size_t i = 0; i < b.size(); ++i) {
    if (!b.fixed[i]) edges.push_back(b.smallest_edge[i]);
  }
  if (edges.empty()) edges = b.smallest_edge;
  const auto middle = edges.begin() + static_cast<std::ptrdiff_t>(edges.size() / 2);
  std::nth_element(edges.begin(), middle, edges.end());
  return *middle;
}

/// method.md section 5: a part of the model's half-width where it is narrowest (of a slope, its
/// half-height), however it is turned; never more than a tenth of the smallest edge.
double largest_displacement(const BlockSet& b, double ratio) {
  std::vector<Vec2> points;
  points.reserve(b.vertex_count());
  for (std::size_t v = 0; v < b.vertex_count(); ++v) points.push_back(b.vertex(v));
  const double edge = *std::min_element(b.smallest_edge.begin(), b.smallest_edge.end());
  return std::min(ratio * 0.5 * least_width(points), 0.1 * edge);
}

/// Energy that a change of the step creates: sum of m |v+ - v-|^2 (h_old - h_new)/(4 h_mean) with
/// the ledger's definition of work.
double energy_of_step_change(const BlockSet& b, const State& s, const Nodes& old_vx,
                             const Nodes& old_vy, double h_old, double h_new) {
  Nodes dx = s.vx, dy = s.vy;
  for (std::size_t k = 0; k < 3; ++k) {
    for (std::size_t i = 0; i < b.size(); ++i) {
      dx[k][i] -= old_vx[k][i];
      dy[k][i] -= old_vy[k][i];
    }
  }
  const double twice = 2.0 * ordered_sum(b.size(), [&](std::size_t i) {
                         return b.fixed[i] || !s.alive[i] ? 0.0 : kinetic_energy(b, dx, dy, i);
                       });
  return twice * (h_old - h_new) / (2.0 * (h_old + h_new));
}

}  // namespace

Result<Simulation> Simulation::create(Model given, BlockOrder order) {
  Simulation s;
  s.model = std::move(given);
  s.damping = s.model.solver.damping;
  s.dynamic = s.model.solver.dynamic;
  Result<PolygonSet> cut = build_polygons(s.model);
  if (!cut.ok()) return cut.faults();
  s.polygons = std::move(cut.value());
  if (order == BlockOrder::reversed) {
    std::reverse(s.polygons.blocks.begin(), s.polygons.blocks.end());
    s.polygons.reversed = true;
  }
  s.blocks = build_blocks(s.model, s.polygons);
  s.set_viscosity();
  if (std::vector<Fault> faults = fit_restitution(s.model, s.blocks); !faults.empty())
    return faults;
  s.laws = build_laws(s.model);
  // What the first stage finds at the start is judged by its strength.
  const double factor = s.model.stages.empty() ? 1.0 : s.model.stages.front().strength_factor;
  s.laws = divided_laws(s.model, std::vector<double>(s.laws.rows.size(), factor));
  Result<BoundarySprings> springs = attach_boundaries(s.model, s.blocks);
  if (!springs.ok()) return springs.faults();
  s.springs = std::move(springs.value());
  Result<Loads> loads = attach_loads(s.model, s.polygons, s.blocks);
  if (!loads.ok()) return loads.faults();
  s.loads = std::move(loads.value());
  Result<Dashpots> dashpots = attach_dashpots(s.model, s.blocks);
  if (!dashpots.ok()) return dashpots.faults();
  s.dashpots = std::move(dashpots.value());
  for (std::size_t q = 0; q < s.model.boundaries.size(); ++q) {
    if (!s.loads.spells.boundaries[q].acts()) s.springs.release(static_cast<Index>(q));
  }
  s.dashpots.set_acting(s.loads.spells.boundaries);
  s.on_dashpots.assign(s.dashpots.points.size(), Vec2{});
  if (s.model.initial_stress) s.hold_boundaries();
  s.ground = find_ground(s.model, s.blocks);
  s.state = initial_state(s.blocks, s.polygons);

  const std::size_t nb = s.blocks.size(), nv = s.blocks.vertex_count();
  for (std::size_t k = 0; k < 3; ++k) {
    s.forces.x[k].assign(nb, 0.0);
    s.forces.y[k].assign(nb, 0.0);
  }
  s.damping_work.joules.assign(nb, 0.0);
  s.pose.x.resize(nv);
  s.pose.y.resize(nv);
  s.place_all();
  s.pose.x1 = s.pose.x;
  s.pose.y1 = s.pose.y;
  s.base_reach = 0.05 * median_edge(s.blocks);
  s.displacement_limit = largest_displacement(s.blocks, s.model.solver.max_displacement_ratio);
  if (!s.explicit_method()) {
    // Its steps go as far as they may from the first one on.
    s.base_reach = std::max(s.base_reach, 6.0 * s.displacement_limit);
  }
  Result<Bolts> bolts = attach_bolts(s.model, s.blocks, s.state, s.pose.x, s.pose.y);
  if (!bolts.ok()) return bolts.faults();
  s.bolts = std::move(bolts.value());
  s.smallest_half_width = *std::min_element(s.blocks.inradius.begin(), s.blocks.inradius.end());
  s.step_limit = std::numeric_limits<double>::infinity();

  s.pose.x2 = s.pose.x;
  s.pose.y2 = s.pose.y;
  if (s.explicit_method()) s.given_mass_ = {s.blocks.node_mass, s.blocks.inverse_mass};
  s.search(s.base_reach);
  bond_faces(s.contacts, s.blocks, s.pose, s.laws);
  s.close_contacts();
  stand_still(s.contacts);
  // Twice: they have been at rest.
  for (int n = 0; n < 2; ++n) move_points(s.point_contacts, s.blocks, s.pose, s.laws);
  for (auto* work : {&s.contacts.friction_work, &s.contacts.transfer}) work->fill(0.0);
  s.plan_slivers();
  s.set_limit();
  s.free_field = attach_free_field(s.model, s.blocks, s.dashpots, s.step_limit);
  return s;
}

void Simulation::start(double first_event) {
  aim_at(first_event);
  if (!explicit_method()) return start_implicit();
  const double h = state.step;
  step_before_ = h;
  auto look_back = [&] {
    const std::vector<double> old_x1 = pose.x1, old_y1 = pose.y1;
    for (std::size_t i = 0; i < blocks.size(); ++i) {
      place_vertices(blocks, state.vx, state.vy, i, pose.x1, pose.y1);
    }
    parallel_for(blocks.vertex_count(), [&](std::size_t v) {
      pose.x1[v] = pose.x[v] - h * pose.x1[v];
      pose.y1[v] = pose.y[v] - h * pose.y1[v];
    });
    start_ground(h);
    change_step_behind(contacts, blocks, pose, old_x1, old_y1);
    place_faces(contacts, blocks, pose, laws, h);
  };
  look_back();
  gather_forces(forces, blocks, state, pose, contacts, springs, model.gravity, acting());
  hold_ = dashpot_hold({}, free_field.columns);
  add_dashpots(forces, on_dashpots, dashpots, blocks, state, state.vx, state.vy,
               {0.0, 0.0, hold_.reference, hold_.push}, 0, blocks.size());
  start_velocities(state, blocks, forces.x, forces.y, h, damping.drag());
  look_back();
  // Bolts are not gone back: what they pull with at the start does F_0 . (x_0 - x_{-1})/2 more.
  bolts.owed = 0.5 * h * bolt_power();
}

void Simulation::set_limit() {
  if (!explicit_method()) return set_implicit_limit();
  if (model.solver.mass_scaling > 0.0 || scaled_step_ > 0.0 || sliver_step_ > 0.0) raise_masses();
  bound =
      step_bound(blocks, state, contacts, springs, laws, damping, &bolts, nullptr, &known_steps_);
  if (at_points()) {
    const StepBound near =
        step_bound(blocks, state, contacts, springs, laws, damping, &bolts, &point_contacts);
    if (near.critical_step < bound.critical_step) bound = near;
  }
  if (model.solver.time_step) {
    const double most = model.solver.allow_unstable
                            ? displacement_cap_
                            : std::min(bound.critical_step, displacement_cap_);
    step_limit = std::min(*model.solver.time_step, most);
    return;
  }
  // Lowered at once; raised only when it is well worth the energy that a change costs, and lasts.
  constexpr double worth = 1.25;
  constexpr std::uint64_t lasting = 20000;  // steps
  const double allowed = std::min(
      {model.solver.safety * bound.critical_step, displacement_cap_, free_field.largest_step()});
  if (allowed <= worth * step_limit) larger_since_ = state.steps;
  if (allowed < step_limit || state.steps >= larger_since_ + lasting || state.steps == 0) {
    step_limit = allowed;
    larger_since_ = state.steps;
  }
}

/// After a change of masses or damping.
void Simulation::set_viscosity() {
  fill_viscosity(blocks, damping);
  strain_damping_.step = 0.0;
}

StepDamping Simulation::step_damping() {
  return {drag(), damping.local, dashpots.damped.empty() ? nullptr : &dashpots.damped,
          blocks.viscosity.empty() ? nullptr : &strain_damping_};
}

void Simulation::change_damping(const Damping& now, bool carry_velocities) {
  damping = now;
  dynamic = carry_velocities;
  set_viscosity();
  set_face_dashpots(contacts, laws, damping.contact);
  step_limit = std::numeric_limits<double>::infinity();
  set_limit();
}

void Simulation::set_strength_factors(const std::vector<double>& factors) {
  if (factors == laws.divided_by) return;
  const NodalForces before = forces_now();
  take_strength_factors(factors);
  note_jump(before);
}

void Simulation::set_strength_factor(double factor) {
  set_strength_factors(std::vector<double>(laws.rows.size(), factor));
}

void Simulation::reset_displacements() {
  state.from_x = state.x;
  state.from_y = state.y;
}

void Simulation::aim_at(double time) {
  target_ = time;
  const double left = time - state.time;
  constexpr double most = 1e18;  // a count of them must hold it
  const double asked = std::ceil(left / step_limit * (1.0 - 1e-12));
  const double n = asked >= 1.0 ? std::min(asked, most) : 1.0;
  steps_left_ = static_cast<std::uint64_t>(n);
  const double h = left / n;
  // Equal intervals must give equal bits, or every row would cost a change of the step.
  if (std::abs(h - state.step) <= 1e-9 * h && state.step <= step_limit) return;
  state.step = h;
}

bool Simulation::move(double h_old, double h_new, const LoadsNow* not_yet_gathered) {
  drive_ground(h_old, h_new);
  if (not_yet_gathered == nullptr) remove_dashpots(forces, on_dashpots, dashpots);
  const double h = 0.5 * (h_old + h_new);
  damps_ = step_damping();
  const double half_drag = 0.5 * damps_.mass * h;
  if (damps_.strain != nullptr) prepare(*damps_.strain, blocks, h / (1.0 + half_drag));
  const DashpotStep dashing{h, half_drag, hold_.reference, hold_.push};
  largest_.assign((blocks.size() + blocks_at_once - 1) / blocks_at_once, 0.0);
  parallel_chunks(blocks.size(), blocks_at_once,
                  [&](std::size_t c, std::size_t begin, std::size_t end) {
                    if (not_yet_gathered != nullptr) {
                      gather_forces(forces, blocks, state, pose, contacts, springs, model.gravity,
                                    *not_yet_gathered, begin, end);
                    }
                    add_dashpots(forces, on_dashpots, dashpots, blocks, state, old_vx_, old_vy_,
                                 dashing, begin, end);
                    advance(state, blocks, forces.x, forces.y, old_vx_, old_vy_, h_old, h_new,
                            damps_, begin, end);
                    largest_[c] = place_next(blocks, state.x, state.y, pose, begin, end);
                  });
  std::swap(pose.x, pose.x1);
  std::swap(pose.y, pose.y1);
  last_displacement =
      std::sqrt(largest_.empty() ? 0.0 : *std::max_element(largest_.begin(), largest_.end()));
  return last_displacement <= displacement_limit;
}

std::optional<Failure> Simulation::step() {
  if (!explicit_method()) return step_implicit();
  StageClock clock(state.steps);
  split_jump();
  const double h_old = step_before_;
  std::swap(pose.x1, pose.x2);
  std::swap(pose.y1, pose.y2);
  const LoadsNow at_work = acting();
  clock.lap(seconds.forces);

  if (old_vx_[0].size() != blocks.size()) {
    old_vx_ = state.vx;
    old_vy_ = state.vy;
  }
  std::swap(old_vx_, state.vx);
  std::swap(old_vy_, state.vy);
  const LoadsNow* not_yet_gathered = &at_work;
  for (int halvings = 0; !move(h_old, state.step, not_yet_gathered); ++halvings) {
    not_yet_gathered = nullptr;
    if (last_displacement > 1e100 || halvings == 40) return lost();
    retreat(state, blocks, state.step, old_vx_, old_vy_);
    std::swap(pose.x, pose.x1);
    std::swap(pose.y, pose.y1);
    hold_ground();
    place_all();
    displacement_cap_ = 0.5 * state.step;
    step_limit = std::min(step_limit, displacement_cap_);
    aim_at(target_);
    ++steps.redone;
  }
  const double h = state.step;
  clock.lap(seconds.integrate);

  if (ground.moves) on_held_ = force_on_held();
  next_step(contacts);
  if (laws.any_changes) update_joint_laws(contacts, blocks, pose, laws);
  place_faces(contacts, blocks, pose, laws, h);
  clock.lap(seconds.search);
  switching_.on_held = {};
  if (model.solver.switching == Switching::exact) {
    const StepTaken taken{h_old, h, damps_.mass, damps_.strain};
    correct_switching(contacts, blocks, laws, state, pose, taken, open_close, switching_);
  }
  if (at_points()) move_points(point_contacts, blocks, pose, laws);
  penetration = std::max(largest_closure(contacts), point_contacts.deepest);
  max_penetration = std::max(max_penetration, penetration);
  if (h != h_old) {
    step_change_energy += energy_of_step_change(blocks, state, old_vx_, old_vy_, h_old, h);
    ++steps.changes;
  }
  book_damping(state, blocks, forces.x, forces.y, old_vx_, old_vy_, h_old, h, damps_, damping_work);
  book_loads(h_old, h, at_work);
  book_boundaries(h_old, h);
  update_bolts(bolts, state);
  finish_step();
  if (settles) {
    take_pace(at_work);
    bring_on();
  }
  clock.lap(seconds.integrate);

  search_if_due();
  if (step_limit < state.step * (1.0 - 1e-12) ||
      (steps_left_ > 0 && step_limit > 1.25 * state.step)) {
    if (steps_left_ > 0) aim_at(target_);
  }
  clock.lap(seconds.search);
  return inspect();
}

/// Work of the loads in the leapfrog's terms: f_n . (x_{n+1} - x_{n-1})/2.
void Simulation::book_loads(double h_old, double h_new, const LoadsNow& now) {
  const auto moved = [&](Id i, std::size_t k) {
    const Vec2 before{old_vx_[k][i], old_vy_[k][i]}, after{state.vx[k][i], state.vy[k][i]};
    return 0.5 * (h_old * before + h_new * after);
  };
  external_work += load_work(*this, now, pose.x1, pose.y1, moved) + frame_work(*this, now, moved);
}

void Simulation::finish_step() {
  const double h = state.step;
  ++state.steps;
  --steps_left_;
  state.time = steps_left_ == 0 ? target_ : state.time + h;
  step_before_ = h;
  steps.smallest = steps.smallest == 0.0 ? h : std::min(steps.smallest, h);
  steps.largest = std::max(steps.largest, h);
  steps.sum += h;
  if (explicit_method()) {
    steps.over_critical = std::max(steps.over_critical, h / bound.critical_step);
  }
}

std::optional<Failure> Simulation::inspect() const {
  if (!std::isfinite(last_displacement)) return lost();
  if (at_points())
    return deep_overlap(point_contacts, blocks, state, pose, penetration, smallest_half_width,
                        step_in_use());
  return deep_overlap(contacts, blocks, state, pose, penetration, smallest_half_width,
                      step_in_use());
}

StepInUse Simulation::step_in_use() const {
  const double stable = explicit_method() ? bound.critical_step : state.step;
  return {state.step, stable};
}

Failure Simulation::lost() const {
  return lost_block(blocks, state, pose, forces, step_in_use());
}

Ledger Simulation::ledger_now() const {
  const double behind = explicit_method() ? step_before_ : 0.0;  // of v_{n-1/2}
  Ledger l =
      sum_ledger(blocks, state, behind, pose, contacts, springs, damping_work, model.gravity);
  l.step_change = -step_change_energy;
  l.external = external_work;
  l.contact += bolt_energy(bolts) + point_contacts.energy;
  l.friction += bolts.slipped + point_contacts.friction;
  l.fracture += bolts.fractured;
  return l;
}

double Simulation::energy_scale(const Ledger& l) const {
  return std::max({largest_energy, l.scale(), rounding_energy(blocks, contacts)});
}

Ledger Simulation::ledger() {
  Ledger l = ledger_now();
  if (!start_energy) start_energy = l.balance();
  largest_energy = energy_scale(l);
  l.drift = (l.balance() - *start_energy) / largest_energy;
  return l;
}

}  // namespace edda
