#include "study/certificate.hpp"

#include <algorithm>
#include <cmath>

#include "judge/rest.hpp"
#include "limit/joint_strength.hpp"
#include "step/contact_search.hpp"
#include "step/faces_now.hpp"

namespace edda {
namespace {

/// The second largest size of a free block, m: the smaller one of no two blocks is larger.
double second_largest(const Simulation& sim) {
  double first = 0.0, second = 0.0;
  for (std::size_t i = 0; i < sim.scene->blocks.size(); ++i) {
    if (!is_free(sim.scene->blocks, sim.motion.state, i)) continue;
    const double size = std::sqrt(sim.scene->blocks.area[i]);
    second = std::max(second, std::min(first, size));
    first = std::max(first, size);
  }
  return second > 0.0 ? second : first;
}

/// Joints may bear beyond their ends by what blocks overlap, as these deform.
void lengthen(RigidBlocks& rigid, const Simulation& now) {
  const FaceSet& f = now.motion.contacts;
  for (RigidJoint& joint : rigid.joints) {
    const double by = rigid_gap * smaller_size(f, now.scene->blocks, joint.face);
    joint.ends[0] -= by * joint.t;
    joint.ends[1] += by * joint.t;
  }
}

/// The present state, its list of faces as wide as blocks may move.
Simulation with_faces_within(const Simulation& sim, double distance) {
  Simulation now = sim;
  const FaceSet& faces = now.motion.contacts;
  search(now, {std::max(distance, faces.reach), faces.reach_behind});
  return now;
}

/// Of joints as they are: bonds that carry forces and are broken have their residual strength, all
/// others what is more.
std::vector<RigidStrength> strength_now(const Simulation& now, const RigidBlocks& rigid,
                                        const std::vector<double>& divided_by) {
  const LawTable laws = build_laws(now.scene->model, now.motion.laws.progress);
  std::vector<RigidStrength> all =
      joint_strengths(rigid, laws, divided_by, StrengthOf::residual, false);
  const std::vector<RigidStrength> peak =
      joint_strengths(rigid, laws, divided_by, StrengthOf::peak, false);
  const FaceSet& f = now.motion.contacts;
  for (std::size_t k = 0; k < all.size(); ++k) {
    const RigidJoint& joint = rigid.joints[k];
    const bool broken = face_row(now, joint.face).state.energy > 0.0 && !f.holds(joint.face);
    if (broken && !laws.rows[joint.law].changes) continue;
    all[k].friction = std::max(all[k].friction, peak[k].friction);
    all[k].shear = std::max(all[k].shear, peak[k].shear);
    all[k].tension = std::max(all[k].tension, peak[k].tension);
  }
  return all;
}

/// Blocks that have come loose, or that dashpots hold against forces too small to matter.
std::vector<Id> staying(const Simulation& sim) {
  std::vector<Id> stay = sim.attached.dashpots.damped;
  for (Id i = 0; i < sim.relaxation.loose.size(); ++i) {
    if (sim.relaxation.loose[i] != 0) stay.push_back(i);
  }
  return stay;
}

}  // namespace

std::optional<LimitMotion> without_equilibrium(const Simulation& sim,
                                               const std::vector<double>& divided_by,
                                               double allowed, double least_area,
                                               const ProgramWatch* watch) {
  constexpr std::size_t most_blocks = 5000;
  // The part of gravity with which a block would move by rest_part of its size in rest_time().
  constexpr double at_rest = 2.0 * rest_part / (rest_times * rest_times);
  const BlockSet& b = sim.scene->blocks;
  if (b.size() > most_blocks) return {};
  const Simulation now = with_faces_within(sim, allowed * second_largest(sim));
  RigidBlocks rigid = rigid_blocks(now, BoltForces::to_capacity, std::max(allowed, rigid_gap));
  lengthen(rigid, now);
  if (depends_on_stress(rigid, now.motion.laws)) return {};
  std::vector<Id> stay = staying(sim);
  while (true) {
    rigid = carrying(rigid, stay);
    if (rigid.bodies() == 0) return {};
    LimitProblem problem;
    problem.rigid = &rigid;
    problem.watch = watch;
    problem.strength = strength_now(now, rigid, divided_by);
    problem.dead =
        weights_under(rigid, now, last_gravity(now)) + loads_with(rigid, now, last_factors(now));
    const Shortfall found = shortfall(problem, std::vector<char>(rigid.joints.size(), 1));
    if (!found.solved || found.holds() || !(found.excess > at_rest)) return {};
    std::optional<LimitMotion> motion = limit_motion(now, rigid, found.state);
    if (!motion || motion->mechanism.blocks.empty()) return {};
    if (area_of(motion->mechanism, b) >= least_area) return motion;
    stay = blocks_of(motion->mechanism);
  }
}

}  // namespace edda
