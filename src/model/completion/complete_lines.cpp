// Joint sets as mapped, fracture networks, imports, regions, pairs and arches: keys that exclude
// each other, defaults that depend on other keys.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>

#include "model/completion/complete_tools.hpp"
#include "model/files/file_text.hpp"
#include "model/table/nearest.hpp"

namespace edda {
namespace {

/// Cosine and sine of degrees, exact at multiples of 90.
Vec2 circle_point(double degrees) {
  const double turn = std::fmod(degrees, 360.0), quarters = turn / 90.0;
  if (quarters == std::round(quarters)) {
    constexpr Vec2 axes[4] = {{1, 0}, {0, 1}, {-1, 0}, {0, -1}};
    return axes[(static_cast<int>(quarters) + 4) % 4];
  }
  const double radians = turn * std::numbers::pi / 180.0;
  return {std::cos(radians), std::sin(radians)};
}

/// The joints of a set on the section, from their dip d, dip direction a and the bearing b of +x.
/// The normal of the joints is (sin d cos(a - b), cos d) on the section, besides a component out of
/// it; planes of spacing s cut the section at the spacing s over the length of this normal on the
/// section, at right angles to it: tan(apparent dip) = tan d cos(a - b).
void project(const Value* node, double azimuth, JointSet& set, Reading& reading) {
  const Vec2 dip = circle_point(*set.dip);
  const Vec2 normal{dip.y * circle_point(*set.dip_direction - azimuth).x, dip.x};
  constexpr double parallel = 1e-6;
  if (norm(normal) < parallel) {
    add_fault(reading, find(node, "dip")->place, set.where.key + ".dip",
              "is that of joints parallel to the section, which leave no trace on it",
              "leave the set out, or change section.azimuth");
    return;
  }
  set.angle = std::atan2(-normal.x, normal.y) * 180.0 / std::numbers::pi;
  set.apparent = 1.0 / norm(normal);
  set.spacing = set.given_spacing * set.apparent;
}

void check_length(const Value* node, const std::string& path, const char* key, double deviation,
                  double mean, JointSpread spread, Reading& reading) {
  const Value* value = find(node, key);
  if (value == nullptr || deviation < mean || deviation == 0.0) return;
  const bool exponential = spread == JointSpread::exponential;
  if (exponential && deviation == mean) return;
  add_fault(
      reading, value->place, path + '.' + key,
      fmt::format("{} is {} the mean of {}", deviation, exponential ? "above" : "not below", mean),
      "give less, so that none comes out at zero or below");
}

void check_deviation(const Value* node, const JointSet& set, Reading& reading) {
  const Value* deviation = find(node, "deviation");
  const std::string path = set.where.key + ".deviation";
  const Deviation& d = set.deviation;
  if (set.given_spacing > 0.0) {
    check_length(deviation, path, "spacing", d.spacing, set.given_spacing, d.distribution, reading);
  }
  for (const char* key : {"trace_length", "gap"}) {
    const double value = *key == 'g' ? d.gap : d.trace_length;
    if (given(node, "trace_length") || value == 0.0) continue;
    add_fault(reading, find(deviation, key)->place, path + '.' + key,
              "the joints extend through the whole domain", "give trace_length, or leave it out");
  }
  if (set.trace_length) {
    check_length(deviation, path, "trace_length", d.trace_length, *set.trace_length, d.distribution,
                 reading);
    if (d.gap > set.gap) {
      add_fault(reading, find(deviation, "gap")->place, path + ".gap",
                fmt::format("{} is above the mean of {}", d.gap, set.gap), "give at most the gap");
    }
  } else if (set.gap > 0.0 && !given(node, "trace_length")) {
    add_fault(reading, find(node, "gap")->place, set.where.key + ".gap",
              "the joints extend through the whole domain", "give trace_length, or leave it out");
  }
}

void complete_joint_set(const Value* node, JointSet& set, Reading& reading) {
  const std::string& path = set.where.key;
  set.spacing = set.given_spacing;
  set.angle = set.given_angle.value_or(0.0);
  check_deviation(node, set, reading);
  if (!given(node, "angle") && !given(node, "dip")) {
    add_fault(reading, node->place, path + ".angle", "is missing",
              "give an angle such as 30.0 or \"30 deg\", or dip and dip_direction");
    return;
  }
  if (given(node, "angle") && given(node, "dip")) {
    add_fault(reading, find(node, "dip")->place, path + ".dip", "angle is given too",
              "give only one of them");
    return;
  }
  if (given(node, "dip_direction") != given(node, "dip")) {
    const bool dip = given(node, "dip");
    add_fault(reading, find(node, dip ? "dip" : "dip_direction")->place,
              path + (dip ? ".dip_direction" : ".dip"), "is missing",
              dip ? "give the bearing of the line of dip, such as 270.0"
                  : "give the dip, or leave dip_direction out");
    return;
  }
  if (!set.dip || !set.dip_direction) return;
  if (!reading.model.section) {
    add_fault(reading, find(node, "dip")->place, path + ".dip", "needs the bearing of the section",
              "add [section] with azimuth, the bearing of +x");
    return;
  }
  project(node, reading.model.section->azimuth, set, reading);
}

/// The beds of a set that runs from bed to bed.
void complete_beds(const Value* node, JointSet& set, Reading& reading) {
  const std::string& path = set.where.key;
  if (given(node, "stagger") && !set.trace_length && set.bounded_by.empty()) {
    add_fault(reading, find(node, "stagger")->place, path + ".stagger",
              "the joints extend through the whole domain",
              "give trace_length or bounded_by, or leave it out");
  }
  if (set.bounded_by.empty()) return;
  const auto fault = [&](std::string problem, std::string remedy) {
    add_fault(reading, find(node, "bounded_by")->place, path + ".bounded_by", std::move(problem),
              std::move(remedy));
  };
  const std::vector<JointSet>& sets = reading.model.joint_sets;
  std::vector<std::string_view> names;
  for (std::size_t i = 0; i < sets.size(); ++i) {
    if (!sets[i].name.empty() && &sets[i] != &set) names.push_back(sets[i].name);
    if (sets[i].name == set.bounded_by && &sets[i] != &set) set.beds = static_cast<Index>(i);
  }
  if (set.beds == none) {
    return fault("no other joint set is called \"" + clipped(set.bounded_by) + '"',
                 names.empty() ? "give the set of beds a name" : suggestion(set.bounded_by, names));
  }
  const JointSet& beds = sets[static_cast<std::size_t>(set.beds)];
  if (beds.trace_length || !beds.bounded_by.empty() || beds.deviation.angle != 0.0) {
    return fault("its joints are no beds: they end in the rock or cross each other",
                 "name a set without trace_length, bounded_by and deviation of the angle");
  }
  if (set.trace_length) return fault("trace_length is given too", "give only one of them");
  constexpr double parallel = 0.02;
  const Vec2 a = circle_point(set.angle), b = circle_point(beds.angle);
  if (std::abs(cross(a, b)) < parallel) {
    fault("its beds run parallel to its joints", "name a set that these joints can end on");
  }
}

void complete_network(const Value* node, const FractureNetwork& network, Reading& reading) {
  const std::string& path = network.where.key;
  one_of(node, path, "p21", "count", "a density such as p21 = 1.2", reading);
  const Value* length = find(node, "length");
  if (!is_table(length)) return;
  const LengthSpread& spread = network.length;
  const auto needed = [&](const char* key, const char* what) {
    if (given(length, key)) return;
    add_fault(reading, length->place, path + ".length." + key, "is missing",
              fmt::format("give the {}, in m", what));
  };
  const auto needless = [&](const char* key, const char* kinds) {
    if (!given(length, key) || (*key == 'd' && spread.deviation == 0.0)) return;
    add_fault(reading, find(length, key)->place, path + ".length." + key,
              fmt::format("belongs to distribution = {}", kinds), "leave it out");
  };
  const bool veneziano = network.model == NetworkModel::veneziano;
  if (veneziano && !given(node, "persistence")) {
    add_fault(reading, node->place, path + ".persistence", "is missing",
              "give the part of each line that is fracture, such as 0.6");
  }
  if (!veneziano && given(node, "persistence")) {
    add_fault(reading, find(node, "persistence")->place, path + ".persistence",
              "belongs to model = \"veneziano\"", "leave it out");
  }
  if (veneziano && spread.distribution != LengthKind::exponential) {
    add_fault(reading, length->place, path + ".length.distribution",
              "the fractures of Veneziano's model have exponential lengths",
              "write distribution = \"exponential\"");
    return;
  }
  if (spread.distribution == LengthKind::power) {
    needless("mean", "\"lognormal\", \"constant\" or \"exponential\"");
    needless("deviation", "\"lognormal\"");
    needed("min", "shortest length");
    needed("max", "longest length");
    if (!given(length, "exponent")) {
      add_fault(reading, length->place, path + ".length.exponent", "is missing",
                "give the power by which the density decreases with the length, such as 2.5");
    }
    if (spread.min && spread.max && *spread.min > *spread.max) {
      add_fault(reading, find(length, "max")->place, path + ".length.max", "is below min",
                "give the longest length");
    }
    return;
  }
  needed("mean", "mean length");
  for (const char* key : {"exponent", "min", "max"}) needless(key, "\"power\"");
  if (spread.distribution != LengthKind::lognormal) needless("deviation", "\"lognormal\"");
}

void complete_import(const Value* node, Import& import, Reading& reading) {
  import.size_given = given(node, "units") || given(node, "scale");
  if (import.file.empty()) return;
  std::string ending = std::filesystem::path(import.file).extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(), [](char c) {
    return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  });
  if (ending != ".dxf" && ending != ".csv" && ending != ".geo") {
    add_fault(reading, find(node, "file")->place, import.where.key + ".file",
              '"' + clipped(import.file) + "\" ends in none of .dxf .csv .geo",
              "export it as one of those, and name it so");
  }
  import.file = beside_model(import.file, reading.model.file);
  if (import.as == ImportAs::blocks) {
    if (ending != ".dxf") {
      add_fault(reading, find(node, "as")->place, import.where.key + ".as",
                "only drawings (.dxf) have closed polylines", "give a drawing, or as = \"lines\"");
    }
    return;
  }
  for (const char* key : {"materials", "fixed"}) {
    if (!given(node, key)) continue;
    add_fault(reading, find(node, key)->place, import.where.key + "." + key,
              "is for blocks, and the file is read as lines",
              "add as = \"blocks\", or leave it out");
  }
  if (reading.model.domain && given(node, "material")) {
    add_fault(reading, find(node, "material")->place, import.where.key + ".material",
              "the blocks are those of the domain", "leave it out, or the domain");
  }
}

template <class Item>
Index named(const std::vector<Item>& items, const std::string& name) {
  const auto found =
      std::find_if(items.begin(), items.end(), [&](const Item& item) { return item.name == name; });
  return found == items.end() ? none : static_cast<Index>(found - items.begin());
}

void complete_pair(const Value* node, ContactPair& pair, Reading& reading) {
  const Model& model = reading.model;
  const Value* between = find(node, "between");
  const std::string path = pair.where.key + ".between";
  if (between == nullptr || !std::holds_alternative<List>(between->content)) return;
  if (std::get<List>(between->content).size() != 2) {
    add_fault(reading, between->place, path, "does not name two",
              "give two joints or two materials, such as [\"rock\", \"talus\"]");
    return;
  }
  if (pair.between.size() != 2) return;  // as was said already
  for (std::size_t i = 0; i < 2; ++i) {
    pair.joints[i] = named(model.joints, pair.between[i]);
    pair.materials[i] = named(model.materials, pair.between[i]);
  }
  const bool joints = pair.joints[0] != none && pair.joints[1] != none;
  const bool materials = pair.materials[0] != none && pair.materials[1] != none;
  if (!joints) pair.joints[0] = pair.joints[1] = none;
  if (!materials) pair.materials[0] = pair.materials[1] = none;
  if (joints || materials) return;
  std::vector<std::string_view> known;
  for (const Material& m : model.materials) known.push_back(m.name);
  for (const JointLaw& law : model.given_joints()) known.push_back(law.name);
  for (std::size_t i = 0; i < 2; ++i) {
    if (std::find(known.begin(), known.end(), pair.between[i]) != known.end()) continue;
    add_fault(reading, child(between, i)->place, fmt::format("{}[{}]", path, i),
              "no joint or material is called \"" + clipped(pair.between[i]) + '"',
              suggestion(pair.between[i], known));
    return;
  }
  add_fault(reading, between->place, path, "names a joint and a material",
            "give two joints or two materials");
}

void check_same_pairs(const Value& root, Reading& reading) {
  const auto& pairs = reading.model.pairs;
  const auto same = [](const Index* a, const Index* b) {
    return a[0] != none && ((a[0] == b[0] && a[1] == b[1]) || (a[0] == b[1] && a[1] == b[0]));
  };
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      if (!same(pairs[i].joints, pairs[j].joints) &&
          !same(pairs[i].materials, pairs[j].materials)) {
        continue;
      }
      add_fault(reading, place_of(element(root, "contact_pair", i), "between"),
                pairs[i].where.key + ".between",
                fmt::format("is the pair of element {} (line {}) too", j, pairs[j].where.line),
                "give each pair one law");
      break;
    }
  }
}

void check_arch(const Value* node, const Arch& arch, Reading& reading) {
  if (arch.radius > 0.0 && arch.thickness >= 2.0 * arch.radius) {
    add_fault(reading, find(node, "thickness")->place, arch.where.key + ".thickness",
              "is not below twice the radius", "give less, the radius is that of the middle line");
  }
  const double turn = arch.to_angle - arch.from_angle;
  if (!(turn > 0.0 && turn <= 360.0)) {
    add_fault(reading, place_of(node, "to_angle"), arch.where.key + ".to_angle",
              fmt::format("lies {} degrees from from_angle", turn),
              "give an angle counter-clockwise from there, at most a full turn");
  } else if (arch.count > 0 && turn / arch.count >= 180.0) {
    add_fault(reading, place_of(node, "count"), arch.where.key + ".count",
              "leaves voussoirs of half a turn", "give more of them");
  }
}

/// Calls what(node, item) for every item that was written as a table.
template <class Item, class What>
void each(const Value& root, std::string_view section, std::vector<Item>& items, What what) {
  for (std::size_t i = 0; i < items.size(); ++i) {
    const Value* node = element(root, section, i);
    if (is_table(node)) what(node, items[i]);
  }
}

}  // namespace

Index glued_law(Reading& reading) {
  auto& joints = reading.model.joints;
  std::string name = "glued";
  for (int number = 2;; ++number) {
    const auto taken = std::find_if(joints.begin(), joints.end(),
                                    [&](const JointLaw& law) { return law.name == name; });
    if (taken == joints.end()) break;
    if (taken->type == LawType::glued) return static_cast<Index>(taken - joints.begin());
    name = fmt::format("glued {}", number);
  }
  JointLaw law;
  law.name = name;
  law.type = LawType::glued;
  law.where = {"joints." + name, reading.file, 0, 0};
  joints.push_back(law);
  return static_cast<Index>(joints.size()) - 1;
}

void complete_lines(const Value& root, Reading& reading) {
  Model& model = reading.model;
  each(root, "joint_set", model.joint_sets,
       [&](const Value* node, JointSet& set) { complete_joint_set(node, set, reading); });
  each(root, "joint_set", model.joint_sets,
       [&](const Value* node, JointSet& set) { complete_beds(node, set, reading); });
  each(root, "fracture_network", model.networks,
       [&](const Value* node, const FractureNetwork& network) {
         complete_network(node, network, reading);
       });
  each(root, "import", model.imports,
       [&](const Value* node, Import& import) { complete_import(node, import, reading); });
  each(root, "arch", model.arches,
       [&](const Value* node, const Arch& arch) { check_arch(node, arch, reading); });
  each(root, "contact_pair", model.pairs,
       [&](const Value* node, ContactPair& pair) { complete_pair(node, pair, reading); });
  check_same_pairs(root, reading);
  each(root, "region", model.regions, [&](const Value* node, Region& region) {
    if (!given(node, "joint")) region.joint = glued_law(reading);
  });
}

}  // namespace edda
