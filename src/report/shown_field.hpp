// The field that a picture shows in colour: one number per cell of a frame, with its name, unit and
// kind of scale.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "base/fault.hpp"
#include "results/grid.hpp"

namespace edda {

enum class ScaleKind { plain, kinds, numbers };

/// The field `state` by its number: the words of joints.csv.
inline constexpr std::array<const char*, 4> contact_states{"open", "stick", "slide", "bonded"};

struct ShownField {
  ScaleKind kind = ScaleKind::plain;
  bool of_contacts = false;     ///< else of blocks
  bool along_faces = false;     ///< of contacts: drawn as lines from end to end, else as dots
  std::string label;            ///< "displacement"
  std::string unit;             ///< "m"
  std::vector<double> values;   ///< one per cell
  std::vector<double> lengths;  ///< of the faces, m: how much each value counts; else empty
};

/// Field by name: id material displacement velocity rotation stress principal_stress, of which
/// vectors may name a part (displacement.y, stress.xx, principal_stress.minor), plastic_strain,
/// yields and strength_factor of zones; contacts:
/// normal_force shear_force opening slip state normal_stress shear_stress damage, and of those with
/// water water_pressure head discharge aperture. "none" or "" for plain blocks. A fault lists the
/// names.
Result<ShownField> shown_field(const std::string& name, const Grid& blocks, const Grid* contacts);

/// Whether the field is one of contacts.
bool is_of_contacts(const std::string& name);

/// The names, for --help.
std::string field_names();

/// All of them but "none", in the order of --help.
std::vector<std::string> all_fields();

/// Description of a field; name: one of all_fields().
struct FieldText {
  std::string label, unit;
  ScaleKind kind = ScaleKind::numbers;
  bool of_contacts = false, along_faces = false;
};
FieldText field_text(const std::string& name);

}  // namespace edda
