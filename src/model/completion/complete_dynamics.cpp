#include <fmt/format.h>

#include <algorithm>

#include "model/completion/complete_tools.hpp"
#include "model/files/accelerogram.hpp"
#include "model/files/file_text.hpp"
#include "model/files/input_file.hpp"
#include "model/table/nearest.hpp"
#include "model/table/slots.hpp"

namespace edda {
namespace {

std::string_view name_of(BoundaryType type) {
  return names_of(type)[static_cast<std::size_t>(type)];
}

/// A key that only some types of boundary have.
struct TypeKey {
  std::string_view name;
  std::vector<BoundaryType> types;
  bool required;
  const char* example;
};

const std::vector<TypeKey>& type_keys() {
  using T = BoundaryType;
  static const std::vector<TypeKey> keys{
      {"stiffness", {T::fixed, T::roller, T::velocity, T::displacement}, false, ""},
      {"traction",
       {T::stress},
       true,
       "a traction such as traction = [0.0, -1e5], or an [initial_stress]"},
      {"velocity", {T::velocity}, true, "a velocity such as velocity = [0.01, 0.0]"},
      {"displacement",
       {T::displacement},
       true,
       "a displacement such as displacement = [0.0, -0.01]"},
      {"frictionless", {T::velocity, T::displacement}, false, ""},
      {"wave_speeds", {T::viscous, T::free_field}, false, ""},
      {"history", {T::stress, T::velocity, T::displacement}, false, ""},
  };
  return keys;
}

void check_type(const Value* node, const Boundary& boundary, Reading& reading) {
  for (const TypeKey& key : type_keys()) {
    const bool known =
        std::find(key.types.begin(), key.types.end(), boundary.type) != key.types.end();
    const Value* value = find(node, key.name);
    const std::string path = boundary.where.key + "." + std::string(key.name);
    // A single stiffness may remain from a boundary whose type was changed, and a flag that is not
    // set: they do no harm.
    const bool harmless =
        key.name == "stiffness" || (key.name == "frictionless" && !boundary.frictionless);
    if (value != nullptr && !known && !harmless) {
      std::vector<std::string_view> types;
      for (const BoundaryType t : key.types) types.push_back(name_of(t));
      add_fault(reading, value->place, path,
                fmt::format("does not apply to type \"{}\"", name_of(boundary.type)),
                "leave it out, or give another type: " + quoted_list(types));
    } else if (value == nullptr && known && key.required &&
               !(key.name == "traction" && reading.model.initial_stress)) {
      add_fault(reading, node->place, path, "is missing", std::string("give ") + key.example);
    }
  }
  const bool implicit = reading.model.solver.method == Method::dda;
  const bool springs_or_stress = boundary.type == BoundaryType::fixed ||
                                 boundary.type == BoundaryType::roller ||
                                 boundary.type == BoundaryType::stress;
  if (implicit && !springs_or_stress) {
    add_fault(reading, find(node, "type")->place, boundary.where.key + ".type",
              fmt::format("\"{}\" is not available with method = \"dda\"", name_of(boundary.type)),
              "use method = \"edda\", or another type");
  }
}

/// The columns of a free field are vertical.
void check_upright(const Value* node, const Boundary& boundary, Reading& reading) {
  if (boundary.type != BoundaryType::free_field) return;
  const auto refuse = [&](const char* key) {
    add_fault(reading, find(node, key)->place, boundary.where.key + "." + key,
              "a free-field boundary is vertical", "give sides left or right, or a vertical line");
  };
  for (const std::string& side : boundary.sides) {
    if (side != "left" && side != "right") return refuse("sides");
  }
  for (const Vec2 p : boundary.along) {
    const double height = std::abs(boundary.along.front().y - boundary.along.back().y);
    if (std::abs(p.x - boundary.along.front().x) > 1e-6 * height) return refuse("along");
  }
}

void check_place(const Value* node, const Boundary& boundary, Reading& reading) {
  const bool sides = given(node, "sides"), along = given(node, "along");
  if (sides && along) {
    add_fault(reading, find(node, "along")->place, boundary.where.key + ".along",
              "sides is given too", "give only one of them");
  } else if (!sides && !along) {
    add_fault(reading, node->place, boundary.where.key, "has neither sides nor along",
              "say where it is, such as sides = [\"bottom\"]");
  }
}

std::optional<double> metres_per_s2(AccelerationUnit unit) {
  constexpr double standard_gravity = 9.80665;
  switch (unit) {
    case AccelerationUnit::m_s2:
      return 1.0;
    case AccelerationUnit::g:
      return standard_gravity;
    case AccelerationUnit::cm_s2:
    case AccelerationUnit::gal:
      return 1e-2;
    case AccelerationUnit::mm_s2:
      return 1e-3;
    case AccelerationUnit::as_stated:
      break;
  }
  return std::nullopt;
}

void read_record(const Value* node, Shaking& shaking, Reading& reading) {
  std::string& path = shaking.acceleration.file;
  if (path.empty()) return;
  const std::string key = shaking.where.key + ".acceleration";
  path = beside_model(path, reading.model.file);
  const RecordReading how{shaking.direction, shaking.component, metres_per_s2(shaking.units)};
  Result<Accelerogram> read = read_accelerogram(path, how, key);
  if (read) {
    shaking.record = std::move(read.value());
    return;
  }
  blame(read.faults().front(), path, find(node, "acceleration")->place, reading);
}

void check_directions(const Value* node, const Shaking& shaking, Reading& reading) {
  const auto refuse = [&](const Value* value, const std::string& key) {
    add_fault(reading, value->place, shaking.where.key + key, "has no length",
              "give a direction such as [1.0, 0.0]");
  };
  if (shaking.direction == Vec2{}) refuse(find(node, "direction"), ".direction");
  const Value* sine = find(node, "acceleration");
  if (shaking.acceleration.direction == Vec2{})
    refuse(find(sine, "direction"), ".acceleration.direction");
}

/// The viscous boundary through which an upgoing wave enters.
void find_entrance(const Value* node, Shaking& shaking, Reading& reading) {
  const std::string key = shaking.where.key + ".boundary";
  const Value* named = find(node, "boundary");
  if (shaking.apply != ShakingKind::upgoing) {
    if (named != nullptr) {
      add_fault(reading, named->place, key, "belongs to apply = \"upgoing\"", "leave it out");
    }
    return;
  }
  std::vector<Index> viscous;
  std::vector<std::string_view> names;
  const auto& boundaries = reading.model.boundaries;
  for (std::size_t q = 0; q < boundaries.size(); ++q) {
    if (boundaries[q].type != BoundaryType::viscous) continue;
    viscous.push_back(static_cast<Index>(q));
    names.push_back(boundaries[q].name);
    if (named != nullptr && boundaries[q].name == shaking.boundary)
      shaking.enters = static_cast<Index>(q);
  }
  if (named == nullptr && viscous.size() == 1) shaking.enters = viscous.front();
  if (shaking.enters != none) return;
  std::erase(names, std::string_view{});
  if (viscous.empty()) {
    add_fault(reading, node->place, shaking.where.key + ".apply",
              "\"upgoing\" needs a viscous boundary through which it enters",
              "add a [[boundary]] with type = \"viscous\", or use \"base\" or \"inertia\"");
  } else if (named != nullptr) {
    add_fault(reading, named->place, key,
              "no viscous boundary is called \"" + clipped(shaking.boundary) + '"',
              names.empty() ? "give the viscous boundary that name"
                            : suggestion(shaking.boundary, names));
  } else {
    add_fault(reading, node->place, key, "is missing, and there are several viscous boundaries",
              names.empty() ? "give a name to the one through which the wave enters"
                            : "name one of " + quoted_list(names));
  }
}

/// Either stiffness and strength, or what they follow from. `node`: of the bolt or the pattern.
void check_dowel(const Value* node, const Bolt& bolt, const Where& where, Reading& reading) {
  const Value* dowel = find(node, "dowel");
  if (!is_table(dowel)) return;
  const std::string key = where.key + ".dowel";
  const bool stiffness = given(dowel, "stiffness"), strength = given(dowel, "strength");
  if (stiffness != strength) {
    add_fault(reading, dowel->place, key + (stiffness ? ".strength" : ".stiffness"), "is missing",
              "give stiffness and strength, or neither: then they follow from the bar");
  } else if (!stiffness) {
    if (bolt.type == BoltType::grouted && !bolt.yield_stress) {
      add_fault(reading, node->place, where.key + ".yield_stress",
                "is missing: the strength of the dowel follows from it",
                "give yield_stress = \"500 MPa\", or stiffness and strength of the dowel");
    }
  } else {
    for (const char* other : {"bearing_strength", "foundation_modulus"}) {
      if (!given(dowel, other)) continue;
      add_fault(reading, find(dowel, other)->place, key + "." + other,
                "belongs to a dowel whose stiffness and strength follow from the bar",
                "leave it out, or leave out stiffness and strength");
    }
  }
}

/// Checks the keys that a bolt of its type needs. `node`: of the bolt or the pattern.
void check_bolt(const Value* node, const Bolt& bolt, const Where& where, Reading& reading) {
  const Value* bond = find(node, "bond");
  if (bolt.type == BoltType::grouted) {
    if (bond == nullptr) {
      add_fault(reading, node->place, where.key + ".bond", "is missing",
                "give bond = { stiffness = \"1 GN/m2\", strength = \"400 kN/m\" }, or type = "
                "\"end\"");
    } else if (given(bond, "stiffness") && bolt.bond.stiffness == 0.0) {
      add_fault(reading, bond->place, where.key + ".bond.stiffness", "is zero",
                "give a stiffness above 0");
    }
  } else if (bolt.dowel && (bolt.dowel->of_bar() || bolt.dowel->stiffness.value_or(0.0) > 0.0)) {
    add_fault(reading, find(node, "dowel")->place, where.key + ".dowel",
              "does not apply to type \"end\": it touches nothing between its ends",
              "leave it out, or give type = \"grouted\"");
  }
  constexpr double pi = 3.14159265358979323846;
  const double area = 0.25 * pi * bolt.diameter * bolt.diameter;
  if (bolt.yield_stress && bolt.diameter > 0.0 && bolt.pretension > *bolt.yield_stress * area) {
    add_fault(reading, find(node, "pretension")->place, where.key + ".pretension",
              fmt::format("is more than the {:.4g} N at which the bolt yields",
                          *bolt.yield_stress * area),
              "give less, or a larger diameter");
  }
  const double yields = bolt.yield_stress ? *bolt.yield_stress / bolt.young : 0.0;
  if (bolt.rupture_strain && *bolt.rupture_strain < yields) {
    add_fault(reading, find(node, "rupture_strain")->place, where.key + ".rupture_strain",
              fmt::format("is less than the strain of {:.4g} at which the bolt yields", yields),
              "give more");
  }
  if (reading.model.solver.method == Method::dda) {
    add_fault(reading, node->place, where.key, "bolts are not available with method = \"dda\"",
              implicit_remedy);
  }
}

}  // namespace

void complete_boundaries(const Value& root, Reading& reading) {
  auto& boundaries = reading.model.boundaries;
  for (std::size_t i = 0; i < boundaries.size(); ++i) {
    Boundary& boundary = boundaries[i];
    const Value* node = element(root, "boundary", i);
    if (!is_table(node)) continue;
    check_place(node, boundary, reading);
    check_upright(node, boundary, reading);
    check_type(node, boundary, reading);
    read_history(node, boundary.where.key, boundary.history, boundary.factor, reading);
  }
}

void complete_shakings(const Value& root, Reading& reading) {
  auto& shakings = reading.model.shakings;
  for (std::size_t i = 0; i < shakings.size(); ++i) {
    Shaking& shaking = shakings[i];
    const Value* node = element(root, "shaking", i);
    if (!is_table(node)) continue;
    check_directions(node, shaking, reading);
    read_record(node, shaking, reading);
    find_entrance(node, shaking, reading);
    if (reading.model.solver.method == Method::dda && shaking.apply != ShakingKind::inertia) {
      const Value* apply = find(node, "apply");
      add_fault(reading, apply == nullptr ? node->place : apply->place,
                shaking.where.key + ".apply", "only \"inertia\" is available with method = \"dda\"",
                "use apply = \"inertia\", or method = \"edda\"");
    }
  }
}

void complete_bolts(const Value& root, Reading& reading) {
  Model& model = reading.model;
  for (std::size_t i = 0; i < model.bolts.size(); ++i) {
    const Bolt& bolt = model.bolts[i];
    const Value* node = element(root, "bolt", i);
    if (!is_table(node)) continue;
    check_dowel(node, bolt, bolt.where, reading);
    check_bolt(node, bolt, bolt.where, reading);
    if (given(node, "from") && given(node, "to") && bolt.from == bolt.to) {
      add_fault(reading, find(node, "to")->place, bolt.where.key + ".to", "is where from is",
                "give the other end");
    }
  }
  for (std::size_t i = 0; i < model.bolt_patterns.size(); ++i) {
    const BoltPattern& pattern = model.bolt_patterns[i];
    const Value* node = element(root, "bolt_pattern", i);
    if (!is_table(node)) continue;
    check_dowel(node, pattern.bolt, pattern.where, reading);
    check_bolt(node, pattern.bolt, pattern.where, reading);
    check_opening(node, pattern.where.key, pattern.opening, reading);
  }
}

}  // namespace edda
