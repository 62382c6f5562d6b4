#include "step/invariants.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "contacts/joint_strength.hpp"
#include "step/faces_now.hpp"
#include "step/simulation.hpp"

namespace edda {
namespace {

std::string of_blocks(const Simulation& sim) {
  const State& state = sim.motion.state;
  const BlockSet& b = sim.scene->blocks;
  for (std::size_t i = 0; i < b.size(); ++i) {
    if (state.alive[i] == 0) continue;
    for (const BodyVectors* of : {&state.position, &state.velocity, &sim.motion.forces})
      if (!is_finite(b, *of, i)) return fmt::format("block {} is not finite", i);
  }
  return {};
}

bool in_range(double value, double from, double to) {
  constexpr double rounding = 1e-9;
  return value >= from - rounding && value <= to + rounding;
}

/// At one end: half of the cohesion and the friction of its normal force.
bool within_limit(const FaceRow& r, double shear, double normal) {
  const double limit =
      coulomb_limit(0.5 * r.of.cohesion[r.k] * r.state.cohesive, r.of.friction[r.k], normal);
  return std::abs(shear) <= limit * (1.0 + 1e-9) + 1e-6;
}

std::string of_face(const Simulation& sim, std::size_t k) {
  const FaceSet& c = sim.motion.contacts;
  const BlockSet& b = sim.scene->blocks;
  if (c.edge[k] >= c.facing[k] || c.facing[k] >= b.vertex_count()) return "edges are out of range";
  if (b.vertex_block[c.edge[k]] == b.vertex_block[c.facing[k]]) return "joins a block to itself";
  if (c.law[k] >= sim.motion.laws.rows.size()) return "has no law";
  const FaceRow row = face_row(sim, k);
  const FaceFields& m = row.state;
  for (const FaceField& field : face_fields) {
    if (!std::isfinite(m.*field.value)) return fmt::format("{} is not finite", field.name);
  }
  if (!in_range(m.gate, 0.0, 1.0)) return "gate is out of [0, 1]";
  if (m.energy < 0.0) return "stores less than nothing";
  if (m.friction_work < 0.0) return "friction creates energy";
  if (m.length < 0.0) return "overlap is negative";
  if (m.energy == 0.0) return {};
  for (const double at : {m.xi_a, m.xi_b, m.eta_a, m.eta_b}) {
    if (!in_range(at, 0.0, 1.0)) return "an end lies beyond its edge";
  }
  const bool free =
      is_explicit(sim) && !c.bonded(k) && !c.dashpots && !sim.motion.laws.any_changes && !c.gluing;
  if (free &&
      !(within_limit(row, m.shear_a, m.normal_a) && within_limit(row, m.shear_b, m.normal_b))) {
    return "carries more shear than its limit";
  }
  return {};
}

std::string of_faces(const Simulation& sim) {
  const FaceSet& c = sim.motion.contacts;
  std::vector<std::pair<Id, Id>> pairs;
  for (std::size_t k = 0; k < c.size(); ++k) {
    if (std::string broken = of_face(sim, k); !broken.empty())
      return fmt::format("face {}: {}", k, broken);
    pairs.emplace_back(c.edge[k], c.facing[k]);
  }
  std::sort(pairs.begin(), pairs.end());
  const auto twice = std::adjacent_find(pairs.begin(), pairs.end());
  if (twice == pairs.end()) return {};
  return fmt::format("edges {} and {} have two faces", twice->first, twice->second);
}

}  // namespace

std::string broken_invariant(const Simulation& sim) {
  std::string broken = of_blocks(sim);
  if (broken.empty()) broken = of_faces(sim);
  const double time = sim.motion.state.time, target = sim.control.target;
  if (broken.empty() && time > target * (1.0 + 1e-12)) {
    broken = fmt::format("time {} is past the event at {}", time, target);
  }
  return broken;
}

}  // namespace edda
