#include "judge/judge.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "base/text.hpp"
#include "observe/balance.hpp"
#include "step/labels.hpp"

namespace edda {
namespace {

constexpr std::uint64_t look_every = 32, find_moved_every = 128;  // steps

}  // namespace

Judge::Judge(Simulation& sim, std::vector<std::uint8_t> left_out)
    : left_out_(std::move(left_out)), left_(left_out_) {
  motion_ = RelativeMotion(sim);
  begin(sim);
}

void Judge::begin(const Simulation& sim) {
  slowing_.begin(sim);
  rests_.assign(sim.scene->blocks.size(), 0);
  was_complete_ = false;
  found_in_sequence_ = at_rest_in_sequence_ = 0;
}

void Judge::follow_supports(Simulation& sim) {
  constexpr double own_size = 1.0;
  if (!motion_.supports_have_moved(sim)) return;
  for (MovedSet& set : motion_.sets(sim, own_size, left_out_)) gone_.push_back(std::move(set));
  motion_ = RelativeMotion(sim);
}

void Judge::find_moved(Simulation& sim) {
  std::vector<std::uint8_t> out = left_out_;
  for (const MovedSet& set : gone_) {
    out.resize(sim.scene->blocks.size(), 0);
    for (const Id i : set.blocks) out[i] = 1;
  }
  moved_ = gone_;
  for (MovedSet& set : motion_.sets(sim, moved_little, out)) moved_.push_back(std::move(set));
  left_ = left_out_;
  for (const MovedSet& set : moved_) {
    if (set.part <= left_its_place) continue;
    left_.resize(sim.scene->blocks.size(), 0);
    for (const Id i : set.blocks) left_[i] = 1;
  }
  sim.relaxation.loose = left_;
}

bool Judge::look(Simulation& sim) {
  const std::uint64_t steps = sim.motion.state.steps;
  if (is_explicit(sim) && steps % look_every != 0) return false;
  // What holds together lags behind ground that settles, and comes back.
  if (!sim.relaxation.holds_together && (!is_explicit(sim) || steps % find_moved_every == 0))
    find_moved(sim);
  const bool complete = gradual_change_complete(sim);
  if (complete) {
    if (!was_complete_) follow_supports(sim);
    slowing_.look(sim);
  } else {
    slowing_.begin(sim);
  }
  was_complete_ = complete;
  rests_ = blocks_at_rest(sim, complete && is_explicit(sim) ? &slowing_ : nullptr);
  std::size_t moving = 0, counted = 0;
  bool rest = complete, found = complete;
  for (std::size_t i = 0; i < rests_.size(); ++i) {
    if (!is_free(sim.scene->blocks, sim.motion.state, i)) continue;
    if (!counts_in_verdicts(sim, i) || (!left_out_.empty() && left_out_[i] != 0)) continue;
    ++counted;
    if (rests_[i] != 0) continue;
    rest = false;
    if (!left_.empty() && left_[i] != 0) continue;
    ++moving;
    found = false;
  }
  if (!complete && !sim.relaxation.holds_together) {
    const Balance balance = balance_of(sim);
    sim.relaxation.balanced =
        balance.resting > 0 && balance.mean_95 <= sim.relaxation.equilibrium_ratio;
  } else {
    constexpr std::size_t single = 20;  // one block of so many
    sim.relaxation.balanced = single * moving <= counted;
  }
  found_in_sequence_ = found ? found_in_sequence_ + 1 : 0;
  at_rest_in_sequence_ = rest ? at_rest_in_sequence_ + 1 : 0;
  if (found_in_sequence_ == looks_in_sequence) find_moved(sim);
  return true;
}

std::string Judge::left_text(const Simulation& sim) const {
  constexpr std::size_t named = 5;
  std::vector<const MovedSet*> sets;
  std::size_t blocks = 0;
  double area = 0.0;
  for (const MovedSet& set : moved_) {
    if (set.part <= left_its_place) continue;
    sets.push_back(&set);
    blocks += set.blocks.size();
    area += set.area;
  }
  if (sets.empty()) return {};
  std::string text =
      fmt::format(", except for {} ({:.3g} m2) that {} come loose: ", counted(blocks, "block"),
                  area, blocks == 1 ? "has" : "have");
  for (std::size_t q = 0; q < std::min(named, sets.size()); ++q) {
    const MovedSet& set = *sets[q];
    const Id i = set.blocks.front();
    const Furthest speed = fastest_of(sim, set.blocks);
    text += fmt::format(
        "{}{}{} (moved {:.3g} m{})", q == 0 ? "" : ", ", block_label(sim.scene->blocks, i),
        set.blocks.size() == 1 ? "" : fmt::format(" and {} with it", set.blocks.size() - 1),
        set.distance,
        rests_[speed.block == no_id ? i : speed.block] != 0
            ? ", stopped"
            : fmt::format(", now at {:.3g} m/s", speed.value));
  }
  if (sets.size() > named) text += fmt::format(" and {} more", sets.size() - named);
  return text;
}

Furthest fastest_block(const Simulation& sim) {
  std::vector<Id> all(sim.scene->blocks.size());
  std::iota(all.begin(), all.end(), Id{0});
  return fastest_of(sim, all);
}

Furthest fastest_of(const Simulation& sim, const std::vector<Id>& blocks) {
  Furthest most;
  for (const Id i : blocks) {
    if (!is_free(sim.scene->blocks, sim.motion.state, i)) continue;
    const double speed = norm(centroid(sim.motion.state.velocity, i));
    if (speed > most.value) most = {speed, i};
  }
  return most;
}

bool Judge::fits(const Simulation& sim) const {
  const std::size_t nb = sim.scene->blocks.size();
  for (const auto* marks : {&left_out_, &left_}) {
    if (!marks->empty() && marks->size() != nb) return false;
  }
  const auto of_model = [nb](const MovedSet& set) {
    return !set.blocks.empty() && set.blocks.back() < nb &&
           std::is_sorted(set.blocks.begin(), set.blocks.end());
  };
  return rests_.size() == nb && motion_.fits(sim.scene->blocks) &&
         slowing_.fits(sim.scene->blocks) && std::all_of(moved_.begin(), moved_.end(), of_model) &&
         std::all_of(gone_.begin(), gone_.end(), of_model);
}

bool Judge::all_left(const Simulation& sim) const {
  if (left_.empty()) return false;
  for (std::size_t i = 0; i < left_.size(); ++i) {
    if (is_free(sim.scene->blocks, sim.motion.state, i) && counts_in_verdicts(sim, i) &&
        left_[i] == 0)
      return false;
  }
  return true;
}

Furthest Judge::furthest(const Simulation& sim) const {
  Furthest most;
  for (Id i = 0; i < sim.scene->blocks.size(); ++i) {
    if (!is_free(sim.scene->blocks, sim.motion.state, i) || !counts_in_verdicts(sim, i)) continue;
    if (!left_out_.empty() && left_out_[i] != 0) continue;
    const double u = motion_.moved_from_start(sim, i);
    if (u > most.value) most = {u, i};
  }
  return most;
}

}  // namespace edda
