#include "observe/balance.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/gravity.hpp"
#include "observe/observe.hpp"
#include "step/labels.hpp"
#include "step/simulation.hpp"
#include "step/touching.hpp"

namespace edda {

double resultant_on(const Simulation& sim, std::size_t i) {
  return nodes_per_block * norm(centroid(sim.motion.forces, i));
}

namespace {

Unbalanced unbalanced_on(const Simulation& sim, std::size_t i) {
  return unbalanced_forces(sim.motion.masses, sim.scene->blocks, sim.motion.forces, i);
}

/// Whether block i moves or is about to: by more than rounding, whatever may act on it.
bool is_moved(const Simulation& sim, std::size_t i) {
  constexpr double part = 1e-9;
  const BlockSet& b = sim.scene->blocks;
  const double speed = norm(centroid(sim.motion.state.velocity, i));
  return unbalanced_on(sim, i).sum > part * usual_acceleration * b.mass[i] ||
         speed > part * std::sqrt(usual_acceleration * std::sqrt(b.area[i]));
}

/// Whether block i, which touches nothing, has fallen by a hundredth of its size. Before that it
/// may be about to land, as where blocks are drawn a little apart from each other. Without adaptive
/// damping, which spares blocks in flight, its velocity does not tell.
bool has_fallen(const Simulation& sim, std::size_t i) {
  if (sim.motion.damping.adaptive == 0.0) return true;
  constexpr double part = 0.01;
  const Vec2 v = centroid(sim.motion.state.velocity, i);
  // From rest, under this resultant.
  return 0.5 * inertia_of(sim.motion.masses, i) * dot(v, v) >
         part * std::sqrt(sim.scene->blocks.area[i]) * resultant_on(sim, i);
}

}  // namespace

std::vector<std::uint8_t> falling_blocks(const Simulation& sim) {
  std::vector<std::uint8_t> fall = touching(sim);
  for (std::size_t i = 0; i < fall.size(); ++i) {
    const bool free = is_free(sim.scene->blocks, sim.motion.state, i);
    fall[i] = fall[i] == 0 && free && is_moved(sim, i) && has_fallen(sim, i) ? 1 : 0;
  }
  return fall;
}

std::vector<Id> loose_blocks(const Simulation& sim) {
  std::vector<Id> loose;
  for (std::size_t i = 0; i < sim.relaxation.loose.size(); ++i) {
    if (sim.relaxation.loose[i] != 0) loose.push_back(static_cast<Id>(i));
  }
  return loose;
}

Balance balance_of(const Simulation& sim) {
  Balance balance;
  const std::vector<std::uint8_t> falls = falling_blocks(sim);
  double sum = 0.0;
  std::size_t bodies = 0;
  std::vector<Id> resting;
  std::vector<double> all;
  for (std::size_t i = 0; i < sim.scene->blocks.size(); ++i) {
    if (!is_free(sim.scene->blocks, sim.motion.state, i)) continue;
    if (falls[i] != 0) {
      ++balance.detached;
      continue;
    }
    if (!sim.relaxation.loose.empty() && sim.relaxation.loose[i] != 0) {
      ++balance.loose;
      continue;
    }
    resting.push_back(static_cast<Id>(i));
    const Unbalanced on = unbalanced_on(sim, i);
    const double force = on.sum / static_cast<double>(on.count);
    sum += on.sum;
    bodies += on.count;
    all.push_back(force);
    if (balance.block == no_id || force > balance.largest) {
      balance.largest = force;
      balance.block = static_cast<Id>(i);
    }
  }
  balance.resting = resting.size();
  if (std::none_of(resting.begin(), resting.end(), [&](Id i) { return is_moved(sim, i); })) {
    balance.largest = 0.0;
    return balance;
  }
  const double scale = force_scale(sim, resting);
  constexpr std::size_t parts = 20;
  const auto most = all.end() - static_cast<std::ptrdiff_t>(all.size() / parts);
  std::nth_element(all.begin(), most - 1, all.end());
  const double sum_of_most = std::accumulate(all.begin(), most, 0.0);
  balance.mean_95 =
      scale > 0.0 ? sum_of_most / static_cast<double>(most - all.begin()) / scale : 1.0;
  balance.mean = scale > 0.0 ? sum / static_cast<double>(bodies) / scale : 1.0;
  balance.largest = scale > 0.0 ? balance.largest / scale : 1.0;
  return balance;
}

std::string still_moving(const Simulation& sim, const Balance& balance) {
  std::vector<std::pair<double, Id>> speeds;
  const std::vector<std::uint8_t> touches = touching(sim);
  for (std::size_t i = 0; i < sim.scene->blocks.size(); ++i) {
    if (!is_free(sim.scene->blocks, sim.motion.state, i) || !touches[i]) continue;
    speeds.emplace_back(norm(centroid(sim.motion.state.velocity, i)), static_cast<Id>(i));
  }
  constexpr std::size_t named = 3;
  const std::size_t count = std::min(named, speeds.size());
  std::partial_sort(speeds.begin(), speeds.begin() + static_cast<std::ptrdiff_t>(count),
                    speeds.end(), [](const auto& a, const auto& b) {
                      return a.first != b.first ? a.first > b.first : a.second < b.second;
                    });
  std::string text = fmt::format("the mean unbalanced ratio is {:.3g}", balance.mean);
  if (balance.block != no_id) {
    text += fmt::format(", the largest {:.3g} at {}", balance.largest,
                        block_label(sim.scene->blocks, balance.block));
  }
  for (std::size_t q = 0; q < count; ++q) {
    text += fmt::format("{}{} at {:.3g} m/s", q == 0 ? "; fastest are " : ", ",
                        block_label(sim.scene->blocks, speeds[q].second), speeds[q].first);
  }
  if (balance.detached > 0) text += fmt::format("; {} fall freely", balance.detached);
  return text;
}

}  // namespace edda
