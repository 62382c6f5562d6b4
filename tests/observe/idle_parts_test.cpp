// Warnings of what a model has to no effect, or acts where it cannot.
#include <gtest/gtest.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

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

/// Stages until equilibrium take no time that joints have.
TEST(IdleParts, JointsThatNeverGrowOld) {
  const std::string words = "joints.clay.decay_time has no effect",
                    clay =
                        "[joints.clay]\nfriction_angle = 30\nresidual = { friction_angle = 20 "
                        "}\ndecay_time = '3 d'\n[contact]\njoint = 'clay'\n",
                    rest = "[[stage]]\nuntil = 'equilibrium'\n";
  EXPECT_TRUE(warns(clay + rest + rest, words));
  EXPECT_FALSE(warns(clay + rest + "[[stage]]\nduration = 1\n", words));
  EXPECT_FALSE(warns(clay + rest + "[[stage]]\nramp = { time = [0, 9] }\n", words));
  EXPECT_FALSE(warns(clay + "[solver]\nduration = 1\n", words));
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

/// A stack on a boundary of some type, shaken along a direction. Whether it is said that the motion
/// reaches no block.
bool reaches_nothing(const std::string& boundaries, const std::string& shaking,
                     const std::string& more = {}) {
  const PreparedRun run = testing::prepared(
      "[materials.rock]\ndensity = 2600\nyoung = 2e10\npoisson = 0.25\n[joints.j]\n"
      "friction_angle = 35\n[domain]\noutline = [[0, 0], [10, 0], [10, 10], [0, 10]]\n"
      "[[joint_set]]\nangle = 0\nspacing = 2.5\norigin = [0, 1]\n" +
      boundaries + "[[shaking]]\nname = 'q'\n" + shaking + more +
      (more.empty() ? "[solver]\nduration = 1\n" : ""));
  return std::any_of(run.warnings.begin(), run.warnings.end(), [](const std::string& warning) {
    return warning.find("reaches no block") != std::string::npos;
  });
}

std::string along(const char* sides, const char* type, const char* name = "b") {
  return std::string("[[boundary]]\nname = '") + name + "'\nsides = [" + sides + "]\ntype = '" +
         type + "'\n";
}

/// A roller moves blocks across its line only, a stress not at all; the rest is the geometry of the
/// two directions.
TEST(IdleParts, GroundMotionThatNothingTakesUp) {
  const std::string across = "acceleration = { amplitude = 2, frequency = 2 }\n",
                    up = "acceleration = { amplitude = 2, frequency = 2, direction = [0, 1] }\n",
                    oblique =
                        "acceleration = { amplitude = 2, frequency = 2, direction = [1, 1] }\n";
  EXPECT_TRUE(reaches_nothing(along("'bottom'", "roller"), across));
  EXPECT_FALSE(reaches_nothing(along("'bottom'", "roller"), up));
  EXPECT_TRUE(reaches_nothing(along("'bottom'", "roller"), oblique));
  EXPECT_FALSE(reaches_nothing(along("'bottom', 'left'", "roller"), oblique));
  EXPECT_FALSE(reaches_nothing(along("'left', 'right'", "roller"), across));
  EXPECT_TRUE(reaches_nothing(along("'left', 'right'", "roller"), up));
  for (const char* type : {"fixed", "viscous"}) {
    for (const std::string& way : {across, up, oblique})
      EXPECT_FALSE(reaches_nothing(along("'bottom'", type), way)) << type;
  }
  EXPECT_FALSE(reaches_nothing(along("'bottom'", "roller"), across + "apply = 'inertia'\n"));
  EXPECT_FALSE(reaches_nothing(along("'bottom'", "roller"), across + "scale = 0\n"));
  EXPECT_FALSE(reaches_nothing(along("'bottom'", "roller"), across,
                               "[[fixed]]\npoint = [5, 2]\n[solver]\nduration = 1\n"));
}

/// A boundary that is gone when the ground moves does not move blocks.
TEST(IdleParts, GroundMotionAfterItsBoundary) {
  const std::string both =
                        along("'bottom'", "fixed", "held") + along("'bottom'", "roller", "later"),
                    sine = "acceleration = { amplitude = 2, frequency = 2 }\n",
                    first = "[[stage]]\nuntil = 'equilibrium'\n";
  EXPECT_TRUE(reaches_nothing(both, sine,
                              first + "[[stage]]\nduration = 1\nactivate = ['later', 'q']\n"
                                      "deactivate = ['held']\n"));
  EXPECT_FALSE(reaches_nothing(both, sine, first + "[[stage]]\nduration = 1\nactivate = ['q']\n"));
}

/// A tilted wall whose coordinates are rounded: what its bricks overlap by is no news where a stage
/// brings them to rest first; where gravity acts at once it is, as soon as it could lift them.
TEST(IdleParts, OverlapsOfRoundedCoordinates) {
  const auto told = [](int decimals, const std::string& end, double shift = 0.0) {
    std::string text =
        "[materials.rock]\ndensity = 2600\nyoung = 1e10\npoisson = 0.25\n[joints.j]\n"
        "friction_angle = 35\n" +
        end;
    const double unit = std::pow(10.0, -decimals);
    for (int row = 0; row < 5; ++row) {
      for (int k = 0; k < 5; ++k) {
        const double x = 0.4 * k + 0.2 * (row % 2), y = 0.3 * row;
        text += row == 0 ? "[[block]]\nfixed = true\npolygon = [" : "[[block]]\npolygon = [";
        for (Vec2 p : {Vec2{x, y}, {x + 0.4, y}, {x + 0.4, y + 0.3}, {x, y + 0.3}}) {
          p = rotated(p, 0.2);
          if (row == 3 && k == 2) p.y -= shift;
          text += fmt::format("[{:.{}f}, {:.{}f}],", unit * std::round(p.x / unit), decimals,
                              unit * std::round(p.y / unit), decimals);
        }
        text += "]\n";
      }
    }
    const PreparedRun run = testing::prepared(text);
    return std::any_of(run.warnings.begin(), run.warnings.end(), [](const std::string& warning) {
      return warning.starts_with("blocks overlap at the start");
    });
  };
  const std::string rest = "[[stage]]\nuntil = 'equilibrium'\n", run = "[solver]\nduration = 1\n";
  for (const int decimals : {3, 4, 5, 6}) EXPECT_FALSE(told(decimals, rest)) << decimals;
  EXPECT_TRUE(told(3, run));
  EXPECT_FALSE(told(6, run));
  EXPECT_TRUE(told(6, rest, 1e-4)) << "drawn into each other by more than rounding";
}

}  // namespace
}  // namespace edda::idle_parts_test
