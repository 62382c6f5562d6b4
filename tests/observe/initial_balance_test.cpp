// What an initial stress lacks to equilibrium: behind free faces it is to be expected, elsewhere it
// is a mistake.
#include <gtest/gtest.h>

#include <algorithm>

#include "observe/initial_stress_report.hpp"
#include "run/prepared.hpp"

namespace edda::initial_balance_test {
namespace {

struct Slope {
  std::string stress = "k0 = 0.7\nsurface_y = 30";
  double toe = 20.0, crest = 35.0;
  std::string more = {};
};

PreparedRun prepared(const Slope& slope, const char* first = "[[stage]]\nuntil = 'equilibrium'\n") {
  const auto x = [](double value) { return std::to_string(value); };
  return testing::prepared(
      "[materials.rock]\nunit_weight = '26 kN/m3'\nyoung = 5e9\npoisson = 0.25\n[joints.j]\n"
      "friction_angle = 40\n[domain]\noutline = [[0, 0], [60, 0], [60, 30], [" +
      x(slope.crest) + ", 30], [" + x(slope.toe) +
      ", 10], [0, 10]]\n[[joint_set]]\nangle = 10\nspacing = 3\n[[joint_set]]\nangle = 85\n"
      "spacing = 3\n[initial_stress]\n" +
      slope.stress +
      "\n[[boundary]]\nsides = ['left', 'right']\ntype = 'roller'\n[[boundary]]\nsides = "
      "['bottom']\n" +
      slope.more + first);
}

/// The names of the checks that do not hold.
std::vector<std::string> failed_in(const PreparedRun& run) {
  std::vector<Check> checks;
  add_initial_checks(run.sim, checks);
  std::vector<std::string> names;
  for (const Check& check : checks) {
    if (!check.pass) names.push_back(check.name);
  }
  return names;
}

std::vector<std::string> failed(const Slope& slope) {
  const PreparedRun run = prepared(slope);
  EXPECT_GT(run.sim.accounts.initial->unbalanced, 1e-3) << "a free face is unbalanced";
  return failed_in(run);
}

using Names = std::vector<std::string>;

TEST(InitialBalance, ASlopeIsNoMistake) {
  for (const double crest : {20.0, 24.0, 35.0, 50.0}) {
    for (const char* stress :
         {"k0 = 0.7\nsurface_y = 30", "k0 = 1.5\nsurface_y = 30", "k0 = 0.5\nsurface = 'outline'",
          "stress = [0, 0, 0]\nat_y = 30\ngradient = [18e3, 26e3, 0]"}) {
      EXPECT_EQ(failed({stress, 20.0, crest, {}}), Names{}) << stress << ' ' << crest;
    }
  }
}

TEST(InitialBalance, WhatIsUnbalancedWithinTheGroundIs) {
  const std::string within = "initial stress: unbalanced forces within the ground";
  EXPECT_EQ(failed({"stress = [0, 0, 0]\nat_y = 30\ngradient = [18e3, 25e3, 0]"}), Names{within});
  EXPECT_EQ(failed({"stress = [0, 0, 0]\nat_y = 30\ngradient = [18e3, 26e3, 1e3]"}), Names{within});
}

/// The ground above the model is missing, unless a boundary stands for it.
TEST(InitialBalance, SoIsAFreeTopUnderStress) {
  const std::string top = "initial stress: stress that is missing at the free top";
  EXPECT_EQ(failed({"k0 = 0.7\nsurface_y = 60"}), Names{top});
  EXPECT_EQ(failed({"k0 = 0.7\nsurface_y = 60", 20.0, 35.0,
                    "[[boundary]]\nsides = ['top']\ntype = 'stress'\n"}),
            Names{});
  EXPECT_EQ(failed({"stress = [-1e6, -1e6, 0]\nat_y = 30\ngradient = [18e3, 26e3, 0]"}),
            Names{top});
}

/// In deep ground cut and excavated so, below a top that is free or not.
std::vector<std::string> failed_below(const std::string& top, const std::string& cut) {
  return failed_in(testing::prepared(
      "[materials.rock]\nunit_weight = '27 kN/m3'\nyoung = '50 GPa'\npoisson = 0.25\n"
      "[joints.j]\nfriction_angle = 35\n[domain]\n"
      "outline = [[-10, -10], [10, -10], [10, 10], [-10, 10]]\n" +
      cut +
      "[initial_stress]\nk0 = 1.5\nsurface_y = 300\n[[boundary]]\n"
      "sides = ['left', 'right', 'bottom']\ntype = 'roller'\n" +
      top + "[[stage]]\nuntil = 'equilibrium'\n"));
}

const Names top_is_missing{"initial stress: stress that is missing at the free top"};
const std::string stress_on_top = "[[boundary]]\nsides = ['top']\ntype = 'stress'\n";

/// A block round a room, from the bottom to the top of the model: what the bottom carries is no
/// reason to miss the load on the top, nor to find it missing where it is there.
TEST(InitialBalance, ABlockFromTheBottomToTheTopIsNoException) {
  const std::string frame = "[[trace]]\npoints = [[-4, -4], [4, -4], [4, 4], [-4, 4], [-4, -4]]\n";
  EXPECT_EQ(failed_below(stress_on_top, frame), Names{});
  EXPECT_EQ(failed_below("", frame), top_is_missing);
}

/// Between the top and an opening that is open as drawn, which gives way downwards.
TEST(InitialBalance, NorIsTheCrownOfAnOpening) {
  const std::string crown =
      "[[trace]]\npoints = [[-3, 3], [-3, 10]]\n[[trace]]\npoints = [[3, 3], [3, 10]]\n"
      "[[trace]]\npoints = [[-10, -3], [10, -3]]\n[[trace]]\npoints = [[-10, 3], [-3, 3]]\n"
      "[[trace]]\npoints = [[10, 3], [3, 3]]\n[[opening]]\nname = 'room'\n"
      "polygon = [[-3, -3], [3, -3], [3, 3], [-3, 3]]\n";
  EXPECT_EQ(failed_below(stress_on_top, crown), Names{});
  EXPECT_EQ(failed_below("", crown), top_is_missing);
}

/// A stage until equilibrium brings to rest what moves; without one it is said.
TEST(InitialBalance, IsToldWhereNoStageBringsItToRest) {
  const auto told = [](const char* first) {
    const PreparedRun run = prepared({}, first);
    return std::any_of(run.warnings.begin(), run.warnings.end(), [](const std::string& warning) {
      return warning.find("forces are unbalanced at the start") != std::string::npos;
    });
  };
  EXPECT_FALSE(told("[[stage]]\nuntil = 'equilibrium'\n"));
  EXPECT_TRUE(told("[[stage]]\nduration = 1\n"));
}

}  // namespace
}  // namespace edda::initial_balance_test
