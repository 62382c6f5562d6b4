#include "limit/limit_factor.hpp"

#include <algorithm>
#include <cmath>

namespace edda {

namespace {

/// The search for the factor at which the tension that joints need is 0.
class FactorSearch {
 public:
  FactorSearch(double first, double tolerance) : factor(first), tolerance_(tolerance) {}

  double factor;
  double holds = 0.0, fails = 0.0;  ///< 0: not known yet

  bool has_ended() const { return fails > 0.0 && fails - holds <= tolerance_ * fails; }

  /// Newton's step from what was found at `factor`; where it ends near, it goes on to the other
  /// side of what it found. Upwards from a factor that holds, never out of what is known, and no
  /// more than eightfold at once.
  void take(const Shortfall& s) {
    (s.holds() ? holds : fails) = factor;
    constexpr double most = 8.0, flat = 1e-6;  // where no strength counts
    double next = s.strength > flat ? factor * (1.0 - s.tension / s.strength)
                                    : factor * (s.holds() ? most : 1.0 / most);
    if (std::abs(next - factor) < 0.5 * tolerance_ * factor)
      next = factor * (1.0 + (s.holds() ? 0.6 : -0.6) * tolerance_);
    next = std::clamp(next, factor / most, most * factor);
    if (holds > 0.0 && fails > 0.0 && !(next > holds && next < fails)) next = between();
    factor = next;
  }

 private:
  /// Near the end that was found last, further away each time that this does not find the other.
  double between() {
    away_ = away_ > 0.0 ? 8.0 * away_ : 0.6 * tolerance_ * factor;
    const double step = std::min(away_, 0.5 * (fails - holds));
    return factor == holds ? holds + step : fails - step;
  }

  double tolerance_, away_ = 0.0;
};

}  // namespace

StrengthFactor strength_factor(LimitProblem problem, const std::vector<char>& divided,
                               const std::function<std::vector<RigidStrength>(double)>& strength_at,
                               double tolerance, double first) {
  constexpr double most = 1e4, least = 1e-4;
  constexpr int most_programs = 100;
  StrengthFactor found;
  std::vector<RigidMotion> mechanism;
  FactorSearch search(first, tolerance);
  for (int n = 0; n < most_programs && !search.has_ended(); ++n) {
    const double factor = search.factor;
    problem.strength = strength_at(factor);
    Shortfall s = shortfall(problem, divided);
    if (!s.solved) return found;
    if (!s.holds()) mechanism = s.state.motion;
    if (s.hopeless || (!s.holds() && factor <= least)) {
      found.end = LimitEnd::no_equilibrium;
      found.state.motion = std::move(mechanism);
      return found;
    }
    if (s.holds()) found.state = std::move(s.state);
    search.take(s);
    if (search.fails == 0.0 && factor >= most) {
      found.end = LimitEnd::no_limit;
      found.holds = factor;
      return found;
    }
  }
  found.holds = search.holds;
  found.fails = search.fails;
  if (search.has_ended()) found.end = LimitEnd::found;
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
