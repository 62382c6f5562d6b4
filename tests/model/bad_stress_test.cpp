// Bad initial stress, convergence lines and rock strength, with exactly the fault each must give.
#include <gtest/gtest.h>

#include "model/base_model.hpp"
#include "model/read_model.hpp"

namespace edda::bad_stress_test {
namespace {

struct Bad {
  std::string text;  ///< after the base model, from its line 42 on
  int line;
  std::string key, fragment;
};

void expect_fault(const Bad& bad) {
  const Result<Model> result = read_model_text(testing::base_model + bad.text, "m.toml", {});
  ASSERT_FALSE(result.ok()) << bad.text;
  ASSERT_EQ(result.faults().size(), 1U) << bad.text << to_string(result.faults()[1]);
  const Fault& f = result.faults()[0];
  EXPECT_EQ(f.where.line, bad.line) << to_string(f);
  EXPECT_EQ(f.where.key, bad.key) << to_string(f);
  EXPECT_NE(to_string(f).find(bad.fragment), std::string::npos) << to_string(f);
}

TEST(BadModel, InitialStress) {
  const std::string head = "[initial_stress]\n", tensor = head + "stress = [-1e6, -1e6, 0]\n",
                    weight = head + "k0 = 0.5\n";
  for (const Bad& bad : {
           Bad{head, 42, "initial_stress", "neither stress nor k0"},
           Bad{tensor + "k0 = 1\n", 44, "initial_stress.k0", "stress is given too"},
           Bad{tensor + "surface_y = 1\n", 44, "initial_stress.surface_y", "has no effect"},
           Bad{tensor + "surface = \"outline\"\n", 44, "initial_stress.surface", "has no effect"},
           Bad{weight, 42, "initial_stress.surface_y", "is missing"},
           Bad{weight + "surface_y = 10\nat_y = 1\n", 45, "initial_stress.at_y", "has no effect"},
           Bad{weight + "surface_y = 10\ngradient = [0, 1, 0]\n", 45, "initial_stress.gradient",
               "has no effect"},
           Bad{weight + "surface_y = 9.5\n", 44, "initial_stress.surface_y",
               "below the top of the outline at 10"},
           Bad{weight + "surface = \"outline\"\nsurface_y = 10\n", 45, "initial_stress.surface_y",
               "give only one of them"},
           Bad{weight + "surface = \"above\"\nsurface_y = 10\n", 44, "initial_stress.surface",
               "not known"},
           Bad{head + "stress = [-1e6, -1e6]\n", 43, "initial_stress.stress",
               "has 2 numbers, not three"},
           Bad{head + "stress = -1e6\n", 43, "initial_stress.stress", "three numbers such as"},
           Bad{head + "stress = [-1e6, \"3 m\", 0]\n", 43, "initial_stress.stress[1]",
               "is not a stress"},
           Bad{tensor + "gradient = [0, \"27 kPa\", 0]\n", 44, "initial_stress.gradient[1]",
               "is not a stress per length"},
           Bad{head + "k0 = -1\nsurface_y = 10\n", 43, "initial_stress.k0", "out of range"},
       }) {
    expect_fault(bad);
  }
}

TEST(BadModel, WeightWithoutGravityOrOutline) {
  std::string text = testing::base_with("gravity = [0.0, -9.81]", "gravity = [9.81, 0.0]");
  const auto sideways =
      read_model_text(text + "[initial_stress]\nk0 = 1\nsurface_y = 20\n", "m.toml", {});
  ASSERT_FALSE(sideways.ok());
  EXPECT_EQ(sideways.faults()[0].where.key, "initial_stress.k0");
  const std::string blocks =
      "[materials.rock]\ndensity = 2700\nyoung = 2e10\npoisson = 0.2\n[joints.j]\nfriction_angle = "
      "30\n[[block]]\npolygon = [[0, 0], [1, 0], [1, 1]]\n[solver]\nduration = 1\n"
      "[initial_stress]\nk0 = 1\nsurface = \"outline\"\n";
  const auto bare = read_model_text(blocks, "m.toml", {});
  ASSERT_FALSE(bare.ok());
  EXPECT_EQ(bare.faults()[0].where.key, "initial_stress.surface");
}

TEST(BadModel, StressBoundaryWithoutAStress) {
  expect_fault({"[[boundary]]\nsides = [\"top\"]\ntype = \"stress\"\n", 42, "boundary.1.traction",
                "or an [initial_stress]"});
  const auto fine = read_model_text(testing::base_model +
                                        "[[boundary]]\nsides = [\"top\"]\ntype = \"stress\"\n"
                                        "[initial_stress]\nstress = [-1e6, -1e6, 0]\n",
                                    "m.toml", {});
  EXPECT_TRUE(fine.ok());
}

TEST(BadModel, ConvergenceAndStrength) {
  for (const Bad& bad : {
           Bad{"[[convergence]]\nbetween = [[11, 1], [12, 1]]\n", 42, "convergence.0.name",
               "is missing"},
           Bad{"[[convergence]]\nname = \"H\"\n", 42, "convergence.H.between", "is missing"},
           Bad{"[[convergence]]\nname = \"H\"\nbetween = [[1, 1], [2, 1], [3, 1]]\n", 44,
               "convergence.H.between", "has 3 points, not two"},
           Bad{"[[convergence]]\nname = \"H\"\nbetween = [[1, 1], [1, 1]]\n", 44,
               "convergence.H.between[1]", "is the same point"},
       }) {
    const Result<Model> result = read_model_text(testing::base_model + bad.text, "m.toml", {});
    ASSERT_FALSE(result.ok()) << bad.text;
    const Fault& f = result.faults()[0];
    EXPECT_EQ(f.where.key, bad.key) << to_string(f);
    EXPECT_NE(to_string(f).find(bad.fragment), std::string::npos) << to_string(f);
  }
  for (const auto& [strength, key] :
       {std::pair<std::string, std::string>{"{ ucs = 1e6 }", "materials.rock.strength.tension"},
        {"{ ucs = 0, tension = 1 }", "materials.rock.strength.ucs"}}) {
    const auto result = read_model_text(
        testing::base_with("poisson = 0.25\n", "poisson = 0.25\nstrength = " + strength + "\n"),
        "m.toml", {});
    ASSERT_FALSE(result.ok()) << strength;
    EXPECT_EQ(result.faults()[0].where.key, key);
    EXPECT_EQ(result.faults()[0].where.line, 7);
  }
}

}  // namespace
}  // namespace edda::bad_stress_test
