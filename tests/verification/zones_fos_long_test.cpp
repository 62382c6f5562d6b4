// Factors of safety of slopes in zones: validation.md rows 76 and 77.
#include "verification/factor_of.hpp"
#include "verification/models.hpp"
#include "verification/record.hpp"

namespace edda::zones_fos_long_test {
namespace {

double factor_of(const std::string& toml) {
  const FosResult found =
      find_factor_of(toml + "[[stage]]\nuntil = 'equilibrium'\n", "tolerance = 0.01\n");
  EXPECT_EQ(found.status, FosStatus::found) << found.message;
  return found.factor.value_or(0.0);
}

std::string ground(const std::string& material, const std::string& outline, double zones) {
  return "gravity = [0, -9.81]\n[materials.soil]\n" + material +
         "[joints.j]\nfriction_angle = 30\n[contact]\njoint = 'j'\n[domain]\nmaterial = 'soil'\n"
         "outline = " +
         outline + "\n[zones]\nsize = " + number(zones) +
         "\n[[boundary]]\nsides = ['left']\ntype = 'roller'\n"
         "[[boundary]]\nsides = ['bottom']\ntype = 'fixed'\n";
}

/// Griffiths and Lane (1999): a slope of 2:1, phi = 20 degrees, c = 0.05 gamma H, under a lake up
/// to its crest, one 0.7 H lower, and dry.
TEST(SlopesOfZones, UnderALakeThatGoesDown) {
  const std::string slope = ground(
      "unit_weight = 20e3\nyoung = 1e8\npoisson = 0.3\n"
      "yield = { friction_angle = 20, cohesion = 10e3, tensile_strength = 27e3 }\n",
      "[[0, 0], [32, 0], [12, 10], [0, 10]]", 0.8);
  struct Case {
    double level, factor;
  };
  for (const auto& [level, factor] : {Case{10.0, 1.85}, Case{3.0, 1.30}, Case{0.0, 1.40}}) {
    const std::string lake =
        "[[water]]\ntable = [[0, " + number(level) + "], [32, " + number(level) + "]]\n";
    expect_relative(
        {76, level > 0.0 ? "lake at " + number(level) + " m" : "dry", "factor of safety", ""},
        factor_of(slope + (level > 0.0 ? lake : "")), factor, 3e-2);
  }
}

/// Taylor (1937): undrained clay, 1:2, firm ground at twice the height: c/(F gamma H) = 0.17.
TEST(SlopesOfZones, ClayWithoutFriction) {
  const std::string slope =
      ground(
          "density = 2000\nyoung = 5e7\npoisson = 0.35\n"
          "yield = { friction_angle = 0, cohesion = 20e3, tensile_strength = 20e3 }\n",
          "[[0, 0], [35, 0], [35, 5], [25, 5], [15, 10], [0, 10]]", 1.0) +
      "[[boundary]]\nsides = ['right']\ntype = 'roller'\n";
  expect_relative({77, "", "factor of safety", ""}, factor_of(slope),
                  20e3 / (0.17 * 2000.0 * 9.81 * 5.0), 2e-2);
}

}  // namespace
}  // namespace edda::zones_fos_long_test
