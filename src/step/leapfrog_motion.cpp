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
    const NodeVectors change = vectors_of(s.vx, s.vy, i) - vectors_of(leap.old_vx, leap.old_vy, i);
    double square = mass_product(leap.masses, i, change, change);
    const BlockModes modes = b.modes(i);
    for (std::size_t a = 0; a < modes.count; ++a) {
      const Vec2 of_mode = s.bend_rate[modes[a]] - (*leap.old_rate)[modes[a]];
      square += dot(of_mode, of_mode) / leap.masses.mode_inverse[i];
    }
    return square;
  });
  return twice * (leap.h_old - leap.h_new) / (2.0 * (leap.h_old + leap.h_new));
}

StepDamping step_damping(const Simulation& sim, double h, StrainDamping& strain,
                         BlockKicks& kicks) {
  const std::vector<Id>& damped = sim.attached.dashpots.damped;
  const Masses& masses = sim.motion.masses;
  StepDamping damping{mass_damping(sim), sim.motion.damping.local,
                      damped.empty() ? nullptr : &damped,
                      masses.viscosity.empty() ? nullptr : &strain};
  if (sim.motion.damping.adaptive > 0.0) {
    mass_damping_of_blocks(sim, kicks.mass);
    set_kicks(kicks, h);
    damping.kicks = &kicks;
    if (damping.strain) prepare(strain, sim.scene->blocks, masses, kicks.h);
  } else if (damping.strain)
    prepare(strain, sim.scene->blocks, masses, h / (1.0 + 0.5 * damping.mass * h));
  return damping;
}

Leap leap_of(const Simulation& sim, double h_old, double h_new) {
  const NodalForces& forces = sim.motion.forces;
  const LeapfrogStep& own = sim.leapfrog;
  const bool bend = sim.scene->blocks.bending.any();
  return {sim.scene->blocks,
          sim.motion.masses,
          forces.x,
          forces.y,
          own.old_vx,
          own.old_vy,
          h_old,
          h_new,
          own.damps,
          bend ? &forces.modes : nullptr,
          bend ? &own.old_rate : nullptr};
}

ModeDamping* mode_damping_of(const Simulation& sim, ModeDamping& damping) {
  const Masses& masses = sim.motion.masses;
  if (masses.mode_damping[0].empty()) {
    damping = {};
    return nullptr;
  }
  if (damping.couple.empty()) {
    damping.force.assign(sim.scene->blocks.bending.modes(), 0.0);
    damping.couple.assign(sim.scene->blocks.size(), 0.0);
  }
  return &damping;
}

bool move(Simulation& sim, double h_old, double h_new, const LoadsNow* not_yet_gathered) {
  const BlockSet& blocks = sim.scene->blocks;
  const Dashpots& dashpots = sim.attached.dashpots;
  State& state = sim.motion.state;
  Pose& pose = sim.motion.pose;
  NodalForces& forces = sim.motion.forces;
  LeapfrogStep& own = sim.leapfrog;
  drive_ground(sim, h_old, h_new);
  if (not_yet_gathered == nullptr) remove_dashpots(forces, sim.motion.on_dashpots, dashpots);
  const double h = 0.5 * (h_old + h_new);
  own.damps = step_damping(sim, h, own.strain_damping, own.kicks);
  const DashpotStep dashpot_step{h, 0.5 * own.damps.mass * h,
                                 own.damps.kicks ? &own.kicks.mass : nullptr, own.drive.reference,
                                 own.drive.push};
  const Leap leap = leap_of(sim, h_old, h_new);
  const DashpotScene before{blocks, sim.motion.masses, state, own.old_vx, own.old_vy};
  const BoundarySprings& springs = sim.attached.springs;
  const Vec2 gravity = sim.scene->model.gravity;
  const ForcesToAdd to_add{sim.motion.on_contacts.x, sim.motion.on_contacts.y, forces.x, forces.y};
  const bool bend = blocks.bending.any();
  ModeDamping* const of_modes = bend ? mode_damping_of(sim, own.mode_damping) : nullptr;
  own.largest.assign(blocks.size() / fewest_at_once + 1, 0.0);
  parallel_blocks(blocks.size(), 40, [&](std::size_t c, std::size_t begin, std::size_t end) {
    const LoadsNow* const loads = not_yet_gathered;
    if (loads != nullptr)
      gather_own_forces(forces, blocks, state, pose, springs, gravity, *loads, sim.motion.locked,
                        begin, end);
    if (bend && loads != nullptr)
      add_to_modes(blocks, sim.motion.on_contacts.modes, forces.modes, begin, end);
    if (bend && loads == nullptr)
      take_back_couples(own.mode_damping, blocks, state, forces.x, forces.y, begin, end);
    if (bend) advance_modes(state, leap, of_modes, forces.x, forces.y, begin, end);
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
