// Models for rigid limit analysis.
#pragma once

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <string>

#include "limit/joint_strength.hpp"
#include "limit/limit_factor.hpp"
#include "run/prepared.hpp"

namespace edda::testing {

inline std::string stone(double mu, const std::string& more = "") {
  return fmt::format(
      "[materials.stone]\ndensity = 2000\nyoung = 50e9\npoisson = 0.2\n[solver]\nduration = 1\n"
      "[joints.dry]\nfriction_angle = {:.15g}\n{}",
      std::atan(mu) * 180.0 / std::numbers::pi, more);
}
inline const std::string table =
    "[[block]]\nfixed = true\npolygon = [[-5,-1],[5,-1],[5,0],[-5,0]]\n";

/// A model, its bodies, and its weight as dead load.
struct Rigid {
  explicit Rigid(const std::string& text, bool crushing = false)
      : ready(prepared(text)), blocks(rigid_blocks(sim())), with_crushing(crushing) {
    problem.rigid = &blocks;
    problem.strength = strength(1.0);
    problem.dead =
        weights_under(blocks, sim(), gravity()) + loads_with(blocks, sim(), last_factors(sim()));
  }
  const Simulation& sim() const { return ready.sim; }
  Vec2 gravity() const { return sim().scene->model.gravity; }
  std::vector<RigidStrength> strength(double factor, StrengthOf which = StrengthOf::peak) const {
    const std::vector<double> divided_by(sim().motion.laws.rows.size(), factor);
    return joint_strengths(blocks, sim().motion.laws, divided_by, which, with_crushing);
  }
  /// The seismic coefficient to the right, or to the left.
  LimitState kh(bool right = true) {
    problem.live = weights_under(blocks, sim(), perp(gravity()));
    return limit_state(problem, right);
  }
  StrengthFactor factor_of_strength() {
    const std::vector<char> all(blocks.joints.size(), 1);
    return strength_factor(
        problem, all, [&](double f) { return strength(f); }, 1e-6);
  }
  /// Largest force by which a body is out of equilibrium under dead + by live, N.
  double out_of_balance(const LimitState& state, double by) const {
    RigidForces sum = problem.dead + by * problem.live;
    const auto add = [&](Id block, Vec2 place, Vec2 force) {
      const Id r = blocks.body[block];
      if (r == no_id) return;
      sum[r].force += force;
      sum[r].moment += cross(place - blocks.centroid[r], force);
    };
    for (std::size_t k = 0; k < blocks.joints.size(); ++k) {
      const RigidJoint& joint = blocks.joints[k];
      for (std::size_t end = 0; end < 2; ++end) {
        const Vec2 force = state.forces[k].normal[end] * joint.n +
                           (end == 0 ? state.forces[k].shear : 0.0) * joint.t;
        add(joint.block_b, joint.ends[end], force);
        add(joint.block_a, joint.ends[end], -force);
      }
    }
    for (std::size_t q = 0; q < state.ties.size(); ++q) {
      const RigidTie& tie = blocks.ties[q];
      add(tie.block_a, tie.place_a, state.ties[q] * tie.direction);
      add(tie.block_b, tie.place_b, -state.ties[q] * tie.direction);
    }
    double most = 0.0;
    for (const RigidForce& f : sum)
      most = std::max({most, norm(f.force), std::abs(f.moment) / blocks.size});
    return most;
  }

  PreparedRun ready;
  RigidBlocks blocks;
  bool with_crushing;
  LimitProblem problem;
};

}  // namespace edda::testing
