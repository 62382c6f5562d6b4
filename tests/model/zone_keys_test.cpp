// Rock that yields and foliations: the one fault that each bad table gives.
#include <gtest/gtest.h>

#include "model/bad_model.hpp"

namespace edda::zone_keys_test {
namespace {

using testing::BadModel;

/// A model whose only material has these lines more, from its line 5 on.
std::string rock(const std::string& lines, const std::string& root = "") {
  return root + "[materials.rock]\ndensity = 2500\nyoung = 8e9\npoisson = 0.25\n" + lines +
         "\n[joints.j]\nfriction_angle = 30\n[contact]\njoint = \"j\"\n[[block]]\n"
         "polygon = [[0, 0], [1, 0], [1, 1], [0, 1]]\n[solver]\nduration = 1\n";
}
BadModel bad(const std::string& lines, const std::string& key, const std::string& fragment) {
  return {lines, rock(lines), {{5, "materials.rock." + key, fragment}}};
}

TEST(ZoneKeys, StrengthsThatAreWhole) {
  for (const char* lines :
       {"yield = { friction_angle = 30, cohesion = 1e6, dilation_angle = 30 }",
        "yield = { friction_angle = 0, cohesion = 1e6, tensile_strength = 5e6 }",
        "yield = { ucs = 4e7, gsi = 40, mi = 9 }", "yield = { ucs = 4e7, m = 1, s = 0 }",
        "yield = { ucs = 4e7, gsi = 60, mi = 9, slip_distance = 0, residual = { gsi = 30 } }",
        "yield = { ucs = 4e7, gsi = 60, mi = 9, slip_distance = 0, residual = { m = 1, s = 0 } }",
        "yield = { friction_angle = 30, cohesion = 1e6, tensile_strength = 1e6, slip_distance = "
        "0.01, residual = { cohesion = 0 } }",
        "foliation = { angle = 30, young = 2e9 }",
        "foliation = { angle = 30, friction_angle = 20, cohesion = 1e5 }"}) {
    const Result<Model> r = read_model_text(rock(lines), "m.toml");
    EXPECT_TRUE(r.ok()) << lines << (r.ok() ? "" : testing::as_lines(r.faults()));
  }
}

TEST(ZoneKeys, Yield) {
  const std::string coulomb = "yield = { friction_angle = 30, cohesion = 1e6, ",
                    brown = "yield = { ucs = 4e7, gsi = 40, mi = 9, ";
  testing::expect_all({
      bad("yield = { friction_angle = 30 }", "yield", "the strength of the rock is missing"),
      bad("yield = { gsi = 40 }", "yield.gsi", "needs ucs"),
      bad("yield = { ucs = 4e7 }", "yield.ucs", "either gsi and mi, or m and s"),
      bad("yield = { ucs = 4e7, gsi = 40 }", "yield.ucs", "either gsi and mi, or m and s"),
      bad("yield = { ucs = 4e7, m = 1 }", "yield.ucs", "either gsi and mi, or m and s"),
      bad(brown + "m = 1 }", "yield.ucs", "either gsi and mi, or m and s"),
      bad(brown + "cohesion = 1e6 }", "yield.cohesion", "has no such key"),
      bad(coulomb + "dilation_angle = 31 }", "yield.dilation_angle", "exceeds the friction angle"),
      bad(coulomb + "tensile_strength = 2e6 }", "yield.tensile_strength",
          "exceeds cohesion / tan(friction_angle)"),
      bad("yield = { ucs = 4e7, m = 1, s = 0.01, tensile_strength = 5e5 }",
          "yield.tensile_strength", "exceeds s ucs / m"),
      bad(coulomb + "residual = { cohesion = 0 } }", "yield.residual", "without slip_distance"),
      bad(coulomb + "slip_distance = 0.01 }", "yield.slip_distance", "no residual strength"),
      bad(coulomb + "slip_distance = 0, residual = { friction_angle = 20, dilation_angle = 25 } }",
          "yield.residual.dilation_angle", "exceeds the friction angle 20"),
      bad(coulomb + "slip_distance = 0, residual = { ucs = 3e7 } }", "yield.residual.ucs",
          "at the peak is that of Mohr and Coulomb"),
  });
}

TEST(ZoneKeys, Foliation) {
  testing::expect_all({
      bad("foliation = { angle = 20 }", "foliation.angle", "neither slip nor deform"),
      bad("foliation = { angle = 20, cohesion = 1e5 }", "foliation.cohesion", "friction angle"),
      bad("foliation = { angle = 20, friction_angle = 20, dilation_angle = 21 }",
          "foliation.dilation_angle", "exceeds the friction angle"),
      bad("foliation = { angle = 20, friction_angle = 45, cohesion = 1e5, tensile_strength = 2e5 }",
          "foliation.tensile_strength", "exceeds cohesion"),
      bad("foliation = { angle = 20, young = 1e9, poisson = 0.3 }", "foliation.poisson",
          "must be below 1 - nu"),
  });
  testing::expect_faults(
      {"both",
       rock("yield = { friction_angle = 30, cohesion = 1e6 }\nfoliation = { angle = 1, young = 1e9,"
            " poisson = 0.1 }"),
       {{6, "materials.rock.foliation", "isotropic before"}}});
}

TEST(ZoneKeys, AskForZones) {
  for (const std::string lines : {"yield = { friction_angle = 30, cohesion = 1e6 }",
                                  "foliation = { angle = 30, friction_angle = 20 }"}) {
    const std::string key = "materials.rock." + lines.substr(0, lines.find(' '));
    testing::expect_faults(
        {lines, rock("deformation = \"corners\"\n" + lines), {{6, key, "in zones alone"}}});
    testing::expect_faults(
        {lines, rock(lines, "plane = \"stress\"\n"), {{6, key, "in plane strain alone"}}});
  }
}

}  // namespace
}  // namespace edda::zone_keys_test
