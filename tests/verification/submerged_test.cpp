// Cohesion of joints under water, and where they crack: validation.md row 69.
#include <cmath>

#include "verification/factor_of.hpp"
#include "verification/models.hpp"
#include "verification/record.hpp"

namespace edda::submerged_test {
namespace {

constexpr double g = 9.81, density = 2500.0, of_water = 9810.0;

double factor_of(const std::string& toml) {
  return find_factor_of(toml, "tolerance = 0.004\n").factor.value_or(0.0);
}

std::string rock_and_joint(double phi, double cohesion, double tension) {
  return "[materials.rock]\ndensity = 2500\nyoung = 20e9\npoisson = 0.2\n[joints.j]\n"
         "friction_angle = " +
         number(phi) + "\ncohesion = " + number(cohesion) +
         "\ntensile_strength = " + number(tension) + "\n";
}
const std::string stages =
    "[[stage]]\nuntil = 'equilibrium'\n[[stage]]\nuntil = 'equilibrium'\nactivate = ['lake']\n";

/// A block of 4 m x 2 m on a plane of 35 degrees, above which a stage raises a lake: F = (c A + W'
/// cos a tan phi)/(W' sin a) with the weight W' under buoyancy, whatever the depth. The water
/// compresses the block by far more than its weight does.
TEST(Submerged, CohesionStaysUnderALake) {
  const double a = radians(35.0), phi = 40.0, cohesion = 2e4;
  const double weight = (density * g - of_water) * 8.0;
  const double exact =
      (cohesion * 4.0 + weight * std::cos(a) * std::tan(radians(phi))) / (weight * std::sin(a));
  const auto box = [](double u0, double u1, double v0, double v1) {
    return "[" + on_slope(35.0, u0, v0) + "," + on_slope(35.0, u1, v0) + "," +
           on_slope(35.0, u1, v1) + "," + on_slope(35.0, u0, v1) + "]";
  };
  for (const double level : {20.0, 100.0}) {
    const std::string at = number(level);
    const double factor = factor_of(
        rock_and_joint(phi, cohesion, 0.0) + "[[block]]\nfixed = true\npolygon = " +
        box(-10.0, 10.0, -3.0, 0.0) + "\n[[block]]\npolygon = " + box(0.0, 4.0, 0.0, 2.0) +
        "\n[[water]]\nname = 'lake'\ntable = [[-50, " + at + "], [50, " + at + "]]\n" + stages);
    expect_relative({69, "lake of " + at + " m", "factor of safety", ""}, factor, exact, 1e-2);
  }
}

/// A dam of 3 m x 6 m under 5 m of water with uplift: F = (c B + (W - U) tan phi)/H. With a little
/// tensile strength its heel cracks, which takes no cohesion from where it is pressed.
TEST(Submerged, ACrackAtTheHeelOfADamTakesNoCohesion) {
  const double width = 3.0, depth = 5.0, cohesion = 1e5, phi = 30.0;
  const double weight = density * g * width * 6.0, uplift = 0.5 * of_water * depth * width;
  const double exact = (cohesion * width + (weight - uplift) * std::tan(radians(phi))) /
                       (0.5 * of_water * depth * depth);
  for (const double tension : {0.0, 1e4}) {
    const double factor = factor_of(
        rock_and_joint(phi, cohesion, tension) +
        "[[block]]\nfixed = true\npolygon = " + rectangle(-20.0, -3.0, 20.0, 0.0) +
        "\n[[block]]\npolygon = " + rectangle(0.0, 0.0, width, 6.0) +
        "\n[[water]]\nname = 'lake'\ntable = [[-20, 5], [0, 5], [3, 0], [20, 0]]\n" + stages);
    expect_relative(
        {69, "dam, tensile strength " + number(tension / 1e3) + " kPa", "factor of safety", ""},
        factor, exact, 1e-2);
  }
}

}  // namespace
}  // namespace edda::submerged_test
