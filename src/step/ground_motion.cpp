// Motion and damping at the boundaries of the model, in the explicit method: ground motion,
// velocity boundaries, outgoing and incoming waves.
#include <algorithm>

#include "base/parallel.hpp"
#include "forces/nodal_forces.hpp"
#include "model/files/accelerogram.hpp"
#include "step/simulation.hpp"

namespace edda {

LoadsNow acting(const Simulation& sim) {
  const Bolts& bolts = sim.attached.bolts;
  LoadsNow now = loads_at(sim.scene->model, sim.attached.loads, sim.motion.state.time);
  if (!bolts.rows.empty()) now.bolts = &bolts;
  return now;
}

PoreWater water_in_pores(const Simulation& sim) {
  const Loads& loads = sim.attached.loads;
  if (loads.wet_zones.empty()) return {};
  LoadsNow now = loads_at(sim.scene->model, loads, sim.motion.state.time);
  for (double& weight : now.weight) weight /= sim.scene->model.thickness;
  return {&loads.wet_zones, std::move(now.rise), std::move(now.weight)};
}

Vec2 ground_velocity(const Simulation& sim) {
  const State& state = sim.motion.state;
  return sim.attached.ground.velocity +
         (0.5 * state.step) *
             ground_acceleration(sim.scene->model, sim.attached.loads.intervals, state.time);
}

namespace {

/// 2 v of the waves that come up through a boundary, m/s; `none`: of all boundaries.
Vec2 twice_incoming(const Simulation& sim, Index boundary) {
  const Model& model = sim.scene->model;
  Vec2 sum;
  for (std::size_t q = 0; q < model.shakings.size(); ++q) {
    const Shaking& shaking = model.shakings[q];
    const ActiveInterval& interval = sim.attached.loads.intervals.shakings[q];
    if (shaking.apply != ShakingKind::upgoing || !interval.acts()) continue;
    if (boundary != none && shaking.enters != boundary) continue;
    sum += 2.0 * velocity_at(shaking, sim.motion.state.time - interval.since);
  }
  return sum;
}

}  // namespace

DashpotDrive dashpot_drive(const Simulation& sim, Vec2 of_ground,
                           const std::vector<FreeFieldColumn>& next) {
  const Dashpots& dashpots = sim.attached.dashpots;
  const FreeField& free_field = sim.attached.free_field;
  const std::vector<double>& viscosity = sim.motion.masses.viscosity;
  DashpotDrive drive;
  const std::size_t points = dashpots.points.size();
  std::vector<Vec2> of_row(sim.scene->model.boundaries.size());
  for (std::size_t q = 0; q < of_row.size(); ++q) {
    of_row[q] = of_ground + twice_incoming(sim, static_cast<Index>(q));
  }
  drive.reference.resize(points);
  if (!free_field.empty()) drive.push.resize(points);
  for (std::size_t p = 0; p < points; ++p) {
    const Index q = free_field.empty() ? none : free_field.column[p];
    if (q == none) {
      drive.reference[p] = of_row[static_cast<std::size_t>(dashpots.points[p].boundary)];
      continue;
    }
    const FreeFieldColumn& now = free_field.columns[static_cast<std::size_t>(q)];
    const FreeFieldColumn& then = next[static_cast<std::size_t>(q)];
    const double y = free_field.height[p];
    drive.reference[p] = 0.5 * (now.at(now.velocity, y) + then.at(then.velocity, y));
    const double middle = free_field.middle[p];
    drive.push[p] = free_field.face[p] * now.traction(now.moved, middle);
    if (!viscosity.empty())
      drive.push[p] += free_field.face[p] * now.viscous_traction(viscosity, then.velocity, middle);
  }
  return drive;
}

std::vector<FreeFieldColumn> next_free_field(const Simulation& sim, Vec2 of_ground, double h_old,
                                             double h_new) {
  const Model& model = sim.scene->model;
  const FreeField& free_field = sim.attached.free_field;
  if (free_field.empty()) return {};
  FreeFieldDrive drive;
  drive.lets_waves_in =
      std::any_of(model.shakings.begin(), model.shakings.end(),
                  [](const Shaking& s) { return s.apply == ShakingKind::upgoing; });
  drive.twice_incoming = twice_incoming(sim, none);
  drive.ground = of_ground;
  drive.frame = loads_at(model, sim.attached.loads, sim.motion.state.time).frame;
  drive.mass_damping = mass_damping(sim);
  drive.decay = &sim.motion.masses.decay;
  drive.viscosity = &sim.motion.masses.viscosity;
  drive.local_damping = sim.motion.damping.local;
  return next_columns(free_field.columns, drive, h_old, h_new);
}

void start_ground(Simulation& sim, double h) {
  const BlockSet& blocks = sim.scene->blocks;
  BoundarySprings& springs = sim.attached.springs;
  Ground& ground = sim.attached.ground;
  Pose& pose = sim.motion.pose;
  if (!ground.moves) return;
  ground.velocity = (-0.5 * h) * ground_acceleration(sim.scene->model, sim.attached.loads.intervals,
                                                     sim.motion.state.time);
  ground.shift_1 = ground.shift - h * ground.velocity;
  springs.shift_1.assign(springs.shift.size(), ground.shift_1);
  for (const Id i : ground.fixed_blocks) {
    for (Id v = blocks.vertex_begin[i]; v < blocks.vertex_begin[i + 1]; ++v) {
      pose.x1[v] = pose.x[v] - h * ground.velocity.x;
      pose.y1[v] = pose.y[v] - h * ground.velocity.y;
    }
  }
}

void drive_ground(Simulation& sim, double h_old, double h_new) {
  const Ground& ground = sim.attached.ground;
  State& state = sim.motion.state;
  LeapfrogStep& own = sim.leapfrog;
  if (!ground.moves) {
    if (sim.attached.dashpots.points.empty()) return;
    own.next_columns = next_free_field(sim, {}, h_old, h_new);
    own.drive = dashpot_drive(sim, {}, own.next_columns);
    return;
  }
  own.next_ground = next_ground(sim.scene->model, sim.attached.loads, ground, sim.attached.springs,
                                state.time, h_old, h_new);
  place_fixed(sim.scene->blocks, ground, own.next_ground.shift, state.position);
  own.next_columns = next_free_field(sim, own.next_ground.velocity, h_old, h_new);
  own.drive =
      dashpot_drive(sim, 0.5 * (ground.velocity + own.next_ground.velocity), own.next_columns);
}

void stop_ground(Simulation& sim) {
  const Ground& ground = sim.attached.ground;
  State& state = sim.motion.state;
  if (ground.moves) place_fixed(sim.scene->blocks, ground, ground.shift, state.position);
}

Vec2 force_on_fixed(const Simulation& sim) {
  Vec2 on_fixed;
  for (const Id i : sim.attached.ground.fixed_blocks) {
    BlockForces f{sim.scene->blocks, i};
    add_bolts(f, sim.attached.bolts);
    const BodyVectors& faces = sim.motion.on_contacts;
    on_fixed += resultant(vectors_of(faces, i)) + resultant(f.sum.nodes);
  }
  return on_fixed;
}

/// Work in the leapfrog's terms, f_n . (x_{n+1} - x_{n-1})/2. A dashpot between a block that moves
/// by u and a ground that moves by r dissipates -f . (u - r) and receives f . r. Fixed blocks and
/// springs that move by r while they carry the force f receive -f . r. The forces of free-field
/// columns do external work.
void account_boundaries(Simulation& sim, double h_old, double h_new) {
  BoundarySprings& springs = sim.attached.springs;
  const Dashpots& dashpots = sim.attached.dashpots;
  Ground& ground = sim.attached.ground;
  const State& state = sim.motion.state;
  const Pose& pose = sim.motion.pose;
  Accounts& accounts = sim.accounts;
  LeapfrogStep& own = sim.leapfrog;
  for (std::size_t p = 0; p < dashpots.points.size(); ++p) {
    const Dashpot& at = dashpots.points[p];
    const bool acts = dashpots.acts[static_cast<std::size_t>(at.boundary)] != 0;
    if (!acts || !is_free(sim.scene->blocks, state, at.block)) continue;
    const NodeVectors before = vectors_of(own.old_velocity, at.block),
                      after = vectors_of(state.velocity, at.block);
    Vec2 moved = 0.5 * weighted(at.weight, h_old * before + h_new * after);
    if (at.node != no_id) {
      const std::size_t mode = sim.scene->blocks.bending.modes() + at.node;
      moved += 0.5 * (h_old * own.old_velocity.modes[mode] + h_new * state.velocity.modes[mode]);
    }
    const Vec2 carried = (0.5 * (h_old + h_new)) * own.drive.reference[p];
    const Vec2 push = own.drive.push.empty() ? Vec2{} : own.drive.push[p];
    accounts.damping_work.joules[at.block] -=
        dot(sim.motion.on_dashpots[p] - push, moved - carried);
    accounts.external_work += dot(sim.motion.on_dashpots[p] - push, carried) + dot(push, moved);
  }
  sim.attached.free_field.columns.swap(own.next_columns);
  if (!ground.moves) return;
  for (std::size_t q = 0; q < springs.size(); ++q) {
    const auto row = static_cast<std::size_t>(springs.boundary[q]);
    const Vec2 carried = 0.5 * (own.next_ground.shifts[row] - springs.shift_1[row]);
    accounts.external_work += dot(spring_force(springs, q, pose.x1, pose.y1), carried);
  }
  accounts.external_work -=
      dot(own.on_fixed + own.switching.on_fixed, 0.5 * (own.next_ground.shift - ground.shift_1));
  springs.shift_1 = springs.shift;
  springs.shift = own.next_ground.shifts;
  ground.shift_1 = ground.shift;
  ground.shift = own.next_ground.shift;
  ground.velocity = own.next_ground.velocity;
}

double bolt_power(const Simulation& sim) {
  const BlockSet& blocks = sim.scene->blocks;
  const Bolts& bolts = sim.attached.bolts;
  const Ground& ground = sim.attached.ground;
  const State& state = sim.motion.state;
  if (bolts.place.empty()) return 0.0;
  return ordered_sum(blocks.size(), [&](std::size_t i) {
    const bool carried = blocks.fixed[i] && ground.moves;
    if (!carried && !is_free(blocks, state, i)) return 0.0;
    BlockForces f{blocks, i};
    add_bolts(f, bolts);
    return carried ? dot(f.sum.nodes, at_every_node(ground.velocity))
                   : dot(f.sum, vector_of(blocks, state.velocity, i));
  });
}

}  // namespace edda
