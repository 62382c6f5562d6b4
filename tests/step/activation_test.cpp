// Loads, ground motion, bolts and scaled masses that stages activate and deactivate.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "run/prepared.hpp"
#include "step/changes.hpp"
#include "step/energy_balance.hpp"
#include "step/lone_block.hpp"
#include "step/step.hpp"

namespace edda::activation_test {
namespace {

using testing::lone;
using testing::prepared;
using testing::ran;
using testing::Ran;

/// s = F t^2/2m from the stage that activates the load; histories count from there.
TEST(Activation, OfALoad) {
  const std::string load = "[[load]]\nname = \"push\"\npoint = [0.5, 0.5]\nforce = [5e3, 0]\n";
  const Ran later = ran(lone(load + "[[stage]]\nduration = 0.1\n"
                                    "[[stage]]\nduration = 0.2\nactivate = [\"push\"]\n"));
  EXPECT_NEAR(later.moved("b").x, 0.5 * 2.0 * 0.2 * 0.2, 1e-6);
  const Ran before = ran(lone(load + "[[stage]]\nduration = 0.1\n"
                                     "[[stage]]\nduration = 0.2\ndeactivate = [\"push\"]\n"));
  EXPECT_NEAR(before.moved("b").x, 0.5 * 2.0 * 0.1 * 0.1 + 2.0 * 0.1 * 0.2, 1e-4)
      << "acts until it is deactivated";
  const Ran both = ran(lone(load + "[[stage]]\nduration = 0.1\n[[stage]]\nduration = 0.2\n"));
  EXPECT_NEAR(both.moved("b").x, 0.5 * 2.0 * 0.3 * 0.3, 1e-6) << "no stage names it";
  for (const Ran* r : {&later, &before, &both}) EXPECT_LT(r->outcome.largest_energy_error, 1e-6);
}

/// A sine that begins with the stage: v = A (1 - cos wt)/w.
TEST(Activation, OfAGroundMotion) {
  const Ran r = ran(lone(R"(
[[shaking]]
name = "quake"
apply = "inertia"
acceleration = { amplitude = -3.0, frequency = 2.0 }
[[stage]]
duration = 0.13
[[stage]]
duration = 0.25
activate = ["quake"]
)"));
  const double w = 4.0 * M_PI, t = 0.25;
  EXPECT_NEAR(r.moved("b").x, 3.0 / w * (t - std::sin(w * t) / w), 1e-5);
}

/// Seen from a frame that moves with v everything goes on as before, less v t: what stands on the
/// ground, the ground, and springs between them.
TEST(Activation, OfAFrameThatMoves) {
  PreparedRun ready = prepared(
      "[materials.rock]\ndensity = 2500\nyoung = 2e9\npoisson = 0.2\n[joints.j]\n"
      "friction_angle = 20\n[[block]]\nfixed = true\npolygon = [[-9, -1], [9, -1], [9, 0], [-9, "
      "0]]\n"
      "[[block]]\npolygon = [[-1, 0], [1, 0], [1, 1], [-1, 1]]\n[[block]]\n"
      "polygon = [[2, 0], [3, 0], [3, 1], [2, 1]]\n[[boundary]]\nsides = ['top']\ntype = 'fixed'\n"
      "stiffness = 1e6\n[[shaking]]\nacceleration = { amplitude = 3, frequency = 2 }\n"
      "[solver]\nduration = 1\n");
  Simulation& still = ready.sim;
  start(still, 1.0);
  for (int n = 0; n < 400; ++n) ASSERT_FALSE(step(still));
  Simulation moves = still;
  const Vec2 v{0.3, -0.2};
  const double began = still.motion.state.time;
  lose_velocity(moves, v);
  EXPECT_NEAR(norm(still.attached.ground.velocity - moves.attached.ground.velocity - v), 0.0,
              1e-12);
  for (int n = 0; n < 400; ++n) {
    ASSERT_FALSE(step(still));
    ASSERT_FALSE(step(moves));
  }
  const double t = still.motion.state.time - began;
  EXPECT_EQ(moves.motion.state.time, still.motion.state.time);
  for (std::size_t i = 0; i < still.scene->blocks.size(); ++i) {
    const Vec2 apart =
        centroid(still.motion.state.position, i) - centroid(moves.motion.state.position, i);
    EXPECT_NEAR(norm(apart - t * v), 0.0, 1e-9) << i;
  }
  EXPECT_LT(std::abs(account_energy(moves).error), 1e-6);
}

/// A block that has fallen before its bolt is installed: the bolt is free of force at that
/// position.
TEST(Activation, OfABolt) {
  const std::string hangs = R"(
[contact]
joint = "j"
[joints.j]
friction_angle = 0
[[block]]
name = "roof"
fixed = true
polygon = [[0, 1], [1, 1], [1, 2], [0, 2]]
[[bolt]]
name = "anchor"
type = "end"
from = [0.5, 0.4]
to = [0.5, 1.5]
diameter = 0.02
[[stage]]
duration = 0.05
)";
  const std::string second = "[[stage]]\nduration = 0.001\n";
  const Ran free_fall = ran(lone(hangs + second + "install = [\"anchor\"]\n", "[0, -9.81]"));
  const Bolts& late = free_fall.ready.sim.attached.bolts;
  ASSERT_EQ(late.rows.size(), 1u);
  // Its elongation is v t + g t^2/2 less the effect of its own force.
  const double stiffness = 200e9 * M_PI * 1e-4 / 1.1, v = 9.81 * 0.05, t = 0.001;
  const double w = std::sqrt(stiffness / 2500.0);
  EXPECT_NEAR(late.bars.force[0] / (stiffness * v / w * std::sin(w * t)), 1.0, 0.03);
  EXPECT_LT(free_fall.outcome.largest_energy_error, 1e-6);
}

/// A pebble under a boulder: with scaled masses all blocks have one step, the equilibrium is the
/// same, and afterwards every mass has its value again, to the bit.
TEST(Activation, ScaledMassesCostFewerStepsAndLeaveTheEquilibrium) {
  const auto model = [](const char* masses) {
    return std::string(R"(
[materials.rock]
density = 2500.0
young = 10e9
poisson = 0.0
[joints.j]
friction_angle = 30
[[block]]
name = "b"
polygon = [[0, 0.05], [2, 0.05], [2, 2.05], [0, 2.05]]
[[block]]
name = "pebble"
polygon = [[0.9, 0], [1.1, 0], [1.1, 0.05], [0.9, 0.05]]
[[block]]
name = "left"
polygon = [[0, 0], [0.2, 0], [0.2, 0.05], [0, 0.05]]
[[block]]
name = "right"
polygon = [[1.8, 0], [2, 0], [2, 0.05], [1.8, 0.05]]
[[block]]
fixed = true
polygon = [[-5, -1], [5, -1], [5, 0], [-5, 0]]
[[stage]]
until = "equilibrium"
ratio = 1e-6
)") + masses +
           "[[stage]]\nduration = 1e-4\n";
  };
  const Ran given = ran(model("masses = \"as given\"\n")), scaled = ran(model(""));
  EXPECT_LT(3 * scaled.outcome.steps, given.outcome.steps);
  EXPECT_NEAR(scaled.moved("b").y / given.moved("b").y, 1.0, 1e-4);
  const PreparedRun fresh = prepared(model(""));
  EXPECT_EQ(scaled.ready.sim.motion.masses.node, fresh.sim.motion.masses.node);
  EXPECT_EQ(scaled.ready.sim.motion.masses.point_inverse, fresh.sim.motion.masses.point_inverse);
  EXPECT_LT(scaled.outcome.largest_energy_error, 1e-6);
}

}  // namespace
}  // namespace edda::activation_test
