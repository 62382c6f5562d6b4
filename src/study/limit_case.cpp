#include "study/limit_case.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "contacts/laws.hpp"

namespace edda {
namespace {

constexpr double degrees = 180.0 / std::numbers::pi;
constexpr double strength_tolerance = 1e-6;

}  // namespace

LimitCase::LimitCase(const Simulation& sim, const Fos& fos, bool crushing,
                     const ProgramWatch* watch, BoltForces bolts)
    : sim_(sim), fos_(fos), crushing_(crushing), watch_(watch), rigid_(rigid_blocks(sim, bolts)) {}

LimitCase LimitCase::carrying(const std::vector<Id>& blocks) const {
  LimitCase other = *this;
  other.rigid_ = edda::carrying(rigid_, blocks);
  return other;
}

LimitProblem LimitCase::problem() const {
  LimitProblem p;
  p.rigid = &rigid_;
  p.watch = watch_;
  return p;
}

bool LimitCase::is_spared(std::size_t law) const {
  const std::vector<JointLaw>& joints = sim_.scene->model.joints;
  return law < joints.size() && std::find(fos_.exclude.begin(), fos_.exclude.end(),
                                          joints[law].name) != fos_.exclude.end();
}

std::vector<RigidStrength> LimitCase::strength_at(double factor, StrengthOf which,
                                                  const std::vector<RigidJointForce>& last) const {
  const LawTable laws = build_laws(sim_.scene->model, sim_.motion.laws.progress);
  std::vector<double> divided_by = sim_.motion.laws.divided_by;  // by the stage
  for (std::size_t r = 0; r < divided_by.size(); ++r) {
    if (!is_spared(r)) divided_by[r] *= factor;
  }
  return joint_strengths(rigid_, laws, divided_by, which, crushing_, last);
}

Vec2 LimitCase::gravity_with(double value) const {
  SlowLoading slow = sim_.attached.loads.slow;
  if (SteppedValue* const varied = slow_value(slow, fos_.varied, fos_.target))
    *varied = {value, value};
  return last_gravity(sim_, slow);
}

double* LimitCase::factor_of_varied(LoadFactors& factors) const {
  const auto q = static_cast<std::size_t>(std::max(fos_.target, 0));
  switch (fos_.varied) {
    case Varied::load:
      return q < factors.loads.size() ? &factors.loads[q] : nullptr;
    case Varied::boundary:
      return &factors.loads[sim_.scene->model.loads.size() + q];
    case Varied::water:
      return q < factors.waters.size() ? &factors.waters[q] : nullptr;
    default:
      return nullptr;
  }
}

/// Everything that acts but what is varied.
RigidForces LimitCase::dead_loads() const {
  LoadFactors factors = last_factors(sim_);
  if (double* const varied = factor_of_varied(factors)) *varied = 0.0;
  return weights_under(rigid_, sim_, gravity_with(0.0)) + loads_with(rigid_, sim_, factors);
}

/// What the multiplier acts on.
RigidForces LimitCase::live() const {
  LoadFactors given = last_factors(sim_);
  LoadFactors factors{std::vector<double>(given.loads.size(), 0.0),
                      std::vector<double>(given.waters.size(), 0.0)};
  if (double* const varied = factor_of_varied(factors)) {
    const double own = *factor_of_varied(given);
    *varied = own == 0.0 ? 1.0 : own;  // 0: not active yet
  }
  // Gravity is linear in the seismic coefficients and in its multiplier.
  return weights_under(rigid_, sim_, gravity_with(1.0) - gravity_with(0.0)) +
         loads_with(rigid_, sim_, factors);
}

RigidForces LimitCase::dead_at(double angle) const {
  return weights_under(rigid_, sim_, gravity_with(degrees * angle)) +
         loads_with(rigid_, sim_, last_factors(sim_));
}
RigidForces LimitCase::turning_at(double angle) const {
  const double way = fos_.target == backwards ? -1.0 : 1.0;
  return weights_under(rigid_, sim_, way * perp(gravity_with(degrees * angle)));
}

LimitCase::Answer LimitCase::solve(bool largest, const StrengthAt& strength_at, double near,
                                   double thrust_cost) const {
  LimitProblem problem = this->problem();
  problem.thrust_cost = thrust_cost;
  if (fos_.varied == Varied::strength) {
    problem.dead = dead_loads();
    std::vector<char> divided;
    for (const RigidJoint& joint : rigid_.joints) divided.push_back(is_spared(joint.law) ? 0 : 1);
    StrengthFactor found = strength_factor(problem, divided, strength_at, strength_tolerance, near);
    return {found.end, found.holds, found.fails, std::move(found.state)};
  }
  problem.strength = strength_at(1.0);
  if (fos_.varied == Varied::tilt) {
    LimitState state = tilt_limit(
        problem, largest, [&](double angle) { return dead_at(angle); },
        [&](double angle) { return turning_at(angle); });
    return {state.end, degrees * state.multiplier, degrees * state.kinematic, std::move(state)};
  }
  problem.dead = dead_loads();
  problem.live = live();
  LimitState state = limit_state(problem, largest);
  // Where nothing but the live load acts a multiplier of 0 has an equilibrium, and may be the only
  // one.
  constexpr double rounding = 1e-9;
  const auto rounded = [](double m) { return std::abs(m) < rounding ? 0.0 : m; };
  return {state.end, rounded(state.multiplier), rounded(state.kinematic), std::move(state)};
}

LimitCase::Answer LimitCase::at_end(bool largest, StrengthOf which) const {
  constexpr int most_rounds = 20;
  constexpr double close = 1e-5;
  Answer answer = solve(largest, [&](double factor) { return strength_at(factor, which, {}); });
  const bool again = depends_on_stress(rigid_, sim_.motion.laws);
  for (int round = 0; again && round < most_rounds && answer.end == LimitEnd::found; ++round) {
    const std::vector<RigidJointForce> last = answer.state.forces;
    const double before = answer.lower;
    answer = solve(
        largest, [&](double factor) { return strength_at(factor, which, last); }, before);
    if (std::abs(answer.lower - before) <= close * std::abs(before)) break;
  }
  return answer;
}

std::vector<RigidJointForce> LimitCase::least_thrust(const Answer& associated) const {
  constexpr double cost = 1e-2, safely = 0.99;
  LimitProblem problem = this->problem();
  problem.thrust_cost = cost / static_cast<double>(rigid_.joints.size());
  const bool strength = fos_.varied == Varied::strength;
  problem.strength =
      strength_at(strength ? std::min(1.0, safely * associated.lower) : 1.0, StrengthOf::peak, {});
  problem.dead = fos_.varied == Varied::tilt ? dead_at(0.0) : dead_loads();
  return forces_in_balance(problem);
}

std::optional<double> LimitCase::without_dilation(const Answer& associated) const {
  if (associated.end != LimitEnd::found) return {};
  const std::optional<double> one = without_dilation_from(associated.state.forces, associated, 0.0);
  std::vector<RigidJointForce> thrust = least_thrust(associated);
  if (thrust.empty()) return one;
  const double cost = 1e-5 / static_cast<double>(rigid_.joints.size());
  const std::optional<double> other = without_dilation_from(std::move(thrust), associated, cost);
  return one && other ? std::min(*one, *other) : one ? one : other;
}

LimitCase::Answer LimitCase::as_multiplier(std::vector<RigidStrength> strength, double factor,
                                           double thrust_cost) const {
  LimitProblem problem = this->problem();
  problem.thrust_cost = thrust_cost;
  problem.live = dead_loads();
  problem.dead = RigidForces(problem.live.size());
  for (RigidStrength& s : strength) {
    s.shear *= factor;
    s.tension *= factor;
    s.compression *= factor;
  }
  problem.strength = std::move(strength);
  LimitState state = limit_state(problem, true);
  for (RigidJointForce& f : state.forces) {
    for (double& normal : f.normal) normal /= state.multiplier;
    f.shear /= state.multiplier;
  }
  return {state.end, state.multiplier, state.kinematic, std::move(state)};
}

std::optional<double> LimitCase::without_dilation_from(std::vector<RigidJointForce> reference,
                                                       const Answer& associated,
                                                       double thrust_cost) const {
  constexpr double close = 1e-4, about = 1e-2;
  constexpr int most_rounds = 60;
  // With a thrust that costs something, no more than that must be gained by dilation.
  const double kept = thrust_cost > 0.0 ? 1e-2 * thrust_cost : 1e-3;
  const std::vector<RigidJointForce> stress = associated.state.forces;
  std::vector<double> values{associated.lower};
  // Part of the new forces that the next program goes by; less where programs alternate. A value
  // changes in proportion to it.
  constexpr double first_part = 0.5, most_part = 1.0, least_part = 0.1;
  double part = first_part, last_change = 0.0;
  for (int round = 0; round < most_rounds; ++round) {
    const auto given = [&](double factor) {
      return edda::without_dilation(rigid_, strength_at(factor, StrengthOf::peak, stress),
                                    reference, kept);
    };
    const Answer answer = fos_.varied == Varied::strength
                              ? as_multiplier(given(values.back()), values.back(), thrust_cost)
                              : solve(true, given, values.back(), thrust_cost);
    if (answer.end != LimitEnd::found) return {};
    const double change = answer.lower - values.back();
    values.push_back(answer.lower);
    if (std::abs(change) <= close * part / first_part * std::abs(answer.lower))
      return std::min(answer.lower, associated.lower);
    part = change * last_change < 0.0 ? std::max(least_part, 0.7 * part)
                                      : std::min(most_part, 1.3 * part);
    last_change = change;
    for (std::size_t k = 0; k < reference.size(); ++k) {
      for (std::size_t end = 0; end < 2; ++end) {
        double& normal = reference[k].normal[end];
        normal += part * (answer.state.forces[k].normal[end] - normal);
      }
    }
  }
  // Programs may alternate between two mechanisms.
  const auto [least, most] = std::minmax_element(values.end() - 4, values.end());
  if (*most - *least > about * part / first_part * std::abs(*most)) return {};
  return std::min(*least, associated.lower);
}

std::vector<RigidStrength> LimitCase::strength_of(const Answer& answer) const {
  const bool strength = fos_.varied == Varied::strength && answer.end == LimitEnd::found;
  return strength_at(strength ? answer.lower : 1.0, StrengthOf::peak, answer.state.forces);
}

bool LimitCase::is_brittle() const {
  const LawTable laws = build_laws(sim_.scene->model, sim_.motion.laws.progress);
  return std::any_of(rigid_.joints.begin(), rigid_.joints.end(), [&](const RigidJoint& joint) {
    const Law& law = laws.rows[joint.law];
    return joint.has_peak && !law.glued &&
           (law.residual_friction < law.peak_friction ||
            law.residual_cohesion < law.peak_cohesion || law.residual_tension < law.peak_tension);
  });
}

}  // namespace edda
