// What rigid limit analysis tells a search for the factor of safety: where to begin, and where else
// to look.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "study/fos_bracket.hpp"
#include "study/fos_trial.hpp"
#include "study/limit_analysis.hpp"

namespace edda {

using RigidLimit = std::optional<LimitResult>;

/// The limits of rigid blocks; nothing where there is no such analysis.
RigidLimit rigid_limit(const Model& model, const Fos& fos, std::size_t blocks,
                       const LimitOptions& options);

/// The criterion of the trial of a factor, from blocks that stand as drawn. Blocks that have an
/// equilibrium as rigid ones by all limits may move by a tenth of their size before they find it:
/// steep blocks lean on each other after some hundredths. Where rigid blocks have none, what stops
/// them lies elsewhere, such as the ground in front of a slope, and they may move by little.
Criterion criterion_at(double factor, const Criterion& usual, const RigidLimit& rigid);

/// A bracket around a limit.
inline Vec2 around(double limit) {
  return {0.5 * limit, 2.0 * limit};
}

/// The bracket of [fos]; where that is the default, from which the search would not get as far as
/// the limit of rigid blocks, one around this limit, unless a trial `seen` contradicts it.
FosBracket first_bracket(const Fos& fos, const RigidLimit& rigid, const std::vector<Trial>& seen);

/// The lowest limit: of the associated, the non-associated and that of residual strength.
double least_limit(const LimitResult& limit);

/// A factor beside the lowest and the highest limit of rigid blocks. It agrees with them where all
/// three do, within 2 %.
enum class BesideLimits { below, between, agrees };
BesideLimits beside_limits(double factor, double least, double most);
/// Whether these limits have been found, and are one within 2 %.
bool limits_agree(const LimitResult& limit);

/// Between the lowest limit of rigid blocks and the highest factor that holds, where there is room:
/// the model may fail there, too, since how it comes to rest depends on what its joints have done.
std::optional<double> factor_below(const FosBracket& bracket, const RigidLimit& limit);

}  // namespace edda
