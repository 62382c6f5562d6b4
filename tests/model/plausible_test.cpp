// Mistakes of units and of signs that no range refuses.
#include "model/completion/plausible.hpp"

#include <gtest/gtest.h>

#include "model/base_model.hpp"
#include "model/read_model.hpp"
#include "model/table/nearest.hpp"

namespace edda::plausible_test {
namespace {

std::vector<std::string> warnings_of(const std::string& text) {
  const Result<Model> model = read_model_text(text, "m.toml");
  EXPECT_TRUE(model.ok()) << (model.ok() ? "" : to_string(model.faults()[0]));
  return model.ok() ? implausible(model.value()) : std::vector<std::string>{};
}

void expect_warning(const std::string& text, const std::string& key, const std::string& part) {
  const auto warnings = warnings_of(text);
  ASSERT_EQ(warnings.size(), 1U) << part;
  EXPECT_EQ(warnings[0].substr(0, key.size() + 2), key + ": ");
  EXPECT_NE(warnings[0].find(part), std::string::npos) << warnings[0];
}

using testing::base_model;
using testing::base_with;

TEST(Plausible, NothingIsReportedOfASoundModel) {
  EXPECT_TRUE(warnings_of(base_model).empty());
  EXPECT_TRUE(warnings_of(base_with("density = 2700.0", "unit_weight = \"26 kN/m3\"")).empty());
}

TEST(Plausible, Materials) {
  expect_warning(base_with("20e9", "20"), "materials.rock.young", "write \"20 GPa\"");
  expect_warning(base_with("20e9", "20000"), "materials.rock.young", "write \"20000 MPa\"");
  expect_warning(base_with("2700.0", "2.7"), "materials.rock.density", "write \"2.7 t/m3\"");
  expect_warning(base_with("2700.0", "26000"), "materials.rock.density",
                 "unit_weight = \"26 kN/m3\"");
  expect_warning(base_with("density = 2700.0", "unit_weight = 26"), "materials.rock.unit_weight",
                 "write \"26 kN/m3\"");
  expect_warning(
      base_with("poisson = 0.25", "poisson = 0.25\nstrength = { ucs = 80, tension = 4 }"),
      "materials.rock.strength.ucs", "write \"80 MPa\"");
}

TEST(Plausible, OneWarningPerQuantity) {
  Model model;
  for (const char* name : {"a", "b", "c"}) {
    Material m{name, 2700.0, 20.0, 0.25, {}};
    m.where.key = std::string("materials.") + name;
    model.materials.push_back(m);
  }
  const auto warnings = implausible(model);
  ASSERT_EQ(warnings.size(), 1U);
  EXPECT_TRUE(warnings[0].starts_with("materials.a.young: 20 Pa"));
  EXPECT_TRUE(warnings[0].ends_with("(and 2 others like it)"));
}

TEST(Plausible, Joints) {
  expect_warning(base_with("friction_angle = 30.0", "friction_angle = 30.0\nkn = 50"),
                 "joints.rough.kn", "write \"50 GPa/m\"");
  expect_warning(base_with("friction_angle = 30.0", "friction_angle = 30.0\nkn = 1e10\nks = 1e5"),
                 "joints.rough.ks", "is 1e-05 of kn = 1e+10 Pa/m");
  EXPECT_TRUE(
      warnings_of(base_with("friction_angle = 30.0", "friction_angle = 30.0\nkn = 1e10\nks = 1e8"))
          .empty());
  expect_warning(base_with("friction_angle = 30.0", "friction_angle = 30.0\ncohesion = 0.1"),
                 "joints.rough.cohesion", "write \"0.1 MPa\"");
  expect_warning(base_with("friction_angle = 30.0", "friction_angle = 30.0\ncohesion = 5"),
                 "joints.rough.cohesion", "write \"5 kPa\"");
}

/// Beyond the apex of Coulomb's law a bond fails in shear, however little shear there is.
TEST(Plausible, TensionBeyondTheApex) {
  const auto joint = [](const std::string& keys) {
    return base_with("friction_angle = 30.0", "friction_angle = 30.0\n" + keys);
  };
  expect_warning(joint("cohesion = 1e4\ntensile_strength = 6e4"), "joints.rough.tensile_strength",
                 "at most 1.732e+04 Pa");
  expect_warning(joint("tensile_strength = 6e4"), "joints.rough.tensile_strength", "at most 0 Pa");
  EXPECT_TRUE(warnings_of(joint("cohesion = 1e4\ntensile_strength = 1.7e4")).empty());
  const std::string slow = "type = 'slip-weakening'\nslip_distance = 0.01\n";  // it is no bond
  EXPECT_TRUE(warnings_of(joint(slow + "cohesion = 1e4\ntensile_strength = 6e4")).empty());
}

TEST(Plausible, StrengthsThatAreMeantAsKilopascals) {
  const auto joint = [](const std::string& keys) {
    return base_with("friction_angle = 30.0", "friction_angle = 30.0\n" + keys);
  };
  expect_warning(joint("cohesion = 50"), "joints.rough.cohesion", "write \"50 kPa\"");
  expect_warning(joint("cohesion = 1e6\ntensile_strength = 200"), "joints.rough.tensile_strength",
                 "write \"200 kPa\"");
  expect_warning(joint("residual = { cohesion = 20 }"), "joints.rough.residual.cohesion",
                 "write \"20 kPa\"");
  EXPECT_TRUE(warnings_of(joint("cohesion = \"50 Pa\"")).empty()) << "the unit says it";
  EXPECT_TRUE(warnings_of(joint("cohesion = 5000")).empty());
}

TEST(Plausible, AnglesInRadians) {
  const auto friction = [](const std::string& angle) {
    return base_with("friction_angle = 30.0", "friction_angle = " + angle);
  };
  expect_warning(friction("0.349"), "joints.rough.friction_angle", "write 20,");
  expect_warning(friction("0.6"), "joints.rough.friction_angle", "write 34.5,");
  EXPECT_TRUE(warnings_of(friction("\"0.349 deg\"")).empty());
  EXPECT_TRUE(warnings_of(friction("\"0.349 rad\"")).empty());
  for (const char* angle : {"0.0", "1.0", "5.0"}) {
    EXPECT_TRUE(warnings_of(friction(angle)).empty()) << angle;
  }
  const auto set = [](const std::string& angle) {
    return base_with("angle = 45.0", "angle = " + angle);
  };
  expect_warning(set("2.094"), "joint_set.bedding.angle", "write 120,");
  expect_warning(set("-0.785398"), "joint_set.bedding.angle", "write -45,");
  expect_warning(set("1.05"), "joint_set.bedding.angle", "write 60,");
  EXPECT_TRUE(warnings_of(set("\"2.094 deg\"")).empty());
  for (const char* angle : {"0.0", "1", "2.0", "2.5", "3.3", "5.0", "-4.1", "2.35", "31.4159"}) {
    EXPECT_TRUE(warnings_of(set(angle)).empty()) << angle;
  }
  expect_warning(base_model +
                     "[[arch]]\ncentre = [50, 0]\nradius = 5\nthickness = 1\ncount = 9\n"
                     "to_angle = 3.14159\n",
                 "arch.0.to_angle", "write 180,");
}

TEST(Plausible, AccelerationsInUnitsOfGravity) {
  const auto ground_motion = [](const std::string& amplitude) {
    return base_model + "[[shaking]]\nacceleration = { frequency = 2, amplitude = " + amplitude +
           " }\n";
  };
  expect_warning(ground_motion("0.3"), "shaking.0.acceleration.amplitude", "write 2.943,");
  EXPECT_TRUE(warnings_of(ground_motion("\"0.3 m/s2\"")).empty());
  EXPECT_TRUE(warnings_of(ground_motion("3.0")).empty());
}

TEST(Plausible, GravityThatPointsUpwards) {
  const std::string up = base_with("[0.0, -9.81]", "[0.0, 9.81]");
  expect_warning(up, "gravity", "write [0, -9.81]");
  EXPECT_TRUE(warnings_of(base_with("[0.0, -9.81]", "[9.81, 0.0]")).empty());
}

TEST(Plausible, BoltsAndWater) {
  const std::string bolt =
      "[[bolt]]\nname = \"b\"\nfrom = [11, 5]\nto = [13, 9]\n"
      "bond = { stiffness = 1e9, strength = 1e5 }\n";
  expect_warning(base_model + bolt + "diameter = 25\n", "bolt.b.diameter", "write \"25 mm\"");
  expect_warning(base_model + bolt + "diameter = 0.025\nyield_stress = 500\n",
                 "bolt.b.yield_stress", "write \"500 MPa\"");
  expect_warning(base_model + "[[water]]\ntable = [[10, 5], [20, 5]]\nunit_weight = 9.81\n",
                 "water.0.unit_weight", "write \"9.81 kN/m3\"");
}

TEST(Plausible, WaterUnderGravityThatIsTilted) {
  const std::string water = "[[water]]\ntable = [[10, 5], [20, 5]]\n";
  const std::string tilted = base_with("[0.0, -9.81]", "[-4.905, -8.4957]");
  expect_warning(tilted + water, "gravity", "draw the model inclined and leave gravity vertical");
  EXPECT_TRUE(warnings_of(tilted).empty());
  EXPECT_TRUE(warnings_of(base_model + water).empty());
}

TEST(Plausible, InitialStressWithCompressionAsPositive) {
  const auto with = [](const std::string& stress) {
    return base_model + "[initial_stress]\nstress = " + stress + "\n";
  };
  expect_warning(with("[5e6, 8e6, 1e6]"), "initial_stress.stress",
                 "write [-5e+06, -8e+06, -1e+06]");
  EXPECT_TRUE(warnings_of(with("[-5e6, -8e6, 1e6]")).empty());
  EXPECT_TRUE(warnings_of(with("[5e6, -8e6, 1e6]")).empty());
  EXPECT_TRUE(warnings_of(with("[1.0, 1.0, 0.0]\ngradient = [2e4, 2e4, 0]\nat_y = 20")).empty());
}

TEST(Nearest, OfNoneSaysSo) {
  EXPECT_EQ(suggestion("a", {}), "the model has none");
}

}  // namespace
}  // namespace edda::plausible_test
