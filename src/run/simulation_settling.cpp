// How a simulation comes to rest: the frequency with which it moves, by which adaptive damping
// goes, and what a stage changes, brought on little by little.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "base/parallel.hpp"
#include "contacts/strength.hpp"
#include "run/simulation.hpp"
#include "run/stages.hpp"

namespace edda {
namespace {

/// Of a node; of `consistent`, a third of the block's.
double inertia_of_node(const BlockSet& b, std::size_t k, std::size_t i) {
  return b.mass_kind == MassKind::consistent ? inertia_of(b, i) / 3.0 : b.node_mass[k][i];
}

/// What a value may count for at most, so that none is more than a quarter of all (of few values,
/// than four times their mean): one block that slides alone would drown the motion of all that
/// is to come to rest.
double largest_part(const std::vector<double>& values) {
  constexpr double part = 1.0 / 4.0, few = 4.0;
  constexpr int rounds = 30;
  const auto counting =
      std::count_if(values.begin(), values.end(), [](double v) { return v > 0.0; });
  const double share = std::max(part, few / std::max(1.0, static_cast<double>(counting)));
  double most = std::numeric_limits<double>::infinity();
  if (share >= 1.0) return most;
  for (int round = 0; round < rounds; ++round) {
    double sum = 0.0;
    for (const double v : values) sum += std::min(v, most);
    if (share * sum >= most) break;
    most = share * sum;
  }
  return most;
}

}  // namespace

double Simulation::drag() const {
  if (damping.adaptive == 0.0 || !explicit_method()) return damping.drag();
  // Beyond 1/h velocities would turn round.
  return std::min(damping.drag() + 2.0 * damping.adaptive * pace.frequency, 1.0 / state.step);
}

/// Looks at the frequency of the motion again, where it is time to.
void Simulation::take_pace(const LoadsNow& at_work) {
  constexpr std::uint64_t least = 8, most = 512;  // steps
  constexpr double radians = 0.25;
  const double h = state.step;
  const double wanted = pace.frequency > 0.0 ? radians / (pace.frequency * h) : 0.0;
  const Vec2 gravity = model.gravity - at_work.less_gravity();
  const auto length = static_cast<std::uint64_t>(
      std::clamp(wanted, static_cast<double>(least), static_cast<double>(most)));
  const bool first = pace.x[0].empty();
  if (!first && state.steps < pace.since + length) return;
  std::vector<double> stiffness(blocks.size(), 0.0), inertia_moved(blocks.size(), 0.0);
  if (first) {
    for (auto* nodes : {&pace.x, &pace.y, &pace.fx, &pace.fy}) {
      for (auto& values : *nodes) values.assign(blocks.size(), 0.0);
    }
  }
  // What falls or slides away has no stiffness, and goes further than all else together.
  std::vector<std::uint8_t> stays = touching(*this);
  for (std::size_t i = 0; i < aloof.size(); ++i) {
    if (aloof[i] != 0) stays[i] = 0;
  }
  bool none_stays = true;
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    none_stays = none_stays && !(is_free(blocks, state, i) && stays[i] != 0);
  }
  parallel_chunks(
      blocks.size(), blocks_at_once, [&](std::size_t, std::size_t from, std::size_t to) {
        // `load`: what comes or goes is no answer to motion; null: none.
        const auto look = [&](std::size_t i, const std::array<Vec2, 3>* load) {
          const bool counts = is_free(blocks, state, i) && (stays[i] != 0 || none_stays);
          for (std::size_t k = 0; k < 3; ++k) {
            // The forces are those of the positions before the step.
            const Vec2 x{state.x[k][i] - h * state.vx[k][i], state.y[k][i] - h * state.vy[k][i]};
            Vec2 f = Vec2{forces.x[k][i], forces.y[k][i]} - (blocks.mass[i] / 3.0) * gravity;
            if (load != nullptr) f -= (*load)[k];
            const Vec2 dx = x - Vec2{pace.x[k][i], pace.y[k][i]},
                       df = f - Vec2{pace.fx[k][i], pace.fy[k][i]};
            if (counts) {
              stiffness[i] -= dot(dx, df);
              inertia_moved[i] += inertia_of_node(blocks, k, i) * dot(dx, dx);
            }
            pace.x[k][i] = x.x;
            pace.y[k][i] = x.y;
            pace.fx[k][i] = f.x;
            pace.fy[k][i] = f.y;
          }
        };
        for (std::size_t i = from; i < to; ++i) {
          if (at_work.loads == nullptr || at_work.loads->place[i] == no_id) {
            look(i, nullptr);
            continue;
          }
          std::array<Vec2, 3> load{};
          add_loads(load, blocks, at_work, pose.x1, pose.y1, i);
          look(i, &load);
        }
      });
  pace.since = state.steps;
  if (first) return;
  // Once all else is in balance, what still moves sets the pace.
  const double most_of_one =
      balanced ? std::numeric_limits<double>::infinity() : largest_part(inertia_moved);
  double all_stiffness = 0.0, all_inertia = 0.0;
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    const double part = inertia_moved[i] > most_of_one ? most_of_one / inertia_moved[i] : 1.0;
    all_stiffness += part * stiffness[i];
    all_inertia += part * inertia_moved[i];
  }
  if (!(all_inertia > 0.0)) return;
  // Where what moves has no stiffness (all of it slides) half of what there was is left; nothing
  // that is held moves a hundred times slower than the wave.
  const double slowest = none_stays ? 0.0 : 0.01;
  const double now = std::max(all_stiffness / all_inertia, 0.0), was = pace.frequency;
  pace.frequency = std::max(was > 0.0 ? std::sqrt(0.5 * (was * was + now)) : std::sqrt(now),
                            slowest * wave_frequency());
}

/// Of a wave through a square of all blocks, 1/s.
double Simulation::wave_frequency() const {
  return 0.5 / (state.step * std::sqrt(static_cast<double>(blocks.size())));
}

void Simulation::begin_gently(const std::vector<double>& strength_factors, bool more) {
  if (state.steps == 0) {  // what the ground is in balance with is there already
    set_strength_factors(strength_factors);
    if (!initial) loads.gentle = {state.time, 0.0, true};
    return;
  }
  const Spells& spells = loads.spells;
  const auto now = [&](double time) { return time == state.time; };
  bool changes = more || strength_factors != laws.divided_by ||
                 std::any_of(loads.held.begin(), loads.held.end(),
                             [&](const Hold& hold) { return now(hold.changed); });
  for (const auto* of : {&spells.loads, &spells.waters, &spells.boundaries}) {
    changes = changes || std::any_of(of->begin(), of->end(), [&](const Spell& spell) {
                return now(spell.since) || now(spell.until);
              });
  }
  if (changes) loads.gentle = {state.time, 0.0, false};
  pace.least = 0.5 * pace.frequency;
  strength_from_ = laws.divided_by;
  strength_to_ = strength_factors;
}

/// Without a look at what that makes forces jump by.
void Simulation::take_strength_factors(const std::vector<double>& factors) {
  if (factors == laws.divided_by) return;
  LawTable divided = divided_laws(model, factors);
  take_strength(contacts, laws, divided);
  laws = std::move(divided);
  place_again();
}

/// A little more, in time with the motion: all of it within some of its periods.
void Simulation::bring_on() {
  if (all_on()) return;
  constexpr double periods = 1.0, increments = 100.0;
  // Before anything has moved: the wave's.
  const double frequency = pace.frequency > 0.0 ? pace.clock() : wave_frequency();
  GentleChange& gentle = loads.gentle;
  const double before = gentle.part;
  gentle.part += state.step * frequency / (2.0 * std::numbers::pi * periods);
  if (gentle.part >= 1.0) {
    gentle = {};
    if (!strength_to_.empty()) take_strength_factors(strength_to_);
  } else if (!strength_to_.empty() &&
             std::floor(increments * gentle.part) > std::floor(increments * before)) {
    std::vector<double> now = strength_to_;
    for (std::size_t r = 0; r < now.size(); ++r) {
      now[r] = strength_from_[r] + gentle.part * (strength_to_[r] - strength_from_[r]);
    }
    take_strength_factors(now);
  }
}

}  // namespace edda
