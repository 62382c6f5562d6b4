// Quantities with units: "20 GPa", "26 kN/m3", "3 deg", and the dimensions that a key may require.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace edda {

enum class Dimension {
  plain,  ///< no unit; "%" is understood
  length,
  angle,  ///< degrees
  time,
  density,
  unit_weight,
  stress,
  stiffness,        ///< Pa, that is N/m per metre of thickness: both are understood
  joint_stiffness,  ///< Pa/m
  velocity,
  acceleration,
  load,  ///< N, or Pa where it is distributed along a line
  force,
  line_load,         ///< N/m: a stiffness, or a force per length
  frequency,         ///< Hz
  rate,              ///< 1/s
  angular_velocity,  ///< rad/s
  area,
  per_length,       ///< 1/m
  stress_gradient,  ///< Pa/m
  surface_energy,   ///< J/m2
  second_moment,    ///< of an area, m4
  moment,           ///< N m
  viscosity,        ///< Pa s
  discharge,        ///< m2/s: of a joint, per metre of thickness
};

struct DimensionInfo {
  std::string_view noun;     ///< "a length"
  std::string_view unit;     ///< unit of a plain number: "m"
  std::string_view example;  ///< `2.5 or "2.5 m"`
  int metre = 0, kilogram = 0, second = 0, turn = 0;
  bool degrees = false;  ///< a plain number is in degrees, not radians
};
const DimensionInfo& info(Dimension dimension);

/// A number in the dimension's SI unit (degrees for angles), or what is wrong with the text.
struct Quantity {
  std::optional<double> value;
  std::string problem;  ///< "\"20 GPa\" is not a length"; empty if there is a value
};

/// Reads "NUMBER UNIT". Units: m g t s min h N Pa bar J Hz deg rad % with the prefixes n u m c d k
/// M G T, whole powers ("m3", "m^3", "s-1"), products (blank, * or .) and quotients (/). Correctly
/// rounded for decimal prefixes where the number itself is exact: "57 cm" is 0.57.
Quantity parse_quantity(std::string_view text, Dimension dimension);

}  // namespace edda
