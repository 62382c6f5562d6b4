// [[lining]]: where it is, and its section.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "model/completion/complete_tools.hpp"
#include "model/table/nearest.hpp"

namespace edda {

double Lining::drawn_thickness() const {
  if (thickness) return *thickness;
  return area && inertia ? std::sqrt(12.0 * *inertia / *area) : 0.0;
}

double Lining::solidity() const {
  return area && inertia ? *area / (spacing * drawn_thickness()) : 1.0;
}

namespace {

void check_section(const Value* node, const Lining& lining, Reading& reading) {
  const std::string& path = lining.where.key;
  const bool area = given(node, "area"), inertia = given(node, "inertia");
  if (area != inertia) {
    const char* missing = area ? "inertia" : "area";
    add_fault(reading, node->place, path + "." + missing, "is missing",
              "give area and inertia of a steel set, or a thickness alone");
  } else if (area && given(node, "thickness")) {
    add_fault(reading, find(node, "thickness")->place, path + ".thickness",
              "area and inertia are given, too",
              "give a thickness, or area and inertia of a steel set");
  } else if (!area && !given(node, "thickness")) {
    add_fault(reading, node->place, path + ".thickness", "is missing",
              "give one such as thickness = \"20 cm\", or area, inertia and spacing of steel sets");
  }
}

/// A layer on a lining that comes before it in the file.
void check_layer(const Value& on, const Lining& lining, Reading& reading) {
  std::vector<std::string_view> known;
  for (const Lining& other : reading.model.linings) {
    if (&other == &lining) break;
    if (other.name == lining.on) return;
    if (!other.name.empty()) known.push_back(other.name);
  }
  add_fault(reading, on.place, lining.where.key + ".on",
            "no lining before it is called \"" + clipped(lining.on) + '"',
            known.empty() ? "give the lining below a name, and write it first"
                          : suggestion(lining.on, known));
}

void check_strength(const Value* node, const Lining& lining, Reading& reading) {
  const auto& materials = reading.model.materials;
  const bool has_strength =
      lining.compressive_strength ||
      (lining.material != none && materials[static_cast<std::size_t>(lining.material)].strength);
  const auto belongs = [&](const char* key, bool there, const char* to) {
    if (there || !given(node, key)) return;
    add_fault(reading, find(node, key)->place, lining.where.key + "." + key, to,
              "give that, or leave it out");
  };
  belongs("tensile_strength", lining.compressive_strength.has_value(),
          "belongs to a compressive_strength");
  belongs("plastic_moment", lining.area && has_strength,
          "belongs to the area and compressive_strength of steel sets");
}

/// The residual strength is no more than the one before it, which may be that of a material to
/// which the lining changes.
void check_residual(const Value* node, const Lining& lining, Reading& reading) {
  if (!lining.residual) return;
  const Value* own = find(node, "residual");
  const std::string path = lining.where.key + ".residual";
  if (const Table* keys = std::get_if<Table>(&own->content); keys != nullptr && keys->empty()) {
    add_fault(reading, own->place, path, "gives no strength",
              "give compressive_strength, tensile_strength or both, or leave it out");
    return;
  }
  const RockStrength* of_material = nullptr;
  if (lining.material != none) {
    const auto& strength =
        reading.model.materials[static_cast<std::size_t>(lining.material)].strength;
    of_material = strength ? &*strength : nullptr;
  }
  if (!lining.compressive_strength && of_material == nullptr) {
    add_fault(reading, own->place, path, "belongs to a compressive_strength",
              "give that, or the material a strength = { ucs = ..., tension = ... }");
    return;
  }
  double compressive = lining.compressive_strength.value_or(0.0),
         tensile = lining.tensile_strength.value_or(lining.area ? compressive : 0.0);
  if (!lining.compressive_strength) {
    for (const Material& m : reading.model.materials) {
      if (!m.strength) continue;
      compressive = std::max(compressive, m.strength->ucs);
      tensile = std::max(tensile, m.strength->tension);
    }
  }
  const auto check = [&](const char* key, const std::optional<double>& after, double before) {
    if (!after || *after <= before) return;
    add_fault(reading, find(own, key)->place, path + "." + key,
              fmt::format("is more than before the section yields, {:.6g} Pa", before),
              "give no more than that, or leave it out");
  };
  check("compressive_strength", lining.residual->compressive_strength, compressive);
  check("tensile_strength", lining.residual->tensile_strength, tensile);
}

void check_place(const Value* node, const Lining& lining, Reading& reading) {
  const std::string& path = lining.where.key;
  const Value* on = find(node, "on");
  if (on == nullptr) {
    one_of(node, path, "opening", "along", "opening = \"NAME\"", reading);
    check_opening(node, path, lining.opening, reading);
  } else if (given(node, "opening") || given(node, "along")) {
    add_fault(reading, on->place, path + ".on", "opening or along is given, too",
              "give only one of them");
  } else {
    check_layer(*on, lining, reading);
  }
  const bool from = given(node, "from_angle"), to = given(node, "to_angle");
  if (from != to) {
    add_fault(reading, node->place, path + (from ? ".to_angle" : ".from_angle"), "is missing",
              "give both, or neither for the whole outline");
  } else if (from && !given(node, "opening")) {
    add_fault(reading, find(node, "from_angle")->place, path + ".from_angle",
              "is a part of an opening, and none is given", "leave it out");
  } else if (from && std::remainder(*lining.to_angle - *lining.from_angle, 360.0) == 0.0) {
    add_fault(reading, find(node, "to_angle")->place, path + ".to_angle",
              "is the direction of from_angle", "leave out both for the whole outline");
  }
}

}  // namespace

void check_opening(const Value* node, const std::string& path, const std::string& opening,
                   Reading& reading) {
  std::vector<std::string_view> known;
  for (const Opening& o : reading.model.openings) {
    if (o.name == opening) return;
    if (!o.name.empty()) known.push_back(o.name);
  }
  const Value* name = find(node, "opening");
  if (name == nullptr || opening.empty()) return;
  add_fault(reading, name->place, path + ".opening",
            "no opening is called \"" + clipped(opening) + '"',
            !known.empty()                   ? suggestion(opening, known)
            : reading.model.openings.empty() ? "add an [[opening]]"
                                             : "give the opening that name");
}

void complete_linings(const Value& root, Reading& reading) {
  const Model& model = reading.model;
  for (std::size_t i = 0; i < model.linings.size(); ++i) {
    const Lining& lining = model.linings[i];
    const Value* node = element(root, "lining", i);
    if (!is_table(node)) continue;
    check_section(node, lining, reading);
    check_place(node, lining, reading);
    check_strength(node, lining, reading);
    check_residual(node, lining, reading);
    if (lining.material != none) {
      const Material& m = model.materials[static_cast<std::size_t>(lining.material)];
      if (m.yield || m.foliation)
        add_fault(reading, place_of(node, "material"), lining.where.key + ".material",
                  '"' + m.name + "\" has a yield or a foliation, which beams do not have",
                  "give the lining a material without, and its compressive_strength");
    }
    if (model.solver.method == Method::dda) {
      add_fault(reading, node->place, lining.where.key,
                "linings are not available with method = \"dda\"", implicit_remedy);
    } else if (model.contact.model == ContactModel::points) {
      add_fault(reading, node->place, lining.where.key,
                "linings are not available with contact.model = \"points\"",
                "leave out contact.model = \"points\"");
    }
  }
}

}  // namespace edda
