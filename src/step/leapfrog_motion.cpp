#include "step/leapfrog_motion.hpp"

#include <algorithm>
#include <cmath>

#include "base/parallel.hpp"
#include "forces/dashpot_forces.hpp"

namespace edda {

double energy_of_step_change(const State& s, const Leap& leap) {
  const BlockSet& b = leap.blocks;
  const double twice = ordered_sum(b.size(), [&](std::size_t i) {
    if (!is_free(b, s, i)) return 0.0;
    const BodyVector change = vector_of(b, s.velocity, i) - vector_of(b, leap.old_velocity, i);
    return mass_product(leap.masses, b, i, change, change);
  });
  return twice * (leap.h_old - leap.h_new) / (2.0 * (leap.h_old + leap.h_new));
}

void prepare_damping(const Simulation& sim, double h, DampingOfStep& d) {
  const std::vector<Id>& damped = sim.attached.dashpots.damped;
  const BlockSet& blocks = sim.scene->blocks;
  const Masses& masses = sim.motion.masses;
  d.in_force = {mass_damping(sim), sim.motion.damping.local, damped.empty() ? nullptr : &damped,
                masses.viscosity.empty() ? nullptr : &d.strain};
  if (sim.motion.damping.adaptive > 0.0 || !masses.decay.empty()) {
    mass_damping_of_blocks(sim, d.kicks.mass);
    set_kicks(d.kicks, h);
    d.in_force.kicks = &d.kicks;
    if (d.in_force.strain) prepare(d.strain, blocks, masses, d.kicks.h);
  } else if (d.in_force.strain) {
    prepare(d.strain, blocks, masses, h / (1.0 + 0.5 * d.in_force.mass * h));
  }
  if (masses.mode_damping[0].empty()) {
    d.modes = {};
    return;
  }
  d.in_force.modes = &d.modes;
  if (!d.modes.couple.empty()) return;
  d.modes.force.assign(blocks.mode_places(), 0.0);
  d.modes.couple.assign(blocks.size(), 0.0);
}

Leap leap_of(const Simulation& sim, double h_old, double h_new) {
  const LeapfrogStep& own = sim.leapfrog;
  return {sim.scene->blocks,   sim.motion.masses, sim.motion.forces, own.old_velocity, h_old, h_new,
          own.damping.in_force};
}

bool move(Simulation& sim, double h_old, double h_new, const LoadsNow* not_yet_gathered) {
  const BlockSet& blocks = sim.scene->blocks;
  const Dashpots& dashpots = sim.attached.dashpots;
  State& state = sim.motion.state;
  Pose& pose = sim.motion.pose;
  BodyVectors& forces = sim.motion.forces;
  LeapfrogStep& own = sim.leapfrog;
  drive_ground(sim, h_old, h_new);
  if (not_yet_gathered == nullptr) {
    remove_dashpots(forces, sim.motion.on_dashpots, dashpots, blocks);
  }
  const double h = 0.5 * (h_old + h_new);
  prepare_damping(sim, h, own.damping);
  const StepDamping& damping = own.damping.in_force;
  const DashpotStep dashpot_step{h, 0.5 * damping.mass * h,
                                 damping.kicks ? &damping.kicks->mass : nullptr,
                                 own.drive.reference, own.drive.push};
  const Leap leap = leap_of(sim, h_old, h_new);
  const DashpotScene before{blocks, sim.motion.masses, state, own.old_velocity};
  const BoundarySprings& springs = sim.attached.springs;
  const Vec2 gravity = sim.scene->model.gravity;
  const ForcesToAdd to_add{sim.motion.on_contacts, forces};
  own.largest.assign(blocks.size() / fewest_at_once + 1, 0.0);
  parallel_blocks(blocks.size(), 40, [&](std::size_t c, std::size_t begin, std::size_t end) {
    const LoadsNow* const loads = not_yet_gathered;
    if (loads != nullptr) {
      gather_own_forces(forces, blocks, state, pose, springs, gravity, *loads, rock_of(sim), begin,
                        end);
      add_to_modes(blocks, to_add, begin, end);
    } else {
      take_back_couples(own.damping.modes, blocks, state, forces, begin, end);
    }
    if (blocks.meshes.any())
      add_mesh_dashpots(forces, sim.motion.on_dashpots, dashpots, before, dashpot_step,
                        loads != nullptr ? &sim.motion.on_contacts : nullptr, begin, end);
    advance_modes(state, leap, forces, begin, end);
    if (loads != nullptr && dashpots.points.empty()) {
      add_and_advance(state, leap, to_add, begin, end);
    } else {
      if (loads != nullptr) add_to_free(blocks, state, to_add, begin, end);
      add_dashpots(forces, sim.motion.on_dashpots, dashpots, before, dashpot_step, begin, end);
      advance(state, leap, begin, end);
    }
    own.largest[c] = place_next(blocks, state, pose, begin, end);
  });
  std::swap(pose.x, pose.x1);
  std::swap(pose.y, pose.y1);
  sim.control.last_displacement =
      std::sqrt(*std::max_element(own.largest.begin(), own.largest.end()));
  return sim.control.last_displacement <= sim.scene->displacement_limit;
}

}  // namespace edda
