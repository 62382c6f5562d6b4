#include "run/settling.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "contacts/face_reading.hpp"
#include "run/labels.hpp"
#include "run/observe.hpp"

namespace edda {
namespace {

constexpr std::uint64_t look_every = 16;  // steps
constexpr std::uint8_t windows = 4;       // in which a block that has come loose goes on

double size_of(const Simulation& sim, std::size_t i) {
  return std::sqrt(sim.blocks.area[i]);
}

/// About half a period of the motion, in steps: what comes to rest has come a good way by then.
std::uint64_t window_of(const Simulation& sim) {
  constexpr double least = 128.0, most = 512.0;
  const double turn = sim.pace.frequency * sim.state.step;
  return static_cast<std::uint64_t>(turn > 0.0 ? std::clamp(std::numbers::pi / turn, least, most)
                                               : least);
}

void begin_window(Settling& s, const Simulation& sim) {
  s.window_began = sim.state.steps;
  s.window = window_of(sim);
  const double length = static_cast<double>(s.window) * sim.state.step;
  s.pull_before = s.pull;
  s.pull = (sim.pace.frequency > 0.0 ? sim.pace.frequency : 1.0 / length) / length;
  for (std::size_t i = 0; i < sim.blocks.size(); ++i) {
    const Vec2 at = centroid(sim.state.x, sim.state.y, i);
    s.from_x[i] = at.x;
    s.from_y[i] = at.y;
  }
}

/// At the end of a window: who has gone on.
void see_who_goes(Settling& s, Simulation& sim) {
  constexpr double lasting = 0.5;  // what comes to rest has moved far less than that
  const double like_before = s.pull_before > 0.0 ? s.pull / s.pull_before : 1.0;
  for (std::size_t i = 0; i < sim.blocks.size(); ++i) {
    const Vec2 at = centroid(sim.state.x, sim.state.y, i);
    const Vec2 now = at - Vec2{s.from_x[i], s.from_y[i]}, was{s.moved_x[i], s.moved_y[i]};
    const bool far = windows * norm(now) > left_over * size_of(sim, i);
    const double ratio = dot(was, was) > 0.0 ? like_before * dot(now, was) / dot(was, was) : 1.0;
    const bool goes =
        is_free(sim.blocks, sim.state, i) && norm(was) > 0.0 && far && ratio >= lasting;
    s.to_come[i] = ratio <= 0.0  ? 0.0
                   : ratio < 1.0 ? norm(now) * ratio / (1.0 - ratio)
                                 : std::numeric_limits<double>::infinity();
    s.going[i] = goes ? static_cast<std::uint8_t>(std::min<int>(s.going[i] + 1, windows)) : 0;
    s.moved_x[i] = now.x;
    s.moved_y[i] = now.y;
    if (s.going[i] >= windows) {
      sim.aloof.resize(sim.blocks.size(), 0);
      sim.aloof[i] = 1;
    } else if (!sim.aloof.empty() && s.going[i] == 0) {
      sim.aloof[i] = 0;
    }
  }
}

bool all_would_stay(const Settling& s, const Simulation& sim) {
  const std::vector<std::uint8_t> touches = touching(sim), small = pebbles(sim);
  const std::vector<double> rounding = rounding_of_forces(sim);
  for (std::size_t i = 0; i < sim.blocks.size(); ++i) {
    if (!is_free(sim.blocks, sim.state, i) || touches[i] == 0 || small[i] != 0) continue;
    if (!sim.aloof.empty() && sim.aloof[i] != 0) continue;
    const double most = left_over * size_of(sim, i);
    if (prospect(sim, i) > most) return false;
    if (!sim.explicit_method() || s.to_come[i] <= most) continue;
    const double speed = norm(centroid(sim.state.vx, sim.state.vy, i)),
                 time = time_to_stay(size_of(sim, i), norm(sim.model.gravity));
    if (way_unheld(sim, i, speed, time, rounding[i]) > most) return false;
  }
  return true;
}

bool all_go_away(const Simulation& sim) {
  if (sim.aloof.empty()) return false;
  for (std::size_t i = 0; i < sim.blocks.size(); ++i) {
    if (!is_free(sim.blocks, sim.state, i)) continue;
    const Vec2 gone = displacement_of(sim.state, i, {1.0 / 3.0, 1.0 / 3.0, 1.0 / 3.0});
    if (sim.aloof[i] == 0 || norm(gone) < size_of(sim, i)) return false;
  }
  return true;
}

}  // namespace

void begin_settling(Settling& s, Simulation& sim, const Stage& stage) {
  const std::size_t nb = sim.blocks.size();
  s = {};
  for (auto* values : {&s.from_x, &s.from_y, &s.moved_x, &s.moved_y}) values->assign(nb, 0.0);
  s.going.assign(nb, 0);
  s.to_come.assign(nb, std::numeric_limits<double>::infinity());
  sim.aloof.clear();
  sim.balanced = false;
  sim.settles = stage.until == StageEnd::equilibrium;
  sim.rest_ratio = stage.ratio;
  if (!sim.settles) sim.pace = {};
  begin_window(s, sim);
}

double time_to_stay(double size, double acceleration) {
  constexpr double times = 5.0;
  return times * std::sqrt(size / (acceleration > 0.0 ? acceleration : usual_acceleration));
}

double prospect(const Simulation& sim, std::size_t i) {
  if (!sim.explicit_method()) {
    if (sim.implicit.drift_x[0].empty()) return std::numeric_limits<double>::infinity();
    return sim.state.step * norm(centroid(sim.implicit.drift_x, sim.implicit.drift_y, i));
  }
  const double w = sim.pace.frequency;
  if (w == 0.0) return std::numeric_limits<double>::infinity();
  const double speed = norm(centroid(sim.state.vx, sim.state.vy, i)),
               force = 3.0 * norm(centroid(sim.forces.x, sim.forces.y, i));
  return speed / w + force / (inertia_of(sim.blocks, i) * w * w);
}

Rest look_for_rest(Settling& s, Simulation& sim, const Stage& stage) {
  if (!sim.all_on()) {
    s.window_began = sim.state.steps;
    s.window = 0;
    return Rest::not_yet;
  }
  if (sim.state.steps >= s.window_began + s.window) {
    see_who_goes(s, sim);
    begin_window(s, sim);
    if (all_go_away(sim)) return Rest::never;
  }
  if (sim.explicit_method() && sim.state.steps % look_every != 0) return Rest::not_yet;
  const Balance balance = balance_of(sim);
  const bool waits = stage.falling == FallingBlocks::wait && balance.detached > 0;
  sim.balanced = balance.resting > 0 && balance.of_most <= stage.ratio;
  const bool calm = !waits && balance.resting > 0 && balance.mean <= stage.ratio &&
                    (balance.mean == 0.0 || all_would_stay(s, sim));
  s.calm = calm ? s.calm + 1 : 0;
  return s.calm >= looks_at_rest ? Rest::found : Rest::not_yet;
}

std::vector<double> rounding_of_forces(const Simulation& sim) {
  std::vector<double> force(sim.blocks.size(), 0.0);
  const FaceSet& f = sim.contacts;
  for (std::size_t k = 0; k < f.size(); ++k) {
    if (!is_closed(f, k)) continue;
    const double spring = f.stiffness[k] * f.now.length[k] * f.now.gate[k];
    for (const Id i : {block_of_edge(sim.blocks, f, k), block_of_facing(sim.blocks, f, k)}) {
      force[i] += 0.5 * f.noise * spring;
    }
  }
  return force;
}

double way_unheld(const Simulation& sim, std::size_t i, double v, double t, double rounding) {
  const double resultant = 3.0 * norm(centroid(sim.forces.x, sim.forces.y, i));
  const double acceleration = std::max(resultant - rounding, 0.0) / sim.blocks.mass[i];
  return v * t + 0.5 * acceleration * t * t;
}

std::vector<Id> loose_ones(const Simulation& sim) {
  const std::vector<std::uint8_t> small = pebbles(sim);
  std::vector<Id> loose;
  for (std::size_t i = 0; i < sim.aloof.size(); ++i) {
    if (sim.aloof[i] != 0 && small[i] == 0) loose.push_back(static_cast<Id>(i));
  }
  return loose;
}

std::string loose_blocks(const Settling& s, const Simulation& sim) {
  std::vector<std::pair<double, Id>> loose;
  for (const Id i : loose_ones(sim)) {
    loose.emplace_back(norm(Vec2{s.moved_x[i], s.moved_y[i]}), i);
  }
  std::sort(loose.begin(), loose.end(), [](const auto& a, const auto& b) {
    return a.first != b.first ? a.first > b.first : a.second < b.second;
  });
  constexpr std::size_t named = 5;
  std::string text;
  for (std::size_t q = 0; q < std::min(named, loose.size()); ++q) {
    const Id i = loose[q].second;
    const Vec2 gone = displacement_of(sim.state, i, {1.0 / 3.0, 1.0 / 3.0, 1.0 / 3.0});
    text += fmt::format("{}{} ({:.3g} mm so far)", q == 0 ? "" : ", ", block_label(sim.blocks, i),
                        1e3 * norm(gone));
  }
  if (loose.size() > named) text += fmt::format(" and {} more", loose.size() - named);
  return text;
}

}  // namespace edda
