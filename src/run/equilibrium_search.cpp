#include "run/equilibrium_search.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "blocks/block_groups.hpp"
#include "contacts/face_reading.hpp"
#include "observe/observe.hpp"
#include "step/faces_now.hpp"
#include "step/labels.hpp"
#include "step/touching.hpp"

namespace edda {
namespace {

/// Steps from look to look, each of which evaluates the closed faces once more: while the mean
/// unbalanced force is so many times what counts as equilibrium, and from then on.
constexpr std::uint64_t look_from_afar = 64, look_every = 16;
constexpr double far_from_equilibrium = 4.0;
constexpr std::uint8_t windows = 4;  // in which a loose block continues to move

double size_of(const Simulation& sim, std::size_t i) {
  return std::sqrt(sim.scene->blocks.area[i]);
}

/// About half a period of the motion, in steps; a block that reaches equilibrium has slowed down
/// markedly by then.
std::uint64_t window_of(const Simulation& sim) {
  constexpr double least = 128.0, most = 512.0;
  const double turn = sim.relaxation.estimate.frequency * sim.motion.state.step;
  return static_cast<std::uint64_t>(turn > 0.0 ? std::clamp(std::numbers::pi / turn, least, most)
                                               : least);
}

void begin_window(EquilibriumSearch& s, const Simulation& sim) {
  s.window_began = sim.motion.state.steps;
  s.window = window_of(sim);
  const double length = static_cast<double>(s.window) * sim.motion.state.step;
  s.pull_before = s.pull;
  s.pull =
      (sim.relaxation.estimate.frequency > 0.0 ? sim.relaxation.estimate.frequency : 1.0 / length) /
      length;
  for (std::size_t i = 0; i < sim.scene->blocks.size(); ++i) {
    const Vec2 at = centroid(sim.motion.state.x, sim.motion.state.y, i);
    s.from_x[i] = at.x;
    s.from_y[i] = at.y;
  }
}

/// How far a block has moved in this stage, over its size.
double gone(const EquilibriumSearch& s, const Simulation& sim, std::size_t i) {
  const Vec2 began{s.began_x[i], s.began_y[i]};
  return norm(centroid(sim.motion.state.x, sim.motion.state.y, i) - began) / size_of(sim, i);
}
/// Whether the block has left its place in this stage: what has come loose and gone so far has done
/// so, wherever it comes to lie. One that touched nothing when the stage began was to land.
bool has_left(const EquilibriumSearch& s, const Simulation& sim, std::size_t i) {
  constexpr double far = 0.1, far_in_the_air = 1.0;
  return gone(s, sim, i) >= (s.began_apart[i] != 0 ? far_in_the_air : far);
}

/// Blocks that fall, and have left their place, have come loose.
void find_fallen_blocks(const EquilibriumSearch& s, Simulation& sim, const Stage& stage) {
  if (stage.falling == FallingBlocks::wait) return;
  const std::vector<std::uint8_t> falls = falling_blocks(sim);
  for (std::size_t i = 0; i < falls.size(); ++i) {
    if (falls[i] == 0 || !has_left(s, sim, i)) continue;
    sim.relaxation.loose.resize(falls.size(), 0);
    sim.relaxation.loose[i] = 1;
  }
}

/// At the end of a window: finds the blocks that continue to move. What has come loose and moved
/// far remains loose.
void find_loose_blocks(EquilibriumSearch& s, Simulation& sim, const Stage& stage) {
  constexpr double lasting = 0.5;  // a block that reaches equilibrium has moved far less than that
  const double like_before = s.pull_before > 0.0 ? s.pull / s.pull_before : 1.0;
  for (std::size_t i = 0; i < sim.scene->blocks.size(); ++i) {
    const Vec2 at = centroid(sim.motion.state.x, sim.motion.state.y, i);
    const Vec2 now = at - Vec2{s.from_x[i], s.from_y[i]}, was{s.moved_x[i], s.moved_y[i]};
    const bool far = windows * norm(now) > equilibrium_travel_ratio * size_of(sim, i);
    const double ratio = dot(was, was) > 0.0 ? like_before * dot(now, was) / dot(was, was) : 1.0;
    const bool goes = is_free(sim.scene->blocks, sim.motion.state, i) && norm(was) > 0.0 && far &&
                      ratio >= lasting;
    s.to_come[i] = ratio <= 0.0  ? 0.0
                   : ratio < 1.0 ? norm(now) * ratio / (1.0 - ratio)
                                 : std::numeric_limits<double>::infinity();
    s.windows_moving[i] =
        goes ? static_cast<std::uint8_t>(std::min<int>(s.windows_moving[i] + 1, windows)) : 0;
    s.moved_x[i] = now.x;
    s.moved_y[i] = now.y;
    const bool left = stage.falling != FallingBlocks::wait && has_left(s, sim, i);
    if (s.windows_moving[i] >= windows) {
      sim.relaxation.loose.resize(sim.scene->blocks.size(), 0);
      sim.relaxation.loose[i] = 1;
    } else if (!sim.relaxation.loose.empty() && s.windows_moving[i] == 0 && !left) {
      sim.relaxation.loose[i] = 0;
    }
  }
}

/// Whether a block is loose that has not gone so far yet that it will hardly stop by itself.
bool waits_for_loose(const EquilibriumSearch& s, const Simulation& sim) {
  constexpr double far = 0.01;
  if (sim.relaxation.loose.empty()) return false;
  const std::vector<std::uint8_t> falls = falling_blocks(sim), small = negligible_blocks(sim);
  for (std::size_t i = 0; i < sim.relaxation.loose.size(); ++i) {
    const bool counts = falls[i] == 0 && small[i] == 0;
    if (counts && sim.relaxation.loose[i] != 0 && gone(s, sim, i) < far) return true;
  }
  return false;
}

bool all_in_equilibrium(const EquilibriumSearch& s, const Simulation& sim) {
  const std::vector<std::uint8_t> falls = falling_blocks(sim), small = negligible_blocks(sim);
  const std::vector<double> rounding = rounding_of_forces(sim);
  for (std::size_t i = 0; i < sim.scene->blocks.size(); ++i) {
    if (!is_free(sim.scene->blocks, sim.motion.state, i) || falls[i] != 0 || small[i] != 0)
      continue;
    if (!sim.relaxation.loose.empty() && sim.relaxation.loose[i] != 0) continue;
    const double most = equilibrium_travel_ratio * size_of(sim, i);
    if (sim.stepper->remaining_travel(sim, i) > most) return false;
    if (!is_explicit(sim) || s.to_come[i] <= most) continue;
    const double speed = norm(centroid(sim.motion.state.vx, sim.motion.state.vy, i)),
                 time = equilibrium_time(size_of(sim, i), norm(sim.scene->model.gravity));
    if (travel_if_free(sim, i, speed, time, rounding[i]) > most) return false;
  }
  return true;
}

/// Whether no block has a resultant beyond the rounding of the forces on it, as where nothing acts
/// on the model.
bool forces_are_rounding(const Simulation& sim) {
  const std::vector<double> rounding = rounding_of_forces(sim);
  for (std::size_t i = 0; i < rounding.size(); ++i) {
    if (is_free(sim.scene->blocks, sim.motion.state, i) && resultant_on(sim, i) > rounding[i])
      return false;
  }
  return true;
}

bool all_loose(const EquilibriumSearch& s, const Simulation& sim) {
  if (sim.relaxation.loose.empty()) return false;
  for (std::size_t i = 0; i < sim.scene->blocks.size(); ++i) {
    if (!is_free(sim.scene->blocks, sim.motion.state, i)) continue;
    if (sim.relaxation.loose[i] == 0 || !has_left(s, sim, i)) return false;
  }
  return true;
}

/// [nb] 1: no path of closed contacts leads from the block to a fixed one or to a support.
std::vector<std::uint8_t> unsupported(const Simulation& sim) {
  const BlockSet& b = sim.scene->blocks;
  const FaceSet& f = sim.motion.contacts;
  const BoundarySprings& springs = sim.attached.springs;
  Sets groups(b.size());
  for (std::size_t k = 0; k < f.size(); ++k) {
    if (is_closed_now(sim, k)) groups.join(block_of_edge(b, f, k), block_of_facing(b, f, k));
  }
  std::vector<std::uint8_t> stands(b.size(), 0);  // by the first block of each group
  for (Id i = 0; i < b.size(); ++i) {
    if (!is_free(b, sim.motion.state, i)) stands[groups.find(i)] = 1;
  }
  for (std::size_t q = 0; q < springs.size(); ++q) {
    if (springs.kxx[q] + springs.kyy[q] > 0.0)
      stands[groups.find(b.vertex_block[springs.vertex[q]])] = 1;
  }
  std::vector<std::uint8_t> apart(b.size());
  for (Id i = 0; i < b.size(); ++i) apart[i] = stands[groups.find(i)] == 0 ? 1 : 0;
  return apart;
}

}  // namespace

void begin_equilibrium_search(EquilibriumSearch& s, Simulation& sim, const Stage& stage) {
  const std::size_t nb = sim.scene->blocks.size();
  s = {};
  for (auto* values : {&s.from_x, &s.from_y, &s.moved_x, &s.moved_y}) values->assign(nb, 0.0);
  for (std::size_t i = 0; i < nb; ++i) {
    const Vec2 at = centroid(sim.motion.state.x, sim.motion.state.y, i);
    s.began_x.push_back(at.x);
    s.began_y.push_back(at.y);
  }
  s.began_apart = unsupported(sim);
  s.windows_moving.assign(nb, 0);
  s.to_come.assign(nb, std::numeric_limits<double>::infinity());
  sim.relaxation.loose.clear();
  sim.relaxation.balanced = false;
  sim.relaxation.seeks_equilibrium = stage.to_equilibrium();
  sim.relaxation.equilibrium_ratio = stage.ratio;
  if (!sim.relaxation.seeks_equilibrium) {
    sim.relaxation.estimate = {};
    sim.relaxation.in_flight.clear();
  }
  begin_window(s, sim);
}

double equilibrium_time(double size, double acceleration) {
  constexpr double times = 5.0;
  return times * std::sqrt(size / (acceleration > 0.0 ? acceleration : usual_acceleration));
}

Equilibrium look_for_equilibrium(EquilibriumSearch& s, Simulation& sim, const Stage& stage) {
  if (!is_explicit(sim) || sim.motion.state.steps % look_from_afar == 0)
    find_fallen_blocks(s, sim, stage);
  const auto balances = [&](const Balance& b) { return b.resting > 0 && b.mean_95 <= stage.ratio; };
  const bool complete = gradual_change_complete(sim),
             settles = sim.relaxation.hold == Relaxation::Hold::settling;
  if (!complete && !settles) {
    s.window_began = sim.motion.state.steps;
    s.window = 0;
    return Equilibrium::not_yet;
  }
  if (sim.motion.state.steps >= s.window_began + s.window) {
    find_loose_blocks(s, sim, stage);
    begin_window(s, sim);
    if (complete && all_loose(s, sim)) return Equilibrium::never;
  }
  if (!complete) {
    if (sim.motion.state.steps % look_from_afar == 0) {
      sim.relaxation.balanced = balances(balance_of(sim));
    }
    return Equilibrium::not_yet;
  }
  const std::uint64_t every = !is_explicit(sim) ? 1 : s.is_far ? look_from_afar : look_every;
  if (sim.motion.state.steps % every != 0) return Equilibrium::not_yet;
  const Balance balance = balance_of(sim);
  const bool waits =
      (stage.falling == FallingBlocks::wait && balance.detached > 0) || waits_for_loose(s, sim);
  sim.relaxation.balanced = balances(balance);
  const bool found_in_sequence =
      !waits && balance.resting > 0 &&
      ((balance.mean <= stage.ratio && (balance.mean == 0.0 || all_in_equilibrium(s, sim))) ||
       (balance.mean > stage.ratio && forces_are_rounding(sim)));
  s.found_in_sequence = found_in_sequence ? s.found_in_sequence + 1 : 0;
  s.is_far = !found_in_sequence &&
             std::min(balance.mean, balance.mean_95) > far_from_equilibrium * stage.ratio;
  return s.found_in_sequence >= checks_in_sequence ? Equilibrium::found : Equilibrium::not_yet;
}

std::vector<double> rounding_of_forces(const Simulation& sim) {
  std::vector<double> force(sim.scene->blocks.size(), 0.0);
  const FaceSet& f = sim.motion.contacts;
  const std::vector<double> springs = normal_springs_now(sim);
  for (std::size_t k = 0; k < f.size(); ++k) {
    if (springs[k] == 0.0) continue;
    for (const Id i :
         {block_of_edge(sim.scene->blocks, f, k), block_of_facing(sim.scene->blocks, f, k)}) {
      force[i] += 0.5 * f.noise * springs[k];
    }
  }
  const BoundarySprings& s = sim.attached.springs;
  for (std::size_t q = 0; q < s.size(); ++q)
    force[sim.scene->blocks.vertex_block[s.vertex[q]]] += f.noise * std::max(s.kxx[q], s.kyy[q]);
  return force;
}

double travel_if_free(const Simulation& sim, std::size_t i, double v, double t, double rounding) {
  const double acceleration =
      std::max(resultant_on(sim, i) - rounding, 0.0) / sim.scene->blocks.mass[i];
  return v * t + 0.5 * acceleration * t * t;
}

std::vector<Id> loose_block_ids(const Simulation& sim) {
  const std::vector<std::uint8_t> small = negligible_blocks(sim), falls = falling_blocks(sim);
  std::vector<Id> loose;
  for (std::size_t i = 0; i < sim.relaxation.loose.size(); ++i) {
    if (sim.relaxation.loose[i] != 0 && small[i] == 0 && falls[i] == 0)
      loose.push_back(static_cast<Id>(i));
  }
  return loose;
}

std::vector<Id> lost_block_ids(const Simulation& sim) {
  const std::vector<std::uint8_t>& loose = sim.relaxation.loose;
  const std::vector<std::uint8_t> falls = falling_blocks(sim), small = negligible_blocks(sim);
  std::vector<Id> lost;
  for (std::size_t i = 0; i < falls.size(); ++i) {
    const bool is_lost = falls[i] != 0 || (!loose.empty() && loose[i] != 0);
    if (is_lost && small[i] == 0) lost.push_back(static_cast<Id>(i));
  }
  return lost;
}

std::string loose_blocks(const EquilibriumSearch& s, const Simulation& sim) {
  std::vector<std::pair<double, Id>> loose;
  for (const Id i : loose_block_ids(sim)) {
    loose.emplace_back(norm(Vec2{s.moved_x[i], s.moved_y[i]}), i);
  }
  std::sort(loose.begin(), loose.end(), [](const auto& a, const auto& b) {
    return a.first != b.first ? a.first > b.first : a.second < b.second;
  });
  constexpr std::size_t named = 5;
  std::string text;
  for (std::size_t q = 0; q < std::min(named, loose.size()); ++q) {
    const Id i = loose[q].second;
    const Vec2 gone = displacement_of(sim.motion.state, i, centroid_weights);
    text += fmt::format("{}{} ({:.3g} mm so far)", q == 0 ? "" : ", ",
                        block_label(sim.scene->blocks, i), 1e3 * norm(gone));
  }
  if (loose.size() > named) text += fmt::format(" and {} more", loose.size() - named);
  return text;
}

}  // namespace edda
