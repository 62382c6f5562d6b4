#include "model/completion/plausible.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

namespace edda {
namespace {

/// Places where one quantity looks wrong: the first is reported, the others are counted.
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

/// The number in a larger unit of `base`, in which it may have been meant: at least `least`.
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

/// Whether the key was written with a unit; then the value is taken as intended.
bool has_unit(const Model& model, const Where& table, const char* key) {
  const KeyPlace* place = find_key_place(model.key_places, table, key);
  return place != nullptr && place->in_words;
}

double degrees_of(double radians) {
  return radians * 180.0 / std::numbers::pi;
}

/// Whether a number may be a direction in radians: a multiple of 5 degrees, rounded.
bool looks_like_radians(double value) {
  constexpr double round = 5.0;  // degrees
  const double size = std::abs(value);
  if (!(size > 0.0) || size > 2.0 * std::numbers::pi) return false;
  double unit = 1.0;  // of its last decimal
  while (unit > 1e-6 && std::abs(size / unit - std::round(size / unit)) > 1e-6) unit /= 10.0;
  if (unit > 0.05) return false;  // 2 and 2.5 degrees are plausible
  const double degrees = degrees_of(size);
  return std::abs(degrees - round * std::round(degrees / round)) <=
         1.05 * degrees_of(0.5 * unit) + 1e-3;
}

std::string radians(const std::string& key, double value) {
  const double meant = degrees_of(value);
  return fmt::format(
      "{}: {:g} degrees looks like radians: write {:g}, or \"{:g} deg\" if it is meant", key, value,
      std::abs(meant) > 1.0 ? std::round(2.0 * meant) / 2.0 : meant, value);
}

/// Directions, among which small ones may be intended.
void check_directions(const Model& model, std::vector<std::string>& warnings) {
  Doubts doubts;
  const auto look = [&](const Where& where, const char* key, double value) {
    if (!gives(model, where, key) || has_unit(model, where, key)) return;
    if (looks_like_radians(value)) doubts.add(radians(where.key + '.' + key, value));
  };
  for (const JointSet& set : model.joint_sets) {
    look(set.where, "angle", set.given_angle.value_or(0.0));
    look(set.where, "dip", set.dip.value_or(0.0));
    look(set.where, "dip_direction", set.dip_direction.value_or(0.0));
  }
  for (const FractureNetwork& network : model.networks) {
    if (looks_like_radians(network.angle.mean))
      doubts.add(radians(network.where.key + ".angle.mean", network.angle.mean));
  }
  for (const Arch& arch : model.arches) {
    look(arch.where, "from_angle", arch.from_angle);
    look(arch.where, "to_angle", arch.to_angle);
  }
  for (const BoltPattern& pattern : model.bolt_patterns) {
    look(pattern.where, "from_angle", pattern.from_angle);
    look(pattern.where, "to_angle", pattern.to_angle);
  }
  if (model.slope) look(model.slope->where, "face_angle", model.slope->face_angle);
  if (model.section) look(model.section->where, "azimuth", model.section->azimuth);
  doubts.report(warnings);
}

/// Gravity that acts upwards, and ground motion given in units of g.
void check_accelerations(const Model& model, std::vector<std::string>& warnings) {
  constexpr double g = 9.81, weak = 1.0;  // m/s2
  const Vec2 down = model.gravity;
  if (down.y > 0.0) {
    warnings.push_back(
        fmt::format("gravity: [{:g}, {:g}] points upwards: y runs upwards: write [{:g}, {:g}]",
                    down.x, down.y, down.x, -down.y));
  }
  Doubts doubts;
  const bool in_words =
      std::any_of(model.key_places.begin(), model.key_places.end(),
                  [](const KeyPlace& place) { return place.key == "amplitude" && place.in_words; });
  for (const Shaking& shaking : model.shakings) {
    const std::string key = shaking.where.key;
    const Acceleration& a = shaking.acceleration;
    const double scale = std::abs(shaking.scale);
    if (a.amplitude && !in_words && std::abs(*a.amplitude) * scale > 0.0 &&
        std::abs(*a.amplitude) * scale < weak) {
      doubts.add(
          fmt::format("{}.acceleration.amplitude: {:g} m/s2 is {:.2g} g, hardly to be felt: "
                      "if {:g} g is meant, write {:g}, else \"{:g} m/s2\"",
                      key, *a.amplitude, std::abs(*a.amplitude) / g, *a.amplitude, *a.amplitude * g,
                      *a.amplitude));
    }
    double peak = 0.0;
    for (const Vec2 row : shaking.record.acceleration) peak = std::max(peak, norm(row));
    if (peak > 0.0 && shaking.scale == 1.0 && peak < weak && !shaking.record.unit_known) {
      doubts.add(
          fmt::format("{}.acceleration: the largest of {} is {:.3g} m/s2, hardly to be felt: "
                      "if the file is in g, write units = \"g\"",
                      key, a.file, peak));
    }
  }
  doubts.report(warnings);
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

/// The mean tension (Pa) at which the shear strength of a joint that breaks as a whole is zero.
std::optional<double> most_tension(const JointLaw& law) {
  const double friction = std::tan(law.peak.friction_angle * std::numbers::pi / 180.0);
  if (law.type != LawType::coulomb || !(friction > 0.0)) return {};
  return law.peak.cohesion / friction;
}

void check_joints(const Model& model, std::vector<std::string>& warnings) {
  constexpr double least_strength = 1e3;  // Pa
  constexpr double right_angle = 0.5 * std::numbers::pi;
  Doubts stiffness, shear, walls, strength, angle, tension;
  for (const JointLaw& law : model.given_joints()) {
    const std::string& key = law.where.key;
    if (law.kn && *law.kn < 1e6) {
      stiffness.add(low(key + ".kn", *law.kn, "Pa/m", "a joint", "Pa/m", 1e8));
    }
    constexpr double least_ratio = 1e-3;
    if (law.kn && law.ks && *law.ks < least_ratio * *law.kn) {
      shear.add(fmt::format(
          "{0}.ks: {1:g} Pa/m is {2:.2g} of kn = {3:g} Pa/m: the joint slides by {4:.2g} m under a "
          "shear stress of 100 kPa before friction acts in full: measured joints have 0.01 to 1 "
          "times kn",
          key, *law.ks, *law.ks / *law.kn, *law.kn, 1e5 / *law.ks));
    }
    if (law.jcs && *law.jcs < 1e4) {
      walls.add(low(key + ".jcs", *law.jcs, "Pa", "rock", "Pa", 1e6));
    }
    const auto look_at_strength = [&](const char* name, double value, const char* what) {
      if (!(value > 0.0) || value >= least_strength || has_unit(model, law.where, name)) return;
      strength.add(low(key + '.' + name, value, "Pa", what, "Pa", least_strength));
    };
    look_at_strength("cohesion", law.peak.cohesion, "a cohesion");
    look_at_strength("tensile_strength", law.peak.tensile_strength, "a strength");
    look_at_strength("residual.cohesion", law.residual.cohesion, "a cohesion");
    const auto look_at_angle = [&](const char* name, double value) {
      if (!(value > 0.0) || value > right_angle || value == 1.0) return;
      if (gives(model, law.where, name) && !has_unit(model, law.where, name))
        angle.add(radians(key + '.' + name, value));
    };
    if (const auto most = most_tension(law); most && law.peak.tensile_strength > *most * 1.001) {
      tension.add(fmt::format(
          "{}.tensile_strength: {:g} Pa is above cohesion/tan(friction_angle), the apex of "
          "Coulomb's "
          "law: the mean tension of a joint is at most {:.4g} Pa, where its shear strength is zero "
          "and it fails: give no more, or a higher cohesion",
          key, law.peak.tensile_strength, *most));
    }
    look_at_angle("friction_angle", law.peak.friction_angle);
    look_at_angle("residual_angle", law.residual_angle.value_or(0.0));
  }
  for (const Doubts* doubts : {&stiffness, &shear, &walls, &strength, &angle, &tension})
    doubts->report(warnings);
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
  const Vec2 down = model.gravity;
  constexpr double upright = 1e-9;
  if (model.waters.empty() || std::abs(down.x) <= upright * norm(down)) return;
  warnings.push_back(fmt::format(
      "gravity: [{:g}, {:g}] is not along -y, but the pressure of [[water]] grows downwards along "
      "y: where gravity is tilted in place of the ground, draw the model inclined and leave "
      "gravity vertical; where its horizontal part stands for an earthquake, this is what is meant",
      down.x, down.y));
}

/// Lowest and highest point of shapes given by corners.
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

/// Whether both principal stresses in the plane are tensile.
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
  check_accelerations(model, warnings);
  check_materials(model, warnings);
  check_joints(model, warnings);
  check_directions(model, warnings);
  check_bolts(model, warnings);
  check_water(model, warnings);
  check_initial_stress(model, warnings);
  return warnings;
}

}  // namespace edda
