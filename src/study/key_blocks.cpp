#include "study/key_blocks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numeric>
#include <tuple>

#include "base/text.hpp"
#include "contacts/inside.hpp"
#include "limit/joint_strength.hpp"
#include "limit/limit_factor.hpp"
#include "limit/removal_cone.hpp"
#include "run/wall_clock.hpp"
#include "step/labels.hpp"
#include "study/fault_at.hpp"
#include "study/staged_model.hpp"

namespace edda {
namespace {

constexpr double negligible = 1e-9;  // of the resultant

/// One body and what touches it now.
struct Surrounded {
  std::vector<std::size_t> joints;  ///< rows of RigidBlocks::joints
  std::vector<Vec2> outward;        ///< of each: normal from the body into the other
};

class KeyBlockSearch {
 public:
  KeyBlockSearch(const Simulation& sim, const KeyBlockOptions& options)
      : sim_(sim), options_(options), rigid_(rigid_blocks(sim)) {
    const std::vector<double> undivided(sim.motion.laws.rows.size(), 1.0);
    strength_ =
        joint_strengths(rigid_, sim.motion.laws, undivided, StrengthOf::peak, /*crushing=*/false);
    force_ =
        weights_under(rigid_, sim, last_gravity(sim)) + loads_with(rigid_, sim, last_factors(sim));
    joints_of_.resize(rigid_.bodies());
    for (std::size_t k = 0; k < rigid_.joints.size(); ++k) {
      for (const Id block : {rigid_.joints[k].block_a, rigid_.joints[k].block_b}) {
        if (rigid_.body[block] != no_id) joints_of_[rigid_.body[block]].push_back(k);
      }
    }
    supported_.assign(rigid_.bodies(), 0);
    for (const RigidSupport& s : rigid_.supports) {
      if (rigid_.body[s.block] != no_id) supported_[rigid_.body[s.block]] = 1;
    }
    gone_.assign(rigid_.bodies(), 0);
  }

  KeyBlocks run();
  bool is_loaded() const {
    return std::any_of(force_.begin(), force_.end(),
                       [](const RigidForce& f) { return f.force != Vec2{}; });
  }

 private:
  Surrounded around(std::size_t body) const;
  std::optional<RemovableBlock> judged(std::size_t body) const;
  void add_motion(RemovableBlock& block, const Surrounded& near) const;
  void slide_on(RemovableBlock& block, const Surrounded& near, std::size_t face) const;
  double resistance_to_falling(const Surrounded& near, Vec2 direction) const;
  std::optional<double> factor_alone(std::size_t body, const Surrounded& near) const;
  KeyBlocks collected(std::vector<std::optional<RemovableBlock>> last);

  const Simulation& sim_;
  const KeyBlockOptions& options_;
  RigidBlocks rigid_;
  std::vector<RigidStrength> strength_;              ///< [joints]
  RigidForces force_;                                ///< [bodies]
  std::vector<std::vector<std::size_t>> joints_of_;  ///< [bodies]
  std::vector<char> supported_, gone_;               ///< [bodies]
};

Surrounded KeyBlockSearch::around(std::size_t body) const {
  Surrounded near;
  for (const std::size_t k : joints_of_[body]) {
    const RigidJoint& joint = rigid_.joints[k];
    const bool is_a = rigid_.body[joint.block_a] == body;
    const Id other = rigid_.body[is_a ? joint.block_b : joint.block_a];
    if (other != no_id && gone_[other] != 0) continue;
    near.joints.push_back(k);
    near.outward.push_back(is_a ? joint.n : -joint.n);
  }
  return near;
}

/// What joints resist as they are pulled apart and sheared along d: their tensile strength across
/// and their cohesion along, by the cosines.
double KeyBlockSearch::resistance_to_falling(const Surrounded& near, Vec2 d) const {
  double resistance = 0.0;
  for (const std::size_t k : near.joints) {
    const RigidJoint& joint = rigid_.joints[k];
    const double ends = joint.is_corner() ? 1.0 : 2.0;
    resistance += ends * strength_[k].tension * std::abs(dot(joint.n, d)) +
                  strength_[k].shear * std::abs(dot(joint.t, d));
  }
  return resistance;
}

/// Sliding along face i: the normal force R.n is carried by all faces of that normal, in proportion
/// to their lengths; faces opposite to them add their cohesion. F = (N tan(phi) + c L)/T.
void KeyBlockSearch::slide_on(RemovableBlock& block, const Surrounded& near,
                              std::size_t face) const {
  const Vec2 r = force_[block.body].force, n = near.outward[face];
  const double normal = dot(r, n), drive = norm(r - normal * n);
  double lengths = 0.0, friction = 0.0, frictions = 0.0, resistance = 0.0;
  std::size_t carrying = 0, opposite = 0;
  for (std::size_t i = 0; i < near.joints.size(); ++i) {
    constexpr double same = 1e-6;
    const double cosine = dot(near.outward[i], n);
    if (std::abs(cosine) < 1.0 - same) continue;
    const std::size_t k = near.joints[i];
    block.joints.push_back(k);
    resistance += strength_[k].shear;
    if (cosine < 0.0) {
      ++opposite;
      continue;
    }
    ++carrying;
    const double length = rigid_.joints[k].length();
    lengths += length;
    friction += length * strength_[k].friction;
    frictions += strength_[k].friction;
  }
  const double mean =
      lengths > 0.0 ? friction / lengths : frictions / static_cast<double>(carrying);
  resistance += normal * mean;
  block.mode = opposite > 0 ? RemovalMode::slides_on_two : RemovalMode::slides;
  block.direction = unit(r - normal * n);
  block.by_translation = resistance / drive;
  block.support = std::max(0.0, drive - resistance / options_.factor);
}

/// Falling where the resultant itself leads out, else sliding on the face that it presses and along
/// which its part leads out; without one the block stays.
void KeyBlockSearch::add_motion(RemovableBlock& block, const Surrounded& near) const {
  const Vec2 r = force_[block.body].force;
  const double size = norm(r);
  if (size <= negligible * rigid_.force) return;
  const auto presses = [&](std::size_t i) { return dot(r, near.outward[i]) > negligible * size; };
  bool falls = true;
  for (std::size_t i = 0; i < near.outward.size(); ++i) falls = falls && !presses(i);
  if (falls) {
    block.mode = RemovalMode::falls;
    block.direction = (1.0 / size) * r;
    const double resistance = resistance_to_falling(near, block.direction);
    block.by_translation = resistance / size;
    block.support = std::max(0.0, size - resistance / options_.factor);
    return;
  }
  for (std::size_t i = 0; i < near.outward.size(); ++i) {
    if (!presses(i)) continue;
    const Vec2 along = r - dot(r, near.outward[i]) * near.outward[i];
    if (norm(along) > negligible * size && is_free(near.outward, along))
      return slide_on(block, near, i);
  }
}

/// The block alone between neighbours that do not move. Nothing: no factor moves it.
std::optional<double> KeyBlockSearch::factor_alone(std::size_t body, const Surrounded& near) const {
  RigidBlocks alone;
  alone.blocks = {rigid_.blocks[body]};
  alone.body.assign(rigid_.body.size(), no_id);
  for (const Id i : rigid_.blocks[body]) alone.body[i] = 0;
  alone.centroid = {rigid_.centroid[body]};
  alone.weight = {rigid_.weight[body]};
  alone.extent = {rigid_.extent[body]};
  alone.size = rigid_.size;
  alone.force = rigid_.force;
  LimitProblem problem;
  std::vector<RigidStrength> strength;
  for (const std::size_t k : near.joints) {
    alone.joints.push_back(rigid_.joints[k]);
    strength.push_back(strength_[k]);
  }
  problem.rigid = &alone;
  problem.dead = {force_[body]};
  const auto divided_by = [&](double factor) {
    std::vector<RigidStrength> less = strength;
    for (RigidStrength& s : less) {
      s.friction /= factor;
      s.shear /= factor;
      s.tension /= factor;
    }
    return less;
  };
  constexpr double tolerance = 1e-6;
  const StrengthFactor found =
      strength_factor(problem, std::vector<char>(strength.size(), 1), divided_by, tolerance);
  if (found.end == LimitEnd::found) return found.holds;
  if (found.end == LimitEnd::no_equilibrium) return 0.0;
  return {};
}

std::optional<RemovableBlock> KeyBlockSearch::judged(std::size_t body) const {
  const Surrounded near = around(body);
  if (supported_[body] != 0 || near.joints.empty() || !can_leave(near.outward)) return {};
  RemovableBlock block;
  block.body = body;
  block.blocks = rigid_.blocks[body];
  block.centroid = rigid_.centroid[body] + sim_.scene->blocks.origin;
  for (const Id i : block.blocks) block.area += sim_.scene->blocks.area[i];
  block.weight = norm(weights_under(rigid_, sim_, sim_.scene->model.gravity)[body].force);
  add_motion(block, near);
  block.by_rotation = factor_alone(body, near);
  block.factor = block.by_translation;
  if (block.by_rotation && (!block.factor || *block.by_rotation < *block.factor)) {
    constexpr double clearly = 0.999;
    const bool rotates = !block.factor || *block.by_rotation < clearly * *block.factor;
    block.factor = block.by_rotation;
    if (rotates) {
      block.mode = RemovalMode::rotates;
      block.support.reset();
    }
  }
  block.kind = !block.factor                     ? BlockClass::stable
               : *block.factor < options_.factor ? BlockClass::key
                                                 : BlockClass::held;
  return block;
}

KeyBlocks KeyBlockSearch::run() {
  std::vector<std::optional<RemovableBlock>> last(rigid_.bodies());
  std::vector<std::size_t> candidates(rigid_.bodies());
  std::iota(candidates.begin(), candidates.end(), 0U);
  for (std::size_t generation = 1; generation <= options_.generations; ++generation) {
    std::vector<std::size_t> leaving;
    for (const std::size_t body : candidates) {
      std::optional<RemovableBlock> now = judged(body);
      if (!now) continue;
      now->generation = last[body] ? last[body]->generation : generation;
      if (now->kind == BlockClass::key) {
        now->generation = generation;
        leaving.push_back(body);
      }
      last[body] = std::move(now);
    }
    if (leaving.empty()) break;
    for (const std::size_t body : leaving) gone_[body] = 1;
    candidates.clear();
    for (const std::size_t body : leaving) {
      for (const std::size_t k : joints_of_[body]) {
        for (const Id block : {rigid_.joints[k].block_a, rigid_.joints[k].block_b}) {
          const Id other = rigid_.body[block];
          if (other != no_id && gone_[other] == 0) candidates.push_back(other);
        }
      }
    }
    std::sort(candidates.begin(), candidates.end());
    candidates.erase(std::unique(candidates.begin(), candidates.end()), candidates.end());
  }
  return collected(std::move(last));
}

KeyBlocks KeyBlockSearch::collected(std::vector<std::optional<RemovableBlock>> last) {
  KeyBlocks found;
  found.required = options_.factor;
  found.bodies = rigid_.bodies();
  found.of_block.assign(sim_.scene->blocks.size(), BlockClass::locked);
  found.generation_of_block.assign(sim_.scene->blocks.size(), 0);
  for (std::optional<RemovableBlock>& block : last) {
    if (!block) {
      ++found.locked;
      continue;
    }
    ++(block->kind == BlockClass::key    ? found.key
       : block->kind == BlockClass::held ? found.held
                                         : found.stable);
    const bool is_key = block->kind == BlockClass::key;
    for (const Id i : block->blocks) {
      found.of_block[i] = block->kind;
      if (is_key) found.generation_of_block[i] = block->generation;
    }
    if (is_key) {
      found.key_area += block->area;
      found.key_weight += block->weight;
      found.generations = std::max(found.generations, block->generation);
    }
    found.blocks.push_back(std::move(*block));
  }
  const auto rank = [](const RemovableBlock& b) {
    return std::tuple(b.kind != BlockClass::key, b.generation, b.factor.value_or(1e300));
  };
  std::stable_sort(found.blocks.begin(), found.blocks.end(),
                   [&](const auto& a, const auto& b) { return rank(a) < rank(b); });
  found.rigid = std::move(rigid_);
  return found;
}

/// As KeyBlocks::at_place; of blocks that share a border there, the first that leaves. place: in
/// local coordinates, m.
std::optional<std::size_t> generation_at(const Simulation& sim,
                                         const std::vector<std::size_t>& of_block, Vec2 place) {
  const BlockSet& b = sim.scene->blocks;
  std::optional<std::size_t> found;
  for (std::size_t i = 0; i < b.size(); ++i) {
    const Vec2 arm = place - Vec2{b.centroid_x[i], b.centroid_y[i]};
    if (sim.motion.state.alive[i] == 0 || norm(arm) > b.radius[i]) continue;
    if (depth_inside(b, sim.motion.pose, place, i) < 0.0) continue;
    if (!found || *found == 0 || (of_block[i] > 0 && of_block[i] < *found)) found = of_block[i];
  }
  return found;
}

std::string message_of(const KeyBlocks& k) {
  const std::string asked =
      k.required == 1.0 ? "" : fmt::format(" (factor below {:.4g})", k.required);
  if (k.key == 0) {
    return fmt::format("no key blocks{} among {}: {} removable, all of which stay", asked,
                       counted(k.bodies, "block"), k.held + k.stable);
  }
  std::string text =
      fmt::format("{}{} of {:.4g} m2 in all", counted(k.key, "key block"), asked, k.key_area);
  if (k.generations > 1) text += fmt::format(", in {} generations", k.generations);
  return text + fmt::format("; {} more can leave and {}, of {}", k.held + k.stable,
                            k.held + k.stable == 1 ? "stays" : "stay", counted(k.bodies, "block"));
}

}  // namespace

Result<KeyBlocks> key_blocks(const Model& model, const KeyBlockOptions& options) {
  const auto began = std::chrono::steady_clock::now();
  if (model.contact.model == ContactModel::points) {
    return fault_at(model, model.contact.where, "contact.model",
                    "\"points\" is the paper's contact model, without joints that have a length",
                    "use contact.model = \"faces\"");
  }
  Result<PreparedRun> prepared = as_staged(model, model.fos.value_or(Fos{}));
  if (!prepared.ok()) return prepared.faults();
  const Simulation& sim = prepared.value().sim;
  KeyBlockSearch search(sim, options);
  if (!search.is_loaded()) {
    return fault_at(model, model.solver.where, "gravity",
                    "no free block touches another and carries a load",
                    "give gravity or loads, and leave some blocks that are not fixed");
  }
  KeyBlocks found = search.run();
  for (const MonitorPoint& m : prepared.value().gauges.monitors)
    found.monitors.push_back({m.name, found.of_block[m.block], found.generation_of_block[m.block]});
  for (const Vec2 place : options.places)
    found.at_place.push_back(
        generation_at(sim, found.generation_of_block, place - sim.scene->blocks.origin));
  found.message = message_of(found);
  found.drawn = sim;
  found.warnings = prepared.value().warnings;
  found.seconds = since(began);
  return found;
}

}  // namespace edda
