// Stages until equilibrium: one block that slides away does not delay the others, the implicit
// method without velocities recognises its own equilibrium, and a large wall reaches equilibrium
// with all defaults.
#include <fstream>
#include <sstream>

#include "verification/ways_to_rest.hpp"

namespace edda::ways_to_rest_test {
namespace {

using namespace ways_to_rest;

/// Without the limit on the share of one block in the frequency (theory, section 11.1) its motion
/// would hide that of all others, the adaptive damping would vanish, and the stage would take twice
/// as long.
TEST(WaysToRest, WhatSlidesAloneDelaysNoOther) {
  const EquilibriumRun found = run_to_equilibrium(
      wall(8, 8) +
      "[joints.ice]\nfriction_angle = 0.0\n[[block]]\nfixed = true\njoint = 'ice'\npolygon = "
      "[[10, -1], [210, -36.2653961], [210, -37], [10, -37]]\n[[block]]\nname = 'slider'\n"
      "joint = 'ice'\npolygon = [[11, -1.176326981], [12, -1.352653961], "
      "[12.17364818, -0.3678462085], [11.17364818, -0.1915192285]]\n" +
      until_equilibrium);
  EXPECT_LT(found.outcome.steps, 4000U);
  EXPECT_NE(found.outcome.message.find("come loose: block 2 (slider)"), std::string::npos)
      << found.outcome.message;
}

/// If iterations left a thousandth of the forces unbalanced, where the stage requires a hundredth
/// of that, the run would end as collapsed although all blocks have the velocity 0.
TEST(WaysToRest, StaticImplicitStepsFindTheirEquilibrium) {
  std::ifstream file(EDDA_SOURCE_DIR "/examples/slope.toml");
  std::ostringstream text;
  text << file.rdbuf();
  std::string slope = text.str();
  slope.resize(slope.find("[solver]"));
  slope.replace(slope.find("friction_angle = 20.0"), 21, "friction_angle = 45.0");
  const EquilibriumRun implicit =
      run_to_equilibrium(slope + "[solver]\nmethod = 'dda'\ndynamic = false\n" + until_equilibrium);
  EXPECT_LT(implicit.outcome.unbalanced, 2e-5);
}

TEST(WaysToRest, AWallOfFortyRowsStandsOnItsBase) {
  const EquilibriumRun found = run_to_equilibrium(wall(40, 40) + until_equilibrium);
  EXPECT_LT(found.outcome.steps, 12000U);
  expect_weight_carried(found, 1e-3);
}

}  // namespace
}  // namespace edda::ways_to_rest_test
