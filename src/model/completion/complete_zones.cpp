#include <fmt/format.h>

#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "model/completion/complete_tools.hpp"

namespace edda {
namespace {

constexpr std::array coulomb_keys{std::pair{"friction_angle", &RockMass::friction_angle},
                                  std::pair{"cohesion", &RockMass::cohesion}};
constexpr std::array index_keys{std::pair{"gsi", &RockMass::gsi}, std::pair{"mi", &RockMass::mi},
                                std::pair{"disturbance", &RockMass::disturbance}};
constexpr std::array constant_keys{std::pair{"m", &RockMass::m}, std::pair{"s", &RockMass::s},
                                   std::pair{"a", &RockMass::a}};

/// The first of these keys that is given.
template <class Keys>
const char* first_given(const RockMass& rock, const Keys& keys) {
  for (const auto& [name, member] : keys)
    if (rock.*member) return name;
  return nullptr;
}

/// Where a table of a material stands, and what its keys begin with.
struct At {
  const Value& table;
  std::string key;
  Reading& reading;
  void fault(const char* name, const std::string& what, const char* remedy) const {
    add_fault(reading, place_of(&table, name), key + "." + name, what, remedy);
  }
};

void check_tension(const At& at, double tension, double apex, const char* formula) {
  if (tension <= apex * (1.0 + 1e-9)) return;
  at.fault("tensile_strength",
           fmt::format("{:.6g} Pa exceeds {}, {:.6g} Pa: shear has no strength beyond", tension,
                       formula, apex),
           "give at most that");
}

void check_coulomb(const At& at, double friction, double dilation, double cohesion,
                   double tension) {
  if (dilation > friction) {
    at.fault("dilation_angle",
             fmt::format("{:.6g} exceeds the friction angle {:.6g}: sliding would make energy",
                         dilation, friction),
             "give a dilation angle of at most the friction angle");
  }
  const double tangent = std::tan(friction * std::numbers::pi / 180.0);
  if (tangent > 0.0)
    check_tension(at, tension, cohesion / tangent, "cohesion / tan(friction_angle)");
}

/// A strength that is whole: of Mohr and Coulomb, or of Hoek and Brown.
void check_rock_mass(const At& at, const RockMass& rock) {
  const char* mixed = nullptr;
  const char* remedy =
      "give friction_angle and cohesion (Mohr and Coulomb), or ucs with gsi and mi "
      "or with m and s (Hoek and Brown)";
  if (!rock.ucs) {
    mixed = first_given(rock, index_keys);
    if (mixed == nullptr) mixed = first_given(rock, constant_keys);
    if (mixed != nullptr) return at.fault(mixed, "Hoek and Brown's criterion needs ucs", remedy);
    if (!rock.friction_angle || !rock.cohesion) {
      add_fault(at.reading, at.table.place, at.key, "the strength of the rock is missing", remedy);
      return;
    }
    return check_coulomb(at, *rock.friction_angle, rock.dilation_angle.value_or(0.0),
                         *rock.cohesion, rock.tensile_strength.value_or(0.0));
  }
  mixed = first_given(rock, coulomb_keys);
  if (mixed != nullptr)
    return at.fault(mixed, "Hoek and Brown's criterion has no such key", remedy);
  mixed = first_given(rock, constant_keys);
  const bool by_index = rock.gsi && rock.mi, by_constants = rock.m && rock.s;
  if (by_index ? mixed != nullptr : !by_constants || first_given(rock, index_keys) != nullptr) {
    return at.fault("ucs", "Hoek and Brown's criterion needs either gsi and mi, or m and s",
                    "give one of the pairs");
  }
  if (by_constants)
    check_tension(at, rock.tensile_strength.value_or(0.0), *rock.s * *rock.ucs / *rock.m,
                  "s ucs / m");
}

/// What both tables of a material that need zones ask of the model.
void check_meshed(const At& at, const Material& material, const char* rock) {
  const auto refuse = [&](const std::string& what, const char* remedy) {
    add_fault(at.reading, at.table.place, at.key, what, remedy);
  };
  if (material.deformation != BlockDeformation::automatic &&
      material.deformation != BlockDeformation::zones) {
    refuse(fmt::format("{} in zones alone", rock),
           "leave out materials.NAME.deformation, or set it to \"zones\"");
  }
  if (at.reading.model.plane == Plane::stress)
    refuse(fmt::format("{} in plane strain alone", rock), "leave out plane = \"stress\"");
}

void check_yield(const At& at, const Material& material) {
  const Yield& y = *material.yield;
  check_rock_mass(at, y.peak);
  if (y.residual) {
    const Value* table = find(&at.table, "residual");
    if (y.residual->ucs && !y.peak.ucs) {
      const At residual{*table, at.key + ".residual", at.reading};
      residual.fault("ucs", "the strength at the peak is that of Mohr and Coulomb",
                     "give friction_angle and cohesion, or ucs at the peak, too");
      return;
    }
    RockMass after = y.after();
    if (!y.residual->tensile_strength) after.tensile_strength.reset();  // no more than it can be
    check_rock_mass({*table, at.key + ".residual", at.reading}, after);
    if (!y.slip_distance) {
      at.fault("residual",
               "without slip_distance the fall of the strength would hang on the size "
               "of the zones",
               "add slip_distance, of some millimetres to centimetres");
    }
  } else if (y.slip_distance) {
    at.fault("slip_distance", "there is no residual strength to fall to", "add residual = { ... }");
  }
  check_meshed(at, material, "rock yields");
}

void check_foliation(const At& at, const Material& material) {
  const FoliationInputs& f = *material.foliation;
  if (f.friction_angle) {
    check_coulomb(at, *f.friction_angle, f.dilation_angle.value_or(0.0), f.cohesion.value_or(0.0),
                  f.tensile_strength.value_or(0.0));
  } else if (const char* name = given(&at.table, "cohesion")           ? "cohesion"
                                : given(&at.table, "tensile_strength") ? "tensile_strength"
                                : given(&at.table, "dilation_angle")   ? "dilation_angle"
                                                                       : nullptr) {
    at.fault(name, "planes that slip have a friction angle", "add friction_angle");
  } else if (!f.is_elastic()) {
    at.fault("angle", "these planes neither slip nor deform",
             "add friction_angle, young, poisson or shear_modulus");
  }
  const double poisson = f.poisson.value_or(material.poisson);
  const double ratio = material.young / f.young.value_or(material.young);
  if (f.is_elastic() && !(2.0 * poisson * poisson * ratio < 1.0 - material.poisson)) {
    at.fault("poisson",
             fmt::format("{:.6g} would let the rock make energy: 2 nu'^2 E/E' must be below 1 - nu",
                         poisson),
             "give a smaller one");
  }
  if (f.is_elastic() && material.yield) {
    add_fault(at.reading, at.table.place, at.key,
              "rock that yields is isotropic before; its foliation slips",
              "leave out young, poisson and shear_modulus of the foliation, or the yield table");
  }
  check_meshed(at, material, "a foliation acts");
}

/// The first material or model key that asks for zones.
std::optional<std::pair<Place, std::string>> asks_for_zones(const Value& root,
                                                            const Reading& reading) {
  const Model& model = reading.model;
  if (model.zones) return std::pair{find(&root, "zones")->place, std::string("zones")};
  if (model.deformation == BlockDeformation::zones)
    return std::pair{place_of(&root, "deformation"), std::string("deformation")};
  for (const Material& m : model.materials) {
    if (m.yield || m.foliation || m.deformation == BlockDeformation::zones)
      return std::pair{Place{m.where.line, 1}, m.where.key};
  }
  return {};
}

}  // namespace

RockMass Yield::after() const {
  RockMass r = *residual;
  const auto take = [&](const auto& keys) {
    for (const auto& [name, member] : keys)
      if (!(r.*member)) r.*member = peak.*member;
  };
  constexpr std::array others{std::pair{"ucs", &RockMass::ucs},
                              std::pair{"tensile_strength", &RockMass::tensile_strength},
                              std::pair{"dilation_angle", &RockMass::dilation_angle}};
  const bool constants = first_given(r, constant_keys) != nullptr,
             index = first_given(r, index_keys) != nullptr;
  take(coulomb_keys);
  take(others);
  if (!constants) take(index_keys);
  if (!index) take(constant_keys);
  return r;
}

void complete_zones(const Value& root, Reading& reading) {
  const Model& model = reading.model;
  for (const Material& material : model.materials) {
    const Value* node = find(find(&root, "materials"), material.name);
    if (!is_table(node)) continue;
    const auto at = [&](const char* name) {
      return At{*find(node, name), material.where.key + "." + name, reading};
    };
    if (material.yield && is_table(find(node, "yield"))) check_yield(at("yield"), material);
    if (material.foliation && is_table(find(node, "foliation")))
      check_foliation(at("foliation"), material);
  }
  const auto asked = asks_for_zones(root, reading);
  if (!asked) return;
  if (model.solver.method == Method::dda) {
    add_fault(reading, asked->first, asked->second, "the implicit method has no zones",
              "leave out solver.method = \"dda\"");
  }
  if (model.contact.model == ContactModel::points) {
    add_fault(reading, asked->first, asked->second,
              "contacts that are points know blocks of one strain alone",
              "leave out contact.model = \"points\"");
  }
}

}  // namespace edda
