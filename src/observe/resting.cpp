#include "observe/resting.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "base/text.hpp"
#include "blocks/block_groups.hpp"
#include "observe/observe.hpp"
#include "step/contact_pairs.hpp"
#include "step/labels.hpp"

namespace edda {
namespace {

Sets groups_of(const Simulation& sim) {
  Sets sets(sim.scene->blocks.size());
  for (const auto& [i, j] : blocks_in_contact(sim, Nearness::touching)) sets.join(i, j);
  const Bolts& bolts = sim.attached.bolts;
  for (std::size_t r = 0; r < bolts.rows.size(); ++r) {
    for (Id k = bolts.begin[r] + 1; k < bolts.begin[r + 1]; ++k)
      sets.join(bolts.host[k - 1], bolts.host[k]);
  }
  return sets;
}

/// [nb] 1: the block is fixed, or something acts on it that may support it. Dashpots do not: they
/// carry no static load.
std::vector<std::uint8_t> supported_blocks(const Simulation& sim, Vec2 down) {
  std::vector<std::uint8_t> supported = sim.scene->blocks.fixed;
  const BoundarySprings& s = sim.attached.springs;
  for (std::size_t i = 0; i < sim.scene->blocks.size(); ++i) {
    for (Id q = s.block_begin[i]; q < s.block_begin[i + 1]; ++q) {
      if (carries_along(s.kxx[q], s.kyy[q], s.kxy[q], down)) supported[i] = 1;
    }
  }
  for (const Id i : sim.attached.loads.blocks) supported[i] = 1;
  return supported;
}

bool is_sent_off(const Simulation& sim, Id i) {
  return vectors_of(sim.motion.state.velocity, i) != NodeVectors{};
}

/// Extent of blocks: `side` across gravity, `depth` along it, m.
struct Extent {
  double from = std::numeric_limits<double>::infinity();
  double to = -std::numeric_limits<double>::infinity();
  double top = std::numeric_limits<double>::infinity();
  double bottom = -std::numeric_limits<double>::infinity();
  void add(double side, double depth) {
    from = std::min(from, side);
    to = std::max(to, side);
    top = std::min(top, depth);
    bottom = std::max(bottom, depth);
  }
};

Extent extent_of(const BlockSet& b, Id i, Vec2 down) {
  Extent e;
  for (Id v = b.vertex_begin[i]; v < b.vertex_begin[i + 1]; ++v) {
    const Vec2 p = b.vertex(v);
    e.add(p.x * down.y - p.y * down.x, dot(p, down));
  }
  return e;
}

/// Depth of the lowest support, in strips across gravity.
class Footing {
 public:
  Footing(double from, double to) : from_(from), width_((to - from) / strips) {}
  void add(const Extent& e) {
    for (std::size_t k = strip(e.from); k <= strip(e.to); ++k)
      bottom_[k] = std::max(bottom_[k], e.bottom);
  }
  bool lies_below(const Extent& e) const {
    for (std::size_t k = strip(e.from); k <= strip(e.to); ++k) {
      if (bottom_[k] > e.top) return true;
    }
    return false;
  }

 private:
  static constexpr std::size_t strips = 1024;
  std::size_t strip(double side) const {
    const double k = width_ > 0.0 ? (side - from_) / width_ : 0.0;
    return std::min(strips - 1, static_cast<std::size_t>(std::max(k, 0.0)));
  }
  double from_, width_;
  std::vector<double> bottom_ =
      std::vector<double>(strips, -std::numeric_limits<double>::infinity());
};

bool has_dashpots(const Simulation& sim, const BlockGroup& group) {
  const std::vector<Id>& damped = sim.attached.dashpots.damped;
  return std::any_of(group.begin(), group.end(),
                     [&](Id i) { return std::binary_search(damped.begin(), damped.end(), i); });
}

std::string group_label(const Simulation& sim, const BlockGroup& group) {
  const Id i = group.front();
  const std::string first = fmt::format(
      "{} at {}", block_label(sim.scene->blocks, i),
      place_label(Vec2{sim.scene->blocks.centroid_x[i], sim.scene->blocks.centroid_y[i]} +
                  sim.scene->blocks.origin));
  return group.size() == 1 ? first
                           : fmt::format("{} that touch each other, {} among them,",
                                         counted(group.size(), "block"), first);
}

}  // namespace

bool carries_along(double kxx, double kyy, double kxy, Vec2 d) {
  constexpr double rounding = 1e-9;
  const double along = d.x * (kxx * d.x + kxy * d.y) + d.y * (kxy * d.x + kyy * d.y);
  return along > rounding * (kxx + kyy);
}

std::vector<BlockGroup> unsupported_blocks(const Simulation& sim) {
  const double g = norm(sim.scene->model.gravity);
  if (g == 0.0) return {};
  const Vec2 down = (1.0 / g) * sim.scene->model.gravity;
  const std::size_t nb = sim.scene->blocks.size();
  Sets sets = groups_of(sim);
  const std::vector<std::uint8_t> supported = supported_blocks(sim, down);
  std::vector<std::uint8_t> stays(nb, 0), flies(nb, 0);  // indexed by Sets::find()
  std::vector<Extent> extents(nb);
  Extent all;
  for (Id i = 0; i < nb; ++i) {
    if (supported[i]) stays[sets.find(i)] = 1;
    if (is_sent_off(sim, i)) flies[sets.find(i)] = 1;
    extents[i] = extent_of(sim.scene->blocks, i, down);
    all.add(extents[i].from, extents[i].top);
    all.add(extents[i].to, extents[i].bottom);
  }
  Footing footing(all.from, all.to);
  for (Id i = 0; i < nb; ++i) {
    if (stays[sets.find(i)]) footing.add(extents[i]);
  }
  std::vector<std::uint8_t> lands(nb, 0);
  for (Id i = 0; i < nb; ++i) {
    if (footing.lies_below(extents[i])) lands[sets.find(i)] = 1;
  }
  std::vector<BlockGroup> groups;
  std::vector<std::size_t> row(nb, nb);
  for (Id i = 0; i < nb; ++i) {
    const Id set = sets.find(i);
    if (stays[set] || flies[set] || lands[set]) continue;
    if (row[set] == nb) {
      row[set] = groups.size();
      groups.emplace_back();
    }
    groups[row[set]].push_back(i);
  }
  return groups;
}

std::vector<std::string> warnings_of(const Simulation& sim, const std::vector<BlockGroup>& groups) {
  constexpr std::size_t most = 3;
  std::size_t count = 0;
  for (const BlockGroup& group : groups) count += group.size();
  if (count == 0) return {};
  const auto sinking = std::find_if(groups.begin(), groups.end(), [&](const BlockGroup& group) {
    return has_dashpots(sim, group);
  });
  if (sinking != groups.end()) {
    return {fmt::format(
        "{} {} on a viscous boundary alone, whose dashpots carry no static load: under gravity "
        "{} without end; support the model by a [[boundary]] of type = \"fixed\" or \"roller\" in "
        "a [[stage]] until = \"equilibrium\", and let the viscous boundary take over from it in "
        "the next stage (activate, deactivate), or give [initial_stress]",
        group_label(sim, *sinking), sinking->size() == 1 ? "rests" : "rest",
        sinking->size() == 1 ? "it sinks" : "they sink")};
  }
  const char* remedy =
      "give a [[boundary]], fixed = true of a [[block]], or a [[fixed]] point; where the fall is "
      "meant, there is nothing to do";
  if (count == sim.scene->blocks.size()) {
    return {fmt::format(
        "no block is fixed and no boundary supports any: {} will fall freely; {}",
        count == 1 ? std::string("the only block") : fmt::format("all {} blocks", count), remedy)};
  }
  std::vector<std::string> warnings;
  for (std::size_t q = 0; q < std::min(most, groups.size()); ++q) {
    warnings.push_back(
        fmt::format("{} {} unsupported, and nothing fixed lies below: {} will fall freely; {}",
                    group_label(sim, groups[q]), groups[q].size() == 1 ? "is" : "are",
                    groups[q].size() == 1 ? "it" : "they", remedy));
  }
  if (groups.size() > most) {
    warnings.push_back(fmt::format("unsupported as well: {}",
                                   counted(groups.size() - most, "further group") + " of blocks"));
  }
  return warnings;
}

}  // namespace edda
