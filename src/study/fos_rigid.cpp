#include "study/fos_rigid.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace edda {

RigidLimit rigid_limit(const Model& model, const Fos& fos, std::size_t blocks,
                       const LimitOptions& options) {
  constexpr std::size_t most_blocks = 5000;  // for which it takes a small part of the search
  if (fos.varied == Varied::shaking || blocks > most_blocks) return {};
  Result<LimitResult> found = limit_analysis(model, options);
  if (!found.ok() || found.value().interrupted) return {};
  LimitResult& limit = found.value();
  limit.drawn.reset();
  // Of joints of which the friction is larger after failure.
  const double broken = limit.residual.value_or(0.0);
  if (limit.largest.status == LimitEnd::found && broken > limit.largest.upper)
    limit.largest.lower = limit.largest.upper = broken;
  return std::move(limit);
}

Criterion criterion_at(double factor, const Criterion& usual, const RigidLimit& rigid) {
  const bool limited = rigid && rigid->largest.status == LimitEnd::found;
  const bool in_equilibrium = rigid && (limited || rigid->largest.status == LimitEnd::no_limit) &&
                              !(limited && factor > least_limit(*rigid)) &&
                              !(rigid->bolts_as_now && factor > *rigid->bolts_as_now);
  Criterion c = usual;
  if (!in_equilibrium && !usual.displacement) c.allowed = std::min(c.allowed, moved_little);
  return c;
}

FosBracket first_bracket(const Fos& fos, const RigidLimit& rigid, const std::vector<Trial>& seen) {
  const double reach = std::exp2(FosBracket::widest - 1);
  const Vec2 given = fos.bracket;
  const FosBracket usual{given.x, given.y, fos.tolerance};
  if (given != Fos{}.bracket || !rigid || rigid->largest.status != LimitEnd::found) return usual;
  const double limit = rigid->largest.lower;
  if (!(limit > 0.0) || (limit >= given.x / reach && limit <= given.y * reach)) return usual;
  const bool agrees = std::all_of(seen.begin(), seen.end(), [&](const Trial& trial) {
    return (trial.end == TrialEnd::holds) == (trial.factor < limit);
  });
  if (!agrees) return usual;
  const Vec2 moved = around(limit);
  return {moved.x, moved.y, fos.tolerance};
}

double least_limit(const LimitResult& limit) {
  const double most = limit.largest.upper;
  return std::min(
      {limit.largest.lower, limit.without_dilation.value_or(most), limit.residual.value_or(most)});
}

BesideLimits beside_limits(double factor, double least, double most) {
  constexpr double near = 0.02;
  if (factor < (1.0 - near) * least) return BesideLimits::below;
  const bool one = least >= (1.0 - near) * most && factor >= (1.0 - near) * most;
  return one ? BesideLimits::agrees : BesideLimits::between;
}

bool limits_agree(const LimitResult& limit) {
  const double most = limit.largest.upper;
  return limit.largest.status == LimitEnd::found &&
         beside_limits(most, least_limit(limit), most) == BesideLimits::agrees;
}

std::optional<double> factor_below(const FosBracket& bracket, const RigidLimit& limit) {
  constexpr double worth = 0.95;
  if (!limit || limit->largest.status != LimitEnd::found) return {};
  const double least = least_limit(*limit);
  const bool room = bracket.holds && bracket.fails && least > 0.0 && least < worth * bracket.low;
  if (!room) return {};
  return std::sqrt(least * bracket.low);
}

}  // namespace edda
