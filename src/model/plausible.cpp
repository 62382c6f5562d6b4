#include "model/plausible.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace edda {
namespace {

/// Places where one quantity looks wrong: said of the first, the others are counted.
class Doubts {
 public:
  void add(std::string text) {
    if (first_.empty()) first_ = std::move(text);
    ++count_;
  }
  void report(std::vector<std::string>& warnings) const {
    if (count_ == 0) return;
    const int others = count_ - 1;
    warnings.push_back(others == 0 ? first_
                                   : fmt::format("{} (and {} other{} like it)", first_, others,
                                                 others == 1 ? "" : "s"));
  }

 private:
  std::string first_;
  int count_ = 0;
};

/// The number as one who wrote it in a larger unit of `base` may have meant it: at least `least`.
std::string in_larger_unit(double value, const char* base, double least) {
  for (const auto& [factor, prefix] : {std::pair(1e3, "k"), {1e6, "M"}, {1e9, "G"}}) {
    if (value * factor >= least || factor == 1e9) {
      return fmt::format("write \"{:g} {}{}\"", value, prefix, base);
    }
  }
  return {};
}

std::string low(const std::string& key, double value, const char* unit, const char* of_what,
                const char* base, double usual) {
  return fmt::format("{}: {:g} {} is very little for {}: {}, or another unit, if that is meant",
                     key, value, unit, of_what, in_larger_unit(value, base, usual));
}

bool gives(const Model& model, const Where& table, const char* key) {
  return find_key_place(model.key_places, table, key) != nullptr;
}

void check_weight(const Model& model, const Material& m, Doubts& doubts) {
  constexpr double least = 100.0, most = 20000.0;  // kg/m3
  if (m.density >= least && m.density <= most) return;
  if (gives(model, m.where, "unit_weight")) {
    const double g = norm(model.gravity) > 0.0 ? norm(model.gravity) : 9.81;
    const double weight = m.density * g;
    doubts.add(fmt::format("{}.unit_weight: {:g} N/m3 is not the weight of a rock: {}", m.where.key,
                           weight,
                           m.density < least ? fmt::format("write \"{:g} kN/m3\"", weight)
                                             : std::string("rock weighs about \"26 kN/m3\"")));
    return;
  }
  doubts.add(fmt::format(
      "{}.density: {:g} kg/m3 is not the density of a rock: {}", m.where.key, m.density,
      m.density < least ? fmt::format("write \"{:g} t/m3\", or unit_weight", m.density)
                        : std::string("a weight is given as unit_weight = \"26 kN/m3\"")));
}

void check_materials(const Model& model, std::vector<std::string>& warnings) {
  Doubts weight, young, strength;
  for (const Material& m : model.materials) {
    check_weight(model, m, weight);
    if (m.young < 1e6) {
      young.add(low(m.where.key + ".young", m.young, "Pa", "rock", "Pa", 1e9));
    }
    if (m.strength && m.strength->ucs > 0.0 && m.strength->ucs < 1e4) {
      strength.add(low(m.where.key + ".strength.ucs", m.strength->ucs, "Pa", "rock", "Pa", 1e6));
    }
  }
  for (const Doubts* doubts : {&weight, &young, &strength}) doubts->report(warnings);
}

void check_joints(const Model& model, std::vector<std::string>& warnings) {
  Doubts stiffness, walls, cohesion;
  for (const JointLaw& law : model.joints) {
    const std::string& key = law.where.key;
    if (law.kn && *law.kn < 1e6) {
      stiffness.add(low(key + ".kn", *law.kn, "Pa/m", "a joint", "Pa/m", 1e8));
    }
    if (law.jcs && *law.jcs < 1e4) {
      walls.add(low(key + ".jcs", *law.jcs, "Pa", "rock", "Pa", 1e6));
    }
    if (law.peak.cohesion > 0.0 && law.peak.cohesion < 10.0) {
      cohesion.add(low(key + ".cohesion", law.peak.cohesion, "Pa", "a cohesion", "Pa", 1e3));
    }
  }
  for (const Doubts* doubts : {&stiffness, &walls, &cohesion}) doubts->report(warnings);
}

void check_bolts(const Model& model, std::vector<std::string>& warnings) {
  Doubts diameter, yield, young;
  const auto look = [&](const Bolt& bolt, const std::string& key) {
    if (bolt.diameter > 0.5) {
      diameter.add(fmt::format("{}.diameter: {:g} m is very thick for a bolt: write \"{:g} {}\"",
                               key, bolt.diameter, bolt.diameter,
                               bolt.diameter < 4.0 ? "cm" : "mm"));
    }
    if (bolt.yield_stress && *bolt.yield_stress < 1e7) {
      yield.add(low(key + ".yield_stress", *bolt.yield_stress, "Pa", "a bolt", "Pa", 1e8));
    }
    if (bolt.young < 1e8) young.add(low(key + ".young", bolt.young, "Pa", "a bolt", "Pa", 1e10));
  };
  for (const Bolt& bolt : model.bolts) look(bolt, bolt.where.key);
  for (const BoltPattern& pattern : model.bolt_patterns) look(pattern.bolt, pattern.where.key);
  for (const Doubts* doubts : {&diameter, &yield, &young}) doubts->report(warnings);
}

void check_water(const Model& model, std::vector<std::string>& warnings) {
  Doubts weight;
  for (const Water& water : model.waters) {
    if (water.unit_weight >= 5000.0 && water.unit_weight <= 50000.0) continue;
    const double w = water.unit_weight;
    weight.add(fmt::format(
        "{}.unit_weight: {:g} N/m3 is not the weight of water: {}", water.where.key, w,
        w < 50.0 ? fmt::format("write \"{:g} kN/m3\"", w) : std::string("write \"9.81 kN/m3\"")));
  }
  weight.report(warnings);
}

/// Lowest and highest point of what is given by corners.
std::optional<Vec2> heights(const Model& model) {
  constexpr double infinite = std::numeric_limits<double>::infinity();
  Vec2 range{infinite, -infinite};
  const auto take = [&](const Ring& ring) {
    for (const Vec2 p : ring) range = {std::min(range.x, p.y), std::max(range.y, p.y)};
  };
  if (model.domain) take(model.domain->outline);
  for (const BlockInput& block : model.blocks) take(block.polygon);
  if (range.x > range.y) return std::nullopt;
  return range;
}

/// Whether both principal stresses in the plane pull.
bool pulls(const InitialStress& initial, double y) {
  Triple s = *initial.stress;
  for (std::size_t k = 0; k < 3; ++k) {
    s[k] += initial.gradient.value_or(Triple{})[k] * (y - initial.at_y.value_or(0.0));
  }
  return s[0] > 0.0 && s[1] > 0.0 && s[0] * s[1] > s[2] * s[2];
}

void check_initial_stress(const Model& model, std::vector<std::string>& warnings) {
  if (!model.initial_stress || !model.initial_stress->stress) return;
  const InitialStress& initial = *model.initial_stress;
  const double level = initial.at_y.value_or(0.0);
  const Vec2 range = heights(model).value_or(Vec2{level, level});
  if (!pulls(initial, range.x) || !pulls(initial, 0.5 * (range.x + range.y))) return;
  const Triple& s = *initial.stress;
  warnings.push_back(
      fmt::format("{}.stress: both principal stresses are tensile: is compression given as "
                  "positive? Tension is positive here: write [{:g}, {:g}, {:g}]",
                  initial.where.key, -s[0], -s[1], s[2] == 0.0 ? 0.0 : -s[2]));
}

}  // namespace

std::vector<std::string> implausible(const Model& model) {
  std::vector<std::string> warnings;
  check_materials(model, warnings);
  check_joints(model, warnings);
  check_bolts(model, warnings);
  check_water(model, warnings);
  check_initial_stress(model, warnings);
  return warnings;
}

}  // namespace edda
