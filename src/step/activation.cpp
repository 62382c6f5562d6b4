// Changes of what acts on the blocks only during some stages: loads, waters, boundaries, ground
// motions, bolts.
#include <algorithm>
#include <cmath>
#include <limits>

#include "attachments/boundary_lines.hpp"
#include "contacts/face_bonds.hpp"
#include "model/files/accelerogram.hpp"
#include "step/changes.hpp"
#include "step/contact_search.hpp"
#include "step/energy_balance.hpp"
#include "step/force_jumps.hpp"
#include "step/simulation.hpp"
#include "step/tile_step.hpp"

namespace edda {
namespace {

constexpr double never = std::numeric_limits<double>::infinity();

void set_all(std::vector<ActiveInterval>& intervals, const std::vector<Index>& off,
             const std::vector<Index>& on, double time) {
  for (const Index q : off) intervals[static_cast<std::size_t>(q)].until = time;
  for (const Index q : on) intervals[static_cast<std::size_t>(q)] = {time, never};
}

bool names_row(const std::vector<Index>& rows, Index row) {
  return std::find(rows.begin(), rows.end(), row) != rows.end();
}

/// Velocity that these ground motions (rows of Model::shakings) have given the ground, m/s.
Vec2 velocity_of_ground_by(const Simulation& sim, const std::vector<Index>& rows) {
  Vec2 sum;
  for (const Index q : rows) {
    const auto row = static_cast<std::size_t>(q);
    const Shaking& shaking = sim.scene->model.shakings[row];
    const double since = sim.attached.loads.intervals.shakings[row].since;
    if (shaking.apply == ShakingKind::base) {
      sum += velocity_at(shaking, sim.motion.state.time - since);
    }
  }
  return sum;
}

/// The part of a force on the vertex that a boundary can carry, 0 where the vertex does not lie on
/// it. One that slides carries the part across its lines.
Vec2 carried_by(const Model& model, const BlockSet& b, const Boundary& boundary, Id v, Vec2 force) {
  const double snap = boundary_snap(model, b);
  Vec2 first;
  bool on = false;
  for (const Line& line : boundary_lines(model, b, boundary)) {
    if (distance_to_segment(b.vertex(v), line.a, line.b) > snap) continue;
    if (!boundary.slides()) return force;
    const Vec2 n = perp(unit(line.b - line.a));
    if (on && std::abs(cross(n, first)) > 1e-9) return force;  // a corner carries both components
    first = n;
    on = true;
  }
  return on ? dot(force, first) * first : Vec2{};
}

}  // namespace

void keep(Simulation& sim, const std::vector<WallForce>& more) {
  std::vector<WallForce>& kept = sim.attached.wall_forces;
  kept.insert(kept.end(), more.begin(), more.end());
  keep_wall_forces(sim.scene->model, sim.scene->blocks, more, sim.attached.loads);
}

namespace {

/// Releases these boundaries and returns the static forces that they had on vertices.
std::vector<WallForce> release_boundaries(Simulation& sim, const std::vector<Index>& rows) {
  const Model& model = sim.scene->model;
  const BlockSet& blocks = sim.scene->blocks;
  BoundarySprings& springs = sim.attached.springs;
  Loads& loads = sim.attached.loads;
  const Pose& pose = sim.motion.pose;
  std::vector<WallForce>& kept = sim.attached.wall_forces;
  std::vector<WallForce> wall_forces;
  const LoadsNow now = acting(sim);
  const auto first = static_cast<Index>(model.loads.size());
  for (const EdgeLoad& e : loads.edges) {
    if (!names_row(rows, e.load - first)) continue;
    const double part = now.factor[static_cast<std::size_t>(e.load)] * (e.to - e.from);
    const double middle = 0.5 * (e.from + e.to);
    const Vec2 whole = (part * blocks.edge_length[e.edge]) * e.traction;
    const double factor = now.factor[static_cast<std::size_t>(e.load)];
    const EndForces ends = on_vertices(e.from, e.to, e.ends);
    wall_forces.push_back({e.edge, (1.0 - middle) * whole + factor * ends.at_from, none});
    wall_forces.push_back({blocks.next[e.edge], middle * whole + factor * ends.at_to, none});
  }
  for (std::size_t q = 0; q < springs.size(); ++q) {
    if (!names_row(rows, springs.boundary[q])) continue;
    wall_forces.push_back({springs.vertex[q], spring_force(springs, q, pose.x, pose.y), none});
  }
  for (const Index row : rows) {
    const Index owner = Owners(model).of_boundary(row);
    for (const WallForce& f : kept) {
      if (f.owner == owner) wall_forces.push_back(f);
    }
    std::erase_if(kept, [&](const WallForce& f) { return f.owner == owner; });
    remove_wall_forces(model, blocks, owner, loads);
    springs.release(row);
  }
  return wall_forces;
}

}  // namespace

std::optional<Fault> install(Simulation& sim, const std::vector<Index>& which) {
  const Model& model = sim.scene->model;
  const BlockSet& blocks = sim.scene->blocks;
  Bolts& bolts = sim.attached.bolts;
  const Pose& pose = sim.motion.pose;
  // The walls have moved since the bolts were drawn.
  constexpr double slack = 0.05;
  const AsExternalWork work(sim);
  const double power = bolt_power(sim);
  Result<Bolts> fresh = attach_bolts(model, blocks, sim.motion.state, pose.x, pose.y, which, slack);
  if (!fresh.ok()) return fresh.faults().front();
  add_bolts(bolts, fresh.value(), model, blocks.size());
  // In the leapfrog's terms the new forces at n also do work over the second half of the last step,
  // in which the bolts did not store it.
  bolts.work_pending +=
      sim.stepper->velocity_lag * sim.control.step_before * (bolt_power(sim) - power);
  return {};
}

void switch_over(Simulation& sim, const NamedRows& off, const NamedRows& on) {
  const Model& model = sim.scene->model;
  Loads& loads = sim.attached.loads;
  const State& state = sim.motion.state;
  const Pose& pose = sim.motion.pose;
  // The rigid velocity of a ground that stops is subtracted: no jump of velocities relative to it.
  lose_velocity(sim, velocity_of_ground_by(sim, off.shakings));
  AsExternalWork work(sim);
  const BodyVectors before_it = off.boundaries.empty() ? BodyVectors{} : forces_now(sim);
  std::vector<WallForce> wall_forces = release_boundaries(sim, off.boundaries);
  ActiveIntervals& intervals = loads.intervals;
  set_all(intervals.boundaries, off.boundaries, on.boundaries, state.time);
  // Springs and wall forces end and begin at once. So must a traction that takes over or is taken
  // over from: counted half in this step, half of it would act twice, or not at all.
  const double before = std::nextafter(state.time, -never);
  for (const Index q : off.boundaries) {
    intervals.boundaries[static_cast<std::size_t>(q)].until = before;
  }
  for (const Index q : on.boundaries) {
    if (!off.boundaries.empty()) intervals.boundaries[static_cast<std::size_t>(q)].since = before;
  }
  std::vector<WallForce> inherited;
  for (const Index row : on.boundaries) {
    const Boundary& boundary = model.boundaries[static_cast<std::size_t>(row)];
    sim.attached.springs.engage(row, pose.x, pose.y);
    if (boundary.type == BoundaryType::stress) continue;
    if (boundary.type == BoundaryType::displacement) {
      SteppedValue& multiplier = loads.slow.boundaries[static_cast<std::size_t>(row)];
      multiplier = {multiplier.value, 0.0, state.time};
    }
    const Index owner = Owners(model).of_boundary(row);
    for (WallForce& f : wall_forces) {
      const Vec2 part = carried_by(model, sim.scene->blocks, boundary, f.vertex, f.force);
      if (part == Vec2{}) continue;
      inherited.push_back({f.vertex, part, owner});
      f.force -= part;  // where two boundaries meet, only one carries it
    }
    loads.remaining[static_cast<std::size_t>(owner)] = {1.0, 1.0, state.time};
  }
  keep(sim, inherited);
  sim.attached.dashpots.set_acting(intervals.boundaries);
  note_jump(sim, before_it);
  set_all(intervals.loads, off.loads, on.loads, state.time);
  set_all(intervals.waters, off.waters, on.waters, state.time);
  set_all(intervals.shakings, off.shakings, on.shakings, state.time);
  const bool shakes = std::any_of(intervals.shakings.begin(), intervals.shakings.end(),
                                  [](const ActiveInterval& interval) { return interval.acts(); });
  work.end();
  if (!shakes) lose_velocity(sim, sim.attached.ground.velocity);
}

void glue_joints(Simulation& sim, bool glued) {
  if (glued == sim.motion.contacts.gluing) return;
  const BodyVectors before = forces_now(sim);
  change_faces(sim, [&](FaceSet& faces, const FaceStates& states) {
    if (glued) {
      glue_faces(faces, states);
    } else {
      unglue_faces(faces, sim.scene->blocks, sim.motion.pose);
    }
  });
  reevaluate_faces(sim);
  note_jump(sim, before);
}

}  // namespace edda
