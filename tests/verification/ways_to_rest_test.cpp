// Stages until equilibrium: one block that slides away does not delay the others, the implicit
// method without velocities recognises its own equilibrium, and a large wall reaches equilibrium
// with all defaults.
#include <algorithm>
#include <cmath>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "observe/balance.hpp"
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
  EXPECT_LT(found.outcome.steps, 7500U);
  EXPECT_NE(found.outcome.message.find("come loose: block 2 (slider)"), std::string::npos)
      << found.outcome.message;
}

/// The largest difference of a vertical stress from what `exact` gives at the height of the block.
template <class Exact>
double largest_difference(const EquilibriumRun& found, Exact exact) {
  const Simulation& sim = found.run.sim;
  double largest = 0.0;
  for (std::size_t i = 0; i < sim.scene->blocks.size(); ++i) {
    const double difference =
        block_stress(sim, sim.motion.state, i).yy - exact(sim.scene->blocks.centroid_y[i]);
    largest = std::max(largest, std::abs(difference));
  }
  return largest;
}

/// A square of blocks between rollers that are fifty times as stiff as its joints, pressed from
/// above. Were friction to act while the load comes on, blocks at the sides, whose inertia is
/// raised, would lag behind, and shear would remain locked in: stresses of 0.5 to 1.2 MPa.
TEST(WaysToRest, WhatPressesFirstLocksNoShearIn) {
  const std::string rollers = "type = 'roller'\nstiffness = 1e12\n";
  const EquilibriumRun found = run_to_equilibrium(
      "gravity = [0, 0]\n[materials.rock]\ndensity = 2600\nyoung = 10e9\npoisson = 0.2\n"
      "[joints.j]\nfriction_angle = 40\nkn = 20e9\nks = 8e9\n[domain]\njoint = 'j'\n"
      "outline = " +
      rectangle(0.0, 0.0, 8.0, 8.0) +
      "\n[[joint_set]]\nangle = 0\nspacing = 1\n[[joint_set]]\nangle = 90\nspacing = 1\n"
      "[[boundary]]\nsides = ['left', 'right']\n" +
      rollers + "[[boundary]]\nsides = ['bottom']\n" + rollers +
      "[[boundary]]\nsides = ['top']\ntype = 'stress'\ntraction = [0, -1e6]\n" + until_equilibrium);
  EXPECT_LT(largest_difference(found, [](double) { return -1e6; }), 1e4);
}

/// A column a tenth of a metre wide beside one of 1.9 m: each carries its own weight. Where masses
/// are scaled the narrow one follows more slowly; with friction from the start its lower blocks
/// would lack 22 and 38 kPa. (What the uppermost one lacks is 11 kPa of 13.)
TEST(WaysToRest, ANarrowColumnCarriesItsOwnWeight) {
  const std::string text =
      "[materials.rock]\ndensity = 2600\nyoung = 10e9\npoisson = 0.2\n[joints.j]\n"
      "friction_angle = 40\nkn = 20e9\nks = 8e9\n[domain]\njoint = 'j'\noutline = " +
      rectangle(0.0, 0.0, 2.0, 4.0) +
      "\n[[joint_set]]\nangle = 0\nspacing = 1\n[[trace]]\npoints = [[0.1, 0], [0.1, 4]]\n"
      "[[boundary]]\nsides = ['left', 'right', 'bottom']\ntype = 'roller'\n" +
      std::string(until_equilibrium);
  const auto weight = [](double y) { return -2600.0 * 9.81 * (2.0 - y); };  // y from mid-height
  EXPECT_LT(largest_difference(run_to_equilibrium(text), weight), 12e3);
  EXPECT_LT(largest_difference(run_to_equilibrium(text + "masses = 'as given'\n"), weight), 700.0);
}

/// Columns of these widths (m) and of this height, cut into rows, between rollers.
std::string columns(const std::vector<double>& widths, double height, int rows,
                    const std::string& stiffness) {
  std::string text =
      "[materials.rock]\ndensity = 2500\nyoung = 10e9\npoisson = 0.2\n[joints.j]\n"
      "friction_angle = 35\n" +
      stiffness + "[domain]\njoint = 'j'\n";
  double x = 0.0;
  std::string traces;
  for (const double width : widths) {
    x += width;
    if (width != widths.back())
      traces += "[[trace]]\npoints = [[" + number(x) + ", 0], [" + number(x) + ", " +
                number(height) + "]]\n";
  }
  for (int row = 1; row < rows; ++row) {
    const std::string y = number(row * height / rows);
    traces += "[[trace]]\npoints = [[0, " + y + "], [" + number(x) + ", " + y + "]]\n";
  }
  return text + "outline = " + rectangle(0.0, 0.0, x, height) + "\n" + traces +
         "[[boundary]]\nname = 'sides'\nsides = ['left', 'right', 'bottom']\ntype = 'roller'\n";
}

/// Without a stiffness blocks of all widths deform alike: each column carries its share of a load.
/// (Springs of one stiffness at the ends of all faces gave narrow ones three times as much.)
TEST(WaysToRest, NarrowBlocksCarryTheirShareByDefault) {
  const EquilibriumRun found = run_to_equilibrium(
      "gravity = [0, 0]\n" + columns({1.5, 0.1, 2.0, 0.5, 1.0}, 4.0, 4, "") +
      "[[boundary]]\nsides = ['top']\ntype = 'stress'\ntraction = [0, -1e6]\n" + until_equilibrium);
  EXPECT_LT(largest_difference(found, [](double) { return -1e6; }), 1e5);
}

/// And flat ones: H sigma (1 - nu^2)/E between smooth walls, and a twentieth for the joints.
TEST(WaysToRest, FlatBlocksSettleAsTheRockDoes) {
  const EquilibriumRun found = run_to_equilibrium(
      "gravity = [0, 0]\nplane = 'stress'\n" + columns({20.0}, 3.0, 10, "") +
      "[[boundary]]\nsides = ['top']\ntype = 'stress'\ntraction = [0, -1e6]\n" + until_equilibrium);
  const Simulation& sim = found.run.sim;
  double most = 0.0;
  for (std::size_t v = 0; v < sim.scene->blocks.vertex_count(); ++v)
    most = std::max(most, sim.scene->blocks.vertex_y[v] - sim.motion.pose.y[v]);
  const double rock = 3.0 * 1e6 * (1.0 - 0.2 * 0.2) / 10e9;
  EXPECT_NEAR(most / rock, 1.05, 0.02);
}

/// A load that comes and goes leaves little behind where blocks of several widths have their
/// inertia raised: shear between them that friction then locks in.
TEST(WaysToRest, WhatIsUnloadedForgetsItsLoad) {
  const EquilibriumRun found = run_to_equilibrium(
      columns({1.5, 0.5, 2.0, 0.5, 1.0}, 4.0, 4, "kn = 20e9\nks = 8e9\n") +
      "[initial_stress]\nk0 = 0.5\nsurface_y = 4\n[[load]]\nname = 'q'\nalong = [[0, 4], [5.5, "
      "4]]\n"
      "pressure = 1e6\n[[stage]]\nuntil = 'equilibrium'\n[[stage]]\nuntil = 'equilibrium'\n"
      "activate = ['q']\n[[stage]]\nuntil = 'equilibrium'\ndeactivate = ['q']\n");
  const auto weight = [](double y) { return -2500.0 * 9.81 * (2.0 - y); };  // y from mid-height
  EXPECT_LT(largest_difference(found, weight), 8e3);
}

/// Blocks drawn a tenth of a millimetre apart fall on each other before a stage ends.
TEST(WaysToRest, BlocksDrawnApartLand) {
  std::string text =
      "[materials.rock]\ndensity = 2500\nyoung = 10e9\npoisson = 0.2\n[joints.j]\n"
      "friction_angle = 30\n[contact]\njoint = 'j'\n[[block]]\nfixed = true\npolygon = " +
      rectangle(-1.0, -1.0, 3.0, 0.0) + "\n";
  for (int i = 0; i < 5; ++i) {
    const double low = i + 1e-4 * (i + 1);
    text += "[[block]]\npolygon = " + rectangle(0.0, low, 2.0, low + 1.0) + "\n";
  }
  const EquilibriumRun found = run_to_equilibrium(text + until_equilibrium);
  expect_weight_carried(found, 1e-4);
  EXPECT_EQ(balance_of(found.run.sim).detached, 0u);
}

/// Where nothing acts yet, blocks that lie on each other without any load do not fall.
TEST(WaysToRest, ARampOfTheWeightFromNothing) {
  const EquilibriumRun found = run_to_equilibrium(
      "[materials.rock]\ndensity = 2600\nyoung = 10e9\npoisson = 0.2\n[joints.j]\n"
      "friction_angle = 30\n[contact]\njoint = 'j'\n[[block]]\nfixed = true\npolygon = " +
      rectangle(-1.0, -1.0, 2.0, 0.0) + "\n[[block]]\npolygon = " + rectangle(0.0, 0.0, 1.0, 1.0) +
      "\n[[stage]]\nuntil = 'equilibrium'\nramp = { gravity = [0, 1], steps = 5 }\n");
  EXPECT_LT(found.outcome.largest_energy_error, 1e-3);
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
