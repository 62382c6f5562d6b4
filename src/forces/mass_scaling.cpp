#include "forces/mass_scaling.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/parallel.hpp"
#include "blocks/point_mass.hpp"

namespace edda {
namespace {

/// Multiplies the masses of the nodes of block i, its weight left as it is.
void multiply_inertia(BlockSet& b, std::size_t i, double factor) {
  for (std::vector<double>& mass : b.node_mass) mass[i] *= factor;
  if (!b.viscosity.empty()) b.viscosity[i] *= std::sqrt(factor);  // the same part of critical
  if (b.mass_kind != MassKind::consistent) return;
  for (std::vector<double>& entry : b.inverse_mass) entry[i] /= factor;
}

}  // namespace

std::vector<double> raise_inertia(BlockSet& b, const State& state, const FaceSet& contacts,
                                  const BoundarySprings& springs, const LawTable& laws,
                                  const Damping& damping, double step, const Bolts* bolts,
                                  const std::vector<double>* most, KnownSteps* known) {
  // Frequencies fall as the root of the mass; damping makes the step fall a little faster than
  // that.
  constexpr int most_rounds = 20;
  constexpr double rounding = 1e-9;
  std::vector<double> factors;
  for (int round = 0; round < most_rounds; ++round) {
    const std::vector<double> own =
        steps_of_blocks(b, state, contacts, springs, laws, damping, step, bolts, known);
    bool enough = true;
    for (std::size_t i = 0; i < b.size(); ++i) {
      if (!(own[i] < step) || !(own[i] > 0.0)) continue;
      const double ratio = step / own[i], wanted = ratio * ratio * (1.0 + rounding);
      const double so_far = factors.empty() ? 1.0 : factors[i];
      const double factor = most == nullptr ? wanted : std::min(wanted, (*most)[i] / so_far);
      if (!(factor > 1.0)) continue;
      enough = false;
      if (factors.empty()) factors.assign(b.size(), 1.0);
      multiply_inertia(b, i, factor);
      factors[i] *= factor;
    }
    if (enough) break;
    fill_point_masses(b);
  }
  return factors;
}

double step_that_adds(const BlockSet& b, const std::vector<double>& own, double mass) {
  double low = std::numeric_limits<double>::infinity(), high = 0.0;
  for (std::size_t i = 0; i < own.size(); ++i) {
    if (!std::isfinite(own[i]) || b.fixed[i]) continue;
    low = std::min(low, own[i]);
    high = std::max(high, own[i]);
  }
  if (!(low < high)) return low;
  const auto added = [&](double step) {
    return ordered_sum(own.size(), [&](std::size_t i) {
      if (b.fixed[i] || !(own[i] < step)) return 0.0;
      const double ratio = step / own[i];
      return (ratio * ratio - 1.0) * b.mass[i];
    });
  };
  constexpr int halvings = 60;
  if (added(high) <= mass) return high;
  for (int k = 0; k < halvings; ++k) {
    const double middle = 0.5 * (low + high);
    (added(middle) <= mass ? low : high) = middle;
  }
  return low;
}

double free_mass(const BlockSet& b) {
  return ordered_sum(b.size(), [&](std::size_t i) { return b.fixed[i] ? 0.0 : b.mass[i]; });
}

double added_mass(const BlockSet& b, const std::vector<double>& inertia) {
  return ordered_sum(inertia.size(), [&](std::size_t i) { return (inertia[i] - 1.0) * b.mass[i]; });
}

}  // namespace edda
