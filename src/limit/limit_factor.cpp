#include "limit/limit_factor.hpp"

#include <algorithm>
#include <cmath>

namespace edda {

StrengthFactor strength_factor(LimitProblem problem, const std::vector<char>& divided,
                               const std::function<std::vector<RigidStrength>(double)>& strength_at,
                               double tolerance, double first) {
  constexpr double nothing = 1e-7;  // of a mean weight: an equilibrium
  constexpr double most = 1e4, least = 1e-4;
  constexpr int most_programs = 200;
  StrengthFactor found;
  std::vector<RigidMotion> mechanism;
  double factor = first;
  double upwards = 0.0;  // last step from a factor that holds towards one that fails
  // Newton's step from `fails` ends near the limit. If that is not just above, it is looked for
  // eight times as far away, halfway at most.
  const auto above_holds = [&] {
    upwards = upwards > 0.0 ? 8.0 * upwards : 0.6 * tolerance * factor;
    return found.holds + std::min(upwards, 0.5 * (found.fails - found.holds));
  };
  for (int n = 0; n < most_programs; ++n) {
    problem.strength = strength_at(factor);
    Shortfall s = shortfall(problem, divided);
    if (!s.solved) return found;
    if (s.force <= nothing) {
      found.holds = factor;
      found.state = std::move(s.state);
      if (found.fails == 0.0 && factor >= most) {
        found.end = LimitEnd::no_limit;
        return found;
      }
      if (found.fails == 0.0) {
        factor *= n == 0 ? 1.01 : n == 1 ? 1.1 : 2.0;
      } else {
        factor = above_holds();
      }
    } else {
      found.fails = factor;
      mechanism = s.state.motion;
      upwards = 0.0;
      double next = s.strength > 0.0 ? factor / (1.0 + s.force / s.strength) : 0.0;
      // Where it has come near, the next step goes to where there is an equilibrium.
      if (factor - next < 0.5 * tolerance * factor) next = factor * (1.0 - 0.6 * tolerance);
      if (!(next > 0.1 * factor)) {
        factor = 0.5 * (found.holds + factor);
      } else {
        factor = next > found.holds ? next : above_holds();
      }
      if (factor < least) {
        found.end = LimitEnd::no_equilibrium;
        found.state.motion = std::move(mechanism);
        return found;
      }
    }
    if (found.fails > 0.0 && found.fails - found.holds <= tolerance * found.fails) {
      found.end = LimitEnd::found;
      break;
    }
  }
  found.state.motion = std::move(mechanism);
  return found;
}

LimitState tilt_limit(LimitProblem problem, bool largest,
                      const std::function<RigidForces(double)>& dead_at,
                      const std::function<RigidForces(double)>& turning_at) {
  constexpr double near = 1e-10;  // rad
  constexpr int most_programs = 50;
  double angle = 0.0;
  LimitState state;
  for (int n = 0; n < most_programs; ++n) {
    problem.dead = dead_at(angle);
    problem.live = turning_at(angle);
    state = limit_state(problem, largest);
    if (state.end != LimitEnd::found) return state;
    const double change = std::atan(state.multiplier);
    angle += change;
    if (std::abs(change) < near) break;
  }
  state.kinematic = angle + (state.kinematic - state.multiplier);
  state.multiplier = angle;
  return state;
}

std::vector<RigidStrength> without_dilation(const RigidBlocks& rigid,
                                            std::vector<RigidStrength> given,
                                            const std::vector<RigidJointForce>& before,
                                            double kept) {
  for (std::size_t k = 0; k < given.size(); ++k) {
    const double ends = rigid.joints[k].is_corner() ? 1.0 : 2.0;
    const double whole = std::max(before[k].whole(), -ends * given[k].tension);
    given[k].shear += (1.0 - kept) * given[k].friction * whole;
    given[k].friction *= kept;
  }
  return given;
}

}  // namespace edda
