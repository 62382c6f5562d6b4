#include "forces/mass_scaling.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/parallel.hpp"

namespace edda {
namespace {

/// Multiplies the inertia of block i; its weight does not change.
void multiply_inertia(Masses& m, std::size_t i, double factor) {
  for (std::vector<double>& mass : m.node) mass[i] *= factor;
  if (!m.viscosity.empty()) m.viscosity[i] *= std::sqrt(factor);  // same fraction of critical
  for (std::vector<double>& rate : m.mode_damping) {
    if (!rate.empty()) rate[i] /= std::sqrt(factor);
  }
  if (m.kind != MassKind::consistent) return;
  for (std::vector<double>& entry : m.inverse) entry[i] /= factor;
}

}  // namespace

std::vector<double> scale_block_masses(Masses& masses, const StiffnessInputs& inputs, double step,
                                       const std::vector<double>* most, StepCache* known) {
  const BlockSet& b = inputs.blocks;
  // Frequencies fall with the square root of the mass. With damping the step does not rise exactly
  // in proportion, hence the iteration.
  constexpr int most_rounds = 20;
  constexpr double rounding = 1e-9;
  std::vector<double> factors;
  for (int round = 0; round < most_rounds; ++round) {
    const std::vector<double> own = steps_of_blocks(inputs, step, known);
    bool enough = true;
    for (std::size_t i = 0; i < b.size(); ++i) {
      if (!(own[i] < step) || !(own[i] > 0.0)) continue;
      const double ratio = step / own[i], wanted = ratio * ratio * (1.0 + rounding);
      const double so_far = factors.empty() ? 1.0 : factors[i];
      const double factor = most == nullptr ? wanted : std::min(wanted, (*most)[i] / so_far);
      if (!(factor > 1.0)) continue;
      enough = false;
      if (factors.empty()) factors.assign(b.size(), 1.0);
      multiply_inertia(masses, i, factor);
      factors[i] *= factor;
    }
    if (enough) break;
    fill_point_masses(masses, b);
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
