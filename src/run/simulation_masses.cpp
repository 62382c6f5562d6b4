// Blocks made slower to move so that they do not hold the step.
#include <algorithm>
#include <cmath>
#include <limits>

#include "forces/mass_scaling.hpp"
#include "run/simulation.hpp"

namespace edda {

/// Slivers that the cut could not merge are to allow the step that all others do, but none to be
/// slower to move than the block of middling mass.
void Simulation::plan_slivers() {
  const auto& cut = polygons.blocks;
  const auto slow = [](const BlockPolygon& block) { return block.slow; };
  if (!explicit_method() || std::none_of(cut.begin(), cut.end(), slow)) return;
  const double whole = std::numeric_limits<double>::infinity();
  const std::vector<double> own =
      steps_of_blocks(blocks, state, contacts, springs, laws, damping, whole, &bolts);
  double others = whole;
  std::vector<double> masses;
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    if (cut[i].slow || !std::isfinite(own[i])) continue;
    others = std::min(others, own[i]);
    masses.push_back(blocks.mass[i]);
  }
  if (masses.empty()) return;
  const auto middle = masses.begin() + static_cast<std::ptrdiff_t>(masses.size() / 2);
  std::nth_element(masses.begin(), middle, masses.end());
  sliver_step_ = others;
  sliver_most_.assign(blocks.size(), 1.0);
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    if (cut[i].slow) sliver_most_[i] = std::max(1.0, *middle / blocks.mass[i]);
  }
}

/// Blocks that would hold the step below what was asked for are made slower. One in motion keeps
/// its momentum, and the energy that it loses by that is booked with that of changed steps.
void Simulation::raise_masses() {
  const Solver& solver = model.solver;
  const bool slivers = scaled_step_ == 0.0 && solver.mass_scaling == 0.0;
  const double step = scaled_step_ > 0.0 ? scaled_step_
                      : slivers          ? sliver_step_
                      : solver.time_step ? solver.mass_scaling
                                         : solver.mass_scaling / solver.safety;
  const bool moving = state.steps > 0;
  const double energy = moving ? ledger_now().balance() : 0.0;
  std::vector<double> most;
  if (slivers) {
    most = sliver_most_;
    for (std::size_t i = 0; i < inertia.size(); ++i) most[i] /= inertia[i];
  }
  const std::vector<double> factor =
      raise_inertia(blocks, state, contacts, springs, laws, damping, step, &bolts,
                    slivers ? &most : nullptr, &known_steps_);
  if (factor.empty()) return;
  set_viscosity();
  if (inertia.empty()) inertia.assign(blocks.size(), 1.0);
  for (std::size_t i = 0; i < blocks.size(); ++i) inertia[i] *= factor[i];
  if (!moving) return;
  for (std::size_t k = 0; k < 3; ++k) {
    for (std::size_t i = 0; i < blocks.size(); ++i) {
      state.vx[k][i] /= factor[i];
      state.vy[k][i] /= factor[i];
    }
  }
  step_change_energy += ledger_now().balance() - energy;
}

}  // namespace edda
