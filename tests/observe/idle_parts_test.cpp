// Warnings of what a model has to no effect, or acts where it cannot.
#include <gtest/gtest.h>

#include <algorithm>

#include "run/prepared.hpp"

namespace edda::idle_parts_test {
namespace {

/// Whether there is a warning with these words.
bool warns(const std::string& more, const std::string& words) {
  const PreparedRun run = testing::prepared(
      "[materials.rock]\ndensity = 2600\nyoung = 1e10\npoisson = 0.25\n[joints.j]\n"
      "friction_angle = 35\n[[block]]\nfixed = true\npolygon = [[0, 0], [10, 0], [10, 1], [0, 1]]\n"
      "[[block]]\npolygon = [[2, 1], [6, 1], [6, 3], [2, 3]]\n" +
      more);
  return std::any_of(run.warnings.begin(), run.warnings.end(), [&](const std::string& warning) {
    return warning.find(words) != std::string::npos;
  });
}

TEST(IdleParts, BoltsWithinABlock) {
  const std::string words = "within a single block and crosses no joint: short";
  const auto bolt = [](const char* to) {
    return std::string(
               "[solver]\nduration = 1\n[[bolt]]\nname = 'short'\ntype = 'end'\n"
               "diameter = 0.025\nfrom = [3, 3]\nto = [3, ") +
           to + "]\n";
  };
  EXPECT_TRUE(warns(bolt("1.5"), words));
  EXPECT_FALSE(warns(bolt("0.5"), words));
}

TEST(IdleParts, WaterBelowAllBlocks) {
  const std::string words = "the table lies below all faces";
  const auto lake = [](const char* level) {
    return std::string("[solver]\nduration = 1\n[[water]]\ntable = [[0, ") + level + "], [10, " +
           level + "]]\n";
  };
  EXPECT_TRUE(warns(lake("0.9"), words));
  EXPECT_FALSE(warns(lake("1.1"), words));
}

/// A sine never ends; a stage with a duration of its own is for it.
TEST(IdleParts, GroundMotionInAStageUntilEquilibrium) {
  const std::string
      words = "acts in a stage until equilibrium",
      quake = "[[shaking]]\nname = 'q'\nacceleration = { amplitude = 1, frequency = 2 }\n",
      rest = "[[stage]]\nuntil = 'equilibrium'\n";
  EXPECT_TRUE(warns(quake + rest, words));
  EXPECT_TRUE(warns(quake + "[[stage]]\nduration = 1\nactivate = ['q']\n" + rest, words));
  EXPECT_FALSE(warns(quake + rest + "[[stage]]\nduration = 1\nactivate = ['q']\n", words));
  EXPECT_FALSE(warns(quake + "[[stage]]\nduration = 1\n" +
                         "[[stage]]\nuntil = 'equilibrium'\ndeactivate = ['q']\n",
                     words));
}

}  // namespace
}  // namespace edda::idle_parts_test
