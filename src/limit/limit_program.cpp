#include "limit/limit_program.hpp"

#include <algorithm>
#include <cmath>

#include "limit/force_program.hpp"

namespace edda {
namespace {

/// Largest velocity of an end of a joint or of a centroid.
double fastest(const RigidBlocks& rigid, const std::vector<RigidMotion>& motion) {
  double most = 0.0;
  for (const RigidJoint& joint : rigid.joints) {
    for (const Vec2 end : joint.ends) {
      for (const Id block : {joint.block_a, joint.block_b})
        most = std::max(most, norm(velocity_of(rigid, motion, block, end)));
    }
  }
  for (const RigidMotion& m : motion) most = std::max(most, norm(m.velocity));
  return most;
}

/// With the velocity 1 of the fastest point, in this direction; empty where nothing moves.
std::vector<RigidMotion> unit_motion(const RigidBlocks& rigid, std::vector<RigidMotion> motion,
                                     double sign) {
  const double most = fastest(rigid, motion);
  if (!(most > 0.0)) return {};
  for (RigidMotion& m : motion) m = {(sign / most) * m.velocity, sign * m.spin / most};
  return motion;
}

double work_of(const RigidForces& forces, const std::vector<RigidMotion>& motion) {
  double work = 0.0;
  for (std::size_t r = 0; r < forces.size(); ++r)
    work += dot(forces[r].force, motion[r].velocity) + forces[r].moment * motion[r].spin;
  return work;
}

double weights_times_speeds(const RigidBlocks& rigid, const std::vector<RigidMotion>& motion) {
  double sum = 0.0;
  for (std::size_t r = 0; r < motion.size(); ++r)
    sum +=
        rigid.weight[r] * (norm(motion[r].velocity) + rigid.extent[r] * std::abs(motion[r].spin));
  return sum;
}

/// The kinematic theorem: prices of the rows, scaled so that the live load does the work 1, are a
/// mechanism, and no multiplier is larger than the one at which its loads do the work that its
/// joints dissipate.
void judge_mechanism(const LimitProblem& p, const ForceProgram& forces, bool largest,
                     const std::vector<double>& price, LimitState& state) {
  const std::vector<RigidMotion> motion = forces.motion(price, 1.0);
  const double work = work_of(p.live, motion);
  if (work == 0.0) return;
  std::vector<double> scaled = price;
  for (double& y : scaled) y *= (largest ? 1.0 : -1.0) / work;
  const DualBound bound = dual_bound(forces.program, scaled, forces.unit);
  state.kinematic = largest ? bound.value : -bound.value;
  state.violation = bound.violation * std::abs(work) / fastest(*p.rigid, motion);
  state.motion = unit_motion(*p.rigid, motion, (largest ? 1.0 : -1.0) * work > 0.0 ? 1.0 : -1.0);
}

/// Where the limit of compression is exceeded: a tangent there. Keeps the list sorted by joint.
bool add_tangents(const LimitProblem& p, const std::vector<RigidJointForce>& forces,
                  std::vector<CompressionTangent>& tangents) {
  constexpr double exceeded = 1e-7;  // of f L
  const std::size_t before = tangents.size();
  for (std::size_t k = 0; k < forces.size(); ++k) {
    const double most = p.strength[k].compression, whole = forces[k].whole();
    if (most == 0.0) continue;
    const double least = std::min(forces[k].normal[0], forces[k].normal[1]);
    if (whole > 0.0 && 0.5 * whole * whole / most - least > exceeded * most)
      tangents.push_back({k, std::min(whole, most)});
  }
  std::stable_sort(tangents.begin(), tangents.end(),
                   [](const auto& a, const auto& b) { return a.joint < b.joint; });
  return tangents.size() > before;
}

/// Solves the program that `complete` has made whole, with as many tangents as it takes; ended is
/// called with the last one.
template <class Complete, class Ended>
void solve_with_tangents(const LimitProblem& p, ForceProgram::Asks asks, Complete complete,
                         Ended ended) {
  std::vector<CompressionTangent> tangents;
  constexpr int most_rounds = 50;
  for (int round = 0;; ++round) {
    ForceProgram builder(p, tangents, asks);
    complete(builder);
    const LinearAnswer answer = solve(builder.program, p.watch);
    std::vector<RigidJointForce> forces;
    if (answer.end == LinearEnd::optimal) forces = builder.forces(answer.value);
    // Without a limit no strength was reached, or there are tangents yet to come.
    if (answer.end == LinearEnd::unbounded && tangents.empty()) {
      for (std::size_t k = 0; k < p.strength.size(); ++k) {
        const double most = p.strength[k].compression;
        if (most > 0.0) tangents.push_back({k, most});
      }
      if (!tangents.empty()) continue;
    }
    if (round < most_rounds && !forces.empty() && add_tangents(p, forces, tangents)) continue;
    return ended(builder, answer, std::move(forces));
  }
}

/// Strength that a mechanism mobilises: shear of slipping joints and tension of opening ones, those
/// of `divided` joints.
double mobilised(const LimitProblem& p, const std::vector<char>& divided,
                 const std::vector<RigidJointForce>& forces,
                 const std::vector<RigidMotion>& motion) {
  double work = 0.0;
  for (std::size_t k = 0; k < forces.size(); ++k) {
    const RigidJoint& joint = p.rigid->joints[k];
    if (divided[k] == 0) continue;
    const auto apart = [&](std::size_t end) {
      return velocity_of(*p.rigid, motion, joint.block_b, joint.ends[end]) -
             velocity_of(*p.rigid, motion, joint.block_a, joint.ends[end]);
    };
    work += std::abs(forces[k].shear * dot(apart(0), joint.t));
    for (std::size_t end = 0; end < ends_of(joint); ++end)
      work += p.strength[k].tension * positive_part(dot(apart(end), joint.n));
  }
  return work;
}

}  // namespace

Vec2 velocity_of(const RigidBlocks& rigid, const std::vector<RigidMotion>& motion, Id block,
                 Vec2 place) {
  const Id r = rigid.body[block];
  return r == no_id ? Vec2{} : velocity_at(motion[r], rigid.centroid[r], place);
}

LimitState limit_state(const LimitProblem& p, bool largest) {
  LimitState state;
  std::size_t multiplier = 0;
  const auto complete = [&](ForceProgram& builder) {
    multiplier = builder.add_asked(largest ? 1.0 : -1.0);
  };
  solve_with_tangents(p, ForceProgram::Asks::multiplier, complete,
                      [&](const ForceProgram& builder, const LinearAnswer& answer,
                          std::vector<RigidJointForce> forces) {
                        switch (answer.end) {
                          case LinearEnd::optimal:
                            state.end = LimitEnd::found;
                            state.multiplier = answer.value[multiplier];
                            state.forces = std::move(forces);
                            state.ties = builder.ties(answer.value);
                            judge_mechanism(p, builder, largest, answer.price, state);
                            return;
                          case LinearEnd::infeasible: {
                            const std::vector<RigidMotion> motion =
                                builder.motion(answer.price, 1.0);
                            state.end = LimitEnd::no_equilibrium;
                            state.motion = unit_motion(*p.rigid, motion,
                                                       work_of(p.dead, motion) > 0.0 ? 1.0 : -1.0);
                            return;
                          }
                          case LinearEnd::unbounded:
                            state.end = LimitEnd::no_limit;
                            return;
                          case LinearEnd::failed:
                            state.end = LimitEnd::not_solved;
                            return;
                        }
                      });
  return state;
}

Shortfall shortfall(const LimitProblem& p, const std::vector<char>& divided) {
  Shortfall s;
  const auto complete = [](ForceProgram& builder) { builder.add_asked(-1.0); };
  solve_with_tangents(
      p, ForceProgram::Asks::tension, complete,
      [&](const ForceProgram& builder, const LinearAnswer& answer,
          std::vector<RigidJointForce> forces) {
        s.hopeless = answer.end == LinearEnd::infeasible;
        s.solved = s.hopeless || answer.end == LinearEnd::optimal;
        if (!s.solved) return;
        s.state.end = s.hopeless ? LimitEnd::no_equilibrium : LimitEnd::found;
        if (!s.hopeless) {
          s.tension = -answer.objective - builder.thrust(answer.value);
          s.state.ties = builder.ties(answer.value);
        }
        const std::vector<RigidMotion> motion = builder.motion(answer.price, 1.0);
        const double sign = work_of(p.dead, motion) > 0.0 ? 1.0 : -1.0;
        if (!s.hopeless) s.strength = mobilised(p, divided, forces, motion);
        const double net = s.hopeless ? answer.objective : s.tension;
        if (const double sum = weights_times_speeds(*p.rigid, motion); sum > 0.0)
          s.excess = std::max(0.0, net) / sum;
        const DualBound bound = dual_bound(builder.program, answer.price, builder.unit);
        s.state.violation = bound.violation / std::max(fastest(*p.rigid, motion), 1e-300);
        s.state.motion = unit_motion(*p.rigid, motion, sign);
        s.state.forces = std::move(forces);
      });
  return s;
}

std::vector<RigidJointForce> forces_in_balance(const LimitProblem& p) {
  std::vector<RigidJointForce> found;
  solve_with_tangents(
      p, ForceProgram::Asks::neither, [](const ForceProgram&) {},
      [&](const ForceProgram&, const LinearAnswer& answer, std::vector<RigidJointForce> forces) {
        if (answer.end == LinearEnd::optimal) found = std::move(forces);
      });
  return found;
}

}  // namespace edda
