// Blocks that bend, against beams and balances.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "run/prepared.hpp"
#include "step/energy_balance.hpp"
#include "step/step.hpp"
#include "verification/models.hpp"

namespace edda::bent_blocks_test {
namespace {

using testing::ran;
using testing::Ran;

/// Ten glued squares of 1 m, fixed at the left, under a force at the right end; `deformation`.
std::string cantilever(const std::string& deformation, double length = 1.0) {
  std::string text = "deformation = '" + deformation + "'\n" + R"(gravity = [0, 0]
[materials.rock]
density = 2600
young = 2e10
poisson = 0.2
[joints.j]
type = 'glued'
[[block]]
polygon = [[-2, -1], [0, -1], [0, 2], [-2, 2]]
fixed = true
)";
  for (double x = 0.0; x < 10.0 - 1e-9; x += length) {
    text += "[[block]]\nname = 'b" + std::to_string(static_cast<int>(x)) +
            "'\npolygon = " + rectangle(x, 0.0, x + length, 1.0) + "\n";
  }
  return text +
         "[[load]]\npoint = [10, 0.5]\nforce = [0, -1e4]\n[[stage]]\nuntil = 'equilibrium'\n";
}

/// Deflection of the beam with shear at x, and of its joints, which are a 20th (a 57th in bending)
/// as compliant as the rock.
double deflection(double x) {
  const double p = 1e4, l = 10.0, young = 20e9 / 0.96, shear = 20e9 / 2.4;
  return p * (x * x * (3.0 * l - x) / (6.0 * young / 12.0) * (1.0 + 1.0 / 57.0) +
              1.2 * x / shear * (1.0 + 1.0 / 20.0));
}

TEST(BentBlocks, ACantileverOfGluedBlocksBendsAsABeam) {
  for (const auto& [length, last, within] : {std::tuple{1.0, "b9", 0.01}, {2.0, "b8", 0.04}}) {
    const Ran r = ran(cantilever("corners", length));
    EXPECT_EQ(r.outcome.status, Status::equilibrium);
    EXPECT_LT(r.outcome.largest_energy_error, 1e-8);
    const double exact = deflection(10.0 - 0.5 * length);
    EXPECT_NEAR(-r.moved(last).y / exact, 1.0, within) << length;
  }
}

const std::string implicit = "[solver]\nmethod = 'dda'\ndynamic = false\n";

/// At rest by the implicit method it is where the explicit one leaves it.
TEST(BentBlocks, ACantileverIsTheSameByTheImplicitMethod) {
  const Ran e = ran(cantilever("corners")), i = ran(cantilever("corners") + implicit);
  EXPECT_EQ(i.outcome.status, Status::equilibrium);
  EXPECT_LT(i.outcome.largest_energy_error, 1e-8);
  for (const char* block : {"b3", "b9"})
    EXPECT_NEAR(i.moved(block).y / e.moved(block).y, 1.0, 1e-5) << block;
}

TEST(BentBlocks, UniformBlocksDoNotBend) {
  const Ran r = ran(cantilever("uniform"));
  EXPECT_LT(-r.moved("b9").y, 0.05 * deflection(9.5));
}

/// A bond between two courses of blocks gives way at the T-nodes: a wall two courses high between
/// rollers, pressed down by a uniform traction, has this stress everywhere.
TEST(BentBlocks, UniformStressIsUniformInABond) {
  std::string text = R"(deformation = 'corners'
gravity = [0, 0]
[materials.rock]
density = 2600
young = 10e9
poisson = 0.25
[joints.j]
type = 'glued'
[domain]
outline = [[0, 0], [6, 0], [6, 4], [0, 4]]
joint = 'j'
)";
  for (int row = 0; row < 4; ++row) {
    if (row > 0)
      text += "[[trace]]\npoints = [[0, " + std::to_string(row) + "], [6, " + std::to_string(row) +
              "]]\n";
    for (int k = 0; k < 6; ++k) {
      const double x = k + (row % 2 == 0 ? 0.37 : 0.81);
      text += "[[trace]]\npoints = [[" + std::to_string(x) + ", " + std::to_string(row) + "], [" +
              std::to_string(x) + ", " + std::to_string(row + 1) + "]]\n";
    }
  }
  text += R"([[boundary]]
sides = ['left', 'bottom', 'right']
type = 'roller'
[[boundary]]
sides = ['top']
type = 'stress'
traction = [0, -1e6]
[[stage]]
until = 'equilibrium'
ratio = 1e-9
)";
  const Ran r = ran(text);
  EXPECT_EQ(r.outcome.status, Status::equilibrium) << r.outcome.message;
  const Simulation& sim = r.ready.sim;
  EXPECT_TRUE(sim.scene->blocks.bending.any());
  for (std::size_t i = 0; i < sim.scene->blocks.size(); ++i) {
    const Tensor s = stress_of(sim, i);
    EXPECT_NEAR(s.yy, -1e6, 2e-3 * 1e6) << i;
    EXPECT_NEAR(s.xy, 0.0, 2e-3 * 1e6) << i;
  }
}

/// In its initial stress, which grows with depth, ground neither bends nor moves.
TEST(BentBlocks, GroundInItsInitialStressDoesNotBend) {
  for (const std::string& solver : {std::string(), implicit}) {
    const Ran r = ran(solver + R"([materials.rock]
density = 2600
young = 10e9
poisson = 0.25
[joints.j]
friction_angle = 40
[domain]
outline = [[0, 0], [10, 0], [10, 10], [0, 10]]
joint = 'j'
[voronoi]
size = 2
[initial_stress]
k0 = 0.6
surface_y = 30
[[boundary]]
sides = ['left', 'right', 'bottom']
type = 'roller'
[[boundary]]
sides = ['top']
type = 'stress'
[[stage]]
duration = 0.02
)");
    const State& s = r.ready.sim.motion.state;
    ASSERT_GT(s.position.modes.size(), 50u);
    double most = 0.0;
    for (std::size_t m = 0; m < s.position.modes.size(); ++m)
      most = std::max(most, norm(s.position.modes[m]));
    // m; the stress strains the blocks by 2e-4. What faces carry at their ends lies inward of
    // corners by a part of their closure.
    EXPECT_LT(most, 1e-7) << solver;
  }
}

/// Blocks that fall on each other keep energy, momentum and angular momentum.
TEST(BentBlocks, KeepEnergyInAHeap) {
  std::string text = R"(deformation = 'corners'
[materials.rock]
density = 2500
young = 1e8
poisson = 0.3
[joints.j]
friction_angle = 30
[solver]
duration = 0.6
[[block]]
fixed = true
polygon = [[-6, -1], [6, -1], [6, 0], [-6, 0]]
)";
  for (int i = 0; i < 5; ++i) {
    const double x = 0.3 * (i % 2), y = 0.05 + 1.15 * i, tilt = 0.02 * i;
    text += "[[block]]\nangular_velocity = " + std::to_string(0.3 * i) + "\npolygon = [[" +
            std::to_string(x) + "," + std::to_string(y + tilt) + "],[" + std::to_string(x + 1.0) +
            "," + std::to_string(y) + "],[" + std::to_string(x + 1.1) + "," +
            std::to_string(y + 1.0) + "],[" + std::to_string(x + 0.5) + "," +
            std::to_string(y + 1.1) + "],[" + std::to_string(x) + "," + std::to_string(y + 1.0) +
            "]]\n";
  }
  const Ran r = ran(text);
  EXPECT_LT(r.outcome.largest_energy_error, 1e-4);
  EXPECT_GT(r.ready.sim.accounts.open_close.switched, 20u);
  double most = 0.0;
  const State& s = r.ready.sim.motion.state;
  for (std::size_t m = 0; m < s.position.modes.size(); ++m)
    most = std::max(most, norm(s.position.modes[m]));
  EXPECT_GT(most, 1e-6);
}

}  // namespace
}  // namespace edda::bent_blocks_test
