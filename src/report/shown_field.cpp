#include "report/shown_field.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace edda {
namespace {

/// The derivation of a number per cell from a name: the array, and one of its components or a
/// combination.
struct Recipe {
  const char* name;
  const char* array;
  const char* label;
  const char* unit;
  ScaleKind kind;
  bool of_contacts;
  double (*value)(const double* v);
  bool along_faces = false;
};

double first(const double* v) {
  return v[0];
}
double second(const double* v) {
  return v[1];
}
double third(const double* v) {
  return v[2];
}
double fourth(const double* v) {
  return v[3];
}
double length(const double* v) {
  return std::hypot(v[0], v[1]);
}
double mean(const double* v) {
  return 0.5 * (v[0] + v[1]);
}
double degrees(const double* v) {
  return v[0] * 180.0 / std::numbers::pi;
}

double without_sign(const double* v) {
  return std::abs(v[0]);
}

constexpr auto kinds = ScaleKind::kinds;
constexpr auto numbers = ScaleKind::numbers;

constexpr std::array recipes{
    Recipe{"id", "id", "block", "", kinds, false, first},
    Recipe{"material", "material", "material", "", kinds, false, first},
    Recipe{"displacement", "displacement", "displacement", "m", numbers, false, length},
    Recipe{"displacement.x", "displacement", "displacement to the right", "m", numbers, false,
           first},
    Recipe{"displacement.y", "displacement", "displacement upwards", "m", numbers, false, second},
    Recipe{"velocity", "velocity", "speed", "m/s", numbers, false, length},
    Recipe{"velocity.x", "velocity", "velocity to the right", "m/s", numbers, false, first},
    Recipe{"velocity.y", "velocity", "velocity upwards", "m/s", numbers, false, second},
    Recipe{"rotation", "rotation", "rotation", "degrees", numbers, false, degrees},
    Recipe{"stress", "stress", "mean stress in the plane (tension positive)", "Pa", numbers, false,
           mean},
    Recipe{"stress.xx", "stress", "stress xx (tension positive)", "Pa", numbers, false, first},
    Recipe{"stress.yy", "stress", "stress yy (tension positive)", "Pa", numbers, false, second},
    Recipe{"stress.zz", "stress", "stress zz (tension positive)", "Pa", numbers, false, third},
    Recipe{"stress.xy", "stress", "shear stress xy", "Pa", numbers, false, fourth},
    Recipe{"principal_stress", "principal_stress", "most compressive stress (tension positive)",
           "Pa", numbers, false, second},
    Recipe{"principal_stress.major", "principal_stress", "most tensile stress (tension positive)",
           "Pa", numbers, false, first},
    Recipe{"principal_stress.minor", "principal_stress",
           "most compressive stress (tension positive)", "Pa", numbers, false, second},
    Recipe{"overstress", "overstress", "part of the rock's strength used", "", numbers, false,
           first},
    Recipe{"plastic_strain", "plastic_strain", "plastic strain", "", numbers, false, first},
    Recipe{"yields", "yields", "whether the rock yields", "", kinds, false, first},
    Recipe{"strength_factor", "strength_factor", "strength factor of the rock", "", numbers, false,
           first},
    Recipe{"pore_pressure", "pore_pressure", "pore pressure", "Pa", numbers, false, first},
    Recipe{"normal_force", "normal_force", "normal force of contacts", "N", numbers, true, first},
    Recipe{"shear_force", "shear_force", "shear force of contacts", "N", numbers, true, first},
    Recipe{"opening", "opening", "opening of contacts", "m", numbers, true, first},
    Recipe{"slip", "slip", "slip of contacts", "m", numbers, true, first},
    Recipe{"state", "state", "state of contacts", "", kinds, true, first},
    Recipe{"normal_stress", "normal_stress", "normal stress on joints (compression positive)", "Pa",
           numbers, true, first, true},
    Recipe{"shear_stress", "shear_stress", "shear stress on joints", "Pa", numbers, true, first,
           true},
    Recipe{"damage", "damage", "part of the strength of joints that cracks have taken", "", numbers,
           true, first, true},
    Recipe{"water_pressure", "water_pressure", "water pressure in joints", "Pa", numbers, true,
           first, true},
    Recipe{"head", "head", "head of the water in joints", "m", numbers, true, first, true},
    Recipe{"discharge", "discharge", "discharge of joints", "m2/s", numbers, true, without_sign,
           true},
    Recipe{"aperture", "aperture", "hydraulic aperture of joints", "m", numbers, true, first, true},
};

const Recipe* recipe_of(const std::string& name) {
  const auto* const recipe =
      std::find_if(recipes.begin(), recipes.end(), [&](const Recipe& r) { return name == r.name; });
  return recipe == recipes.end() ? nullptr : recipe;
}

Fault no_field(const std::string& problem) {
  Fault fault;
  fault.where.key = "--field";
  fault.problem = problem;
  fault.remedy = "use one of " + field_names();
  return fault;
}

}  // namespace

Result<ShownField> shown_field(const std::string& name, const Grid& blocks, const Grid* contacts) {
  if (name.empty() || name == "none") return ShownField{};
  const Recipe* recipe = recipe_of(name);
  if (recipe == nullptr) return no_field("there is no field \"" + name + "\"");
  const Grid* grid = recipe->of_contacts ? contacts : &blocks;
  const Field* field = grid == nullptr ? nullptr : grid->cell_field(recipe->array);
  if (field == nullptr) return no_field("\"" + name + "\" is not in these results");
  ShownField shown{
      recipe->kind, recipe->of_contacts, recipe->along_faces, recipe->label, recipe->unit, {}, {}};
  shown.values.reserve(grid->cell_count());
  for (std::size_t c = 0; c < grid->cell_count(); ++c) {
    shown.values.push_back(recipe->value(field->values.data() + c * field->components));
  }
  if (const Field* length = grid->cell_field("length"); recipe->along_faces && length != nullptr)
    shown.lengths = length->values;
  return shown;
}

bool is_of_contacts(const std::string& name) {
  const Recipe* recipe = recipe_of(name);
  return recipe != nullptr && recipe->of_contacts;
}

std::string field_names() {
  std::string names = "none";
  for (const Recipe& r : recipes) names += std::string(", ") + r.name;
  return names;
}

std::vector<std::string> all_fields() {
  std::vector<std::string> names;
  names.reserve(recipes.size());
  for (const Recipe& r : recipes) names.emplace_back(r.name);
  return names;
}

FieldText field_text(const std::string& name) {
  const Recipe* r = recipe_of(name);
  return r == nullptr ? FieldText{}
                      : FieldText{r->label, r->unit, r->kind, r->of_contacts, r->along_faces};
}

}  // namespace edda
