// Stages until equilibrium: one block that slides away does not hold up the others, the implicit
// method without velocities sees its own rest, and a large wall comes to rest with all defaults.
#include <fstream>
#include <sstream>

#include "verification/ways_to_rest.hpp"

namespace edda::ways_to_rest_test {
namespace {

using namespace ways_to_rest;

/// Its motion would hide that of all others, and the damping that goes by it vanish: 7,312 steps.
TEST(WaysToRest, WhatSlidesAloneHoldsUpNobody) {
  const Rested rested = at_rest(
      wall(8, 8) +
      "[joints.ice]\nfriction_angle = 0.0\n[[block]]\nfixed = true\njoint = 'ice'\npolygon = "
      "[[10, -1], [210, -36.2653961], [210, -37], [10, -37]]\n[[block]]\nname = 'slider'\n"
      "joint = 'ice'\npolygon = [[11, -1.176326981], [12, -1.352653961], "
      "[12.17364818, -0.3678462085], [11.17364818, -0.1915192285]]\n" +
      until_rest);
  EXPECT_LT(rested.outcome.steps, 2500U);
  EXPECT_NE(rested.outcome.message.find("come loose: block 2 (slider)"), std::string::npos)
      << rested.outcome.message;
}

/// Rounds left a thousandth of the forces, and the stage asked for a hundredth of that: it ended as
/// collapsed, with all blocks at 0 m/s.
TEST(WaysToRest, StaticImplicitStepsSeeTheirRest) {
  std::ifstream file(EDDA_SOURCE_DIR "/examples/slope.toml");
  std::ostringstream text;
  text << file.rdbuf();
  std::string slope = text.str();
  slope.resize(slope.find("[solver]"));
  slope.replace(slope.find("friction_angle = 20.0"), 21, "friction_angle = 45.0");
  const Rested implicit =
      at_rest(slope + "[solver]\nmethod = 'dda'\ndynamic = false\n" + until_rest);
  EXPECT_LT(implicit.outcome.unbalanced, 2e-5);
}

TEST(WaysToRest, AWallOfFortyRowsStandsOnItsBase) {
  const Rested rested = at_rest(wall(40, 40) + until_rest);
  EXPECT_LT(rested.outcome.steps, 12000U);
  expect_borne(rested, 1e-3);
}

}  // namespace
}  // namespace edda::ways_to_rest_test
