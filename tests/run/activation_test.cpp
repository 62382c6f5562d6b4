// What stages switch on and off: loads, water, boundaries, shaking, bolts, glue, masses.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "run/attachment_rows.hpp"
#include "run/prepared.hpp"

namespace edda::activation_test {
namespace {

using testing::prepared;
using testing::Ran;
using testing::ran;

/// A square metre of 2500 kg, alone.
std::string lone(const std::string& more, const std::string& gravity = "[0, 0]") {
  return "gravity = " + gravity + R"(
[materials.rock]
density = 2500.0
young = 10e9
poisson = 0.2
[[block]]
name = "b"
polygon = [[0, 0], [1, 0], [1, 1], [0, 1]]
)" + more;
}

/// s = F t^2/2m from the stage that activates it on; histories run from there.
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
  for (const Ran* r : {&later, &before, &both}) EXPECT_LT(r->outcome.largest_drift, 1e-6);
}

/// A sine that begins with the stage: v = A (1 - cos wt)/w.
TEST(Activation, OfAShaking) {
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

/// A column at rest on springs, whose place dashpots take: it stays at rest, and they bear its
/// weight. Without them it falls.
TEST(Activation, ABoundaryThatTakesOverBearsWhatTheOtherBore) {
  const std::string stands = R"(
[[boundary]]
name = "static"
along = [[0, 0], [1, 0]]
type = "fixed"
[[boundary]]
name = "far"
along = [[0, 0], [1, 0]]
type = "viscous"
[[stage]]
until = "equilibrium"
ratio = 1e-8
[[stage]]
duration = 0.2
reset_displacements = true
deactivate = ["static"]
)";
  const Ran r = ran(lone(stands + "activate = [\"far\"]\n", "[0, -9.81]"));
  const Simulation& s = r.ready.sim;
  EXPECT_LT(norm(centroid(s.state.vx, s.state.vy, 0)), 1e-7);
  Instant now;
  observe(s, now);
  const std::vector<Vec2> reaction = reactions(s, now);
  EXPECT_EQ(reaction[0], Vec2{});
  EXPECT_NEAR(reaction[1].y / (2500.0 * 9.81), 1.0, 1e-6);
  const Ran falls = ran(lone(stands + R"(
[[stage]]
duration = 0.01
activate = ["far"]
)",
                             "[0, -9.81]"));
  const Simulation& f = falls.ready.sim;
  // Nothing to take over from any more: it sinks as fast as dashpots let it, m g/(rho c_p A).
  const double speed = std::sqrt(10e9 * 0.8 / (1.2 * 0.6) / 2500.0);
  EXPECT_NEAR(centroid(f.state.vx, f.state.vy, 0).y / (-9.81 / speed), 1.0, 0.01);
}

/// Where two boundaries meet the forces are there once.
TEST(Activation, BoundariesThatTakeOverTogetherBearTheForcesOnce) {
  const Ran r = ran(lone(R"(
[[boundary]]
name = "box"
sides = ["left", "right", "bottom"]
type = "fixed"
[[boundary]]
name = "base"
sides = ["bottom"]
type = "viscous"
[[boundary]]
name = "flanks"
sides = ["left", "right"]
type = "free-field"
[[stage]]
until = "equilibrium"
ratio = 1e-8
[[stage]]
duration = 0.2
deactivate = ["box"]
activate = ["base", "flanks"]
)",
                         "[0, -9.81]"));
  const Simulation& s = r.ready.sim;
  EXPECT_LT(norm(centroid(s.state.vx, s.state.vy, 0)), 1e-7);
  Instant now;
  observe(s, now);
  const std::vector<Vec2> reaction = reactions(s, now);
  EXPECT_NEAR((reaction[1] + reaction[2]).y / (2500.0 * 9.81), 1.0, 1e-6);
}

/// Springs that take over begin where the block is, and hold it as it was held.
TEST(Activation, SpringsTakeOverToo) {
  const Ran r = ran(lone(R"(
[[boundary]]
name = "static"
along = [[0, 0], [1, 0]]
type = "roller"
[[boundary]]
name = "stiff"
along = [[0, 0], [1, 0]]
type = "fixed"
[[stage]]
until = "equilibrium"
ratio = 1e-8
[[stage]]
duration = 0.05
deactivate = ["static"]
activate = ["stiff"]
)",
                         "[0, -9.81]"));
  const Simulation& s = r.ready.sim;
  EXPECT_LT(norm(centroid(s.state.vx, s.state.vy, 0)), 1e-7);
  EXPECT_LT(r.outcome.largest_drift, 1e-6);
}

/// A block that has fallen before its bolt was put in: the bolt pulls from there on only.
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
  const Bolts& late = free_fall.ready.sim.bolts;
  ASSERT_EQ(late.rows.size(), 1u);
  // It stretches by v t + g t^2/2 less what it pulls back.
  const double stiffness = 200e9 * M_PI * 1e-4 / 1.1, v = 9.81 * 0.05, t = 0.001;
  const double w = std::sqrt(stiffness / 2500.0);
  EXPECT_NEAR(late.bars.force[0] / (stiffness * v / w * std::sin(w * t)), 1.0, 0.03);
  EXPECT_LT(free_fall.outcome.largest_drift, 1e-6);
}

const char* const slope = R"(
[materials.rock]
density = 2500.0
young = 10e9
poisson = 0.2
[joints.smooth]
friction_angle = 0
[[block]]
name = "b"
polygon = [[0, 0], [0.8, 0.6], [0.2, 1.4], [-0.6, 0.8]]
[[block]]
name = "floor"
fixed = true
polygon = [[-8, -6], [8, 6], [8, -6]]
)";

/// Nothing slides while joints are glued; then it does, as if it had begun there.
TEST(Activation, GluedJointsHold) {
  const std::string damped = "[solver]\ndamping = { contact = 0.1 }\n";
  const Ran held =
      ran(std::string(slope) + "[[stage]]\nduration = 0.2\njoints = \"glued\"\n" + damped);
  EXPECT_LT(norm(held.moved("b")), 1e-4);
  const Ran r =
      ran(std::string(slope) +
          "[[stage]]\nduration = 0.2\njoints = \"glued\"\n[[stage]]\nduration = 0.1\n" + damped);
  EXPECT_NEAR(norm(r.moved("b")), 0.5 * 9.81 * 0.6 * 0.01, 2e-4);
  EXPECT_LT(r.outcome.largest_drift, 1e-6);
  EXPECT_GE(r.outcome.ledger.friction, -1e-9);
  EXPECT_GE(r.outcome.ledger.fracture, -1e-9);
}

/// How far block b has gone, over a t^2/2, when `change` has been made at rest and `steps` have
/// been since.
double gone_ahead(const std::string& toml, bool glued, double a, int steps,
                  const std::function<void(Simulation&)>& change) {
  PreparedRun ready = prepared(toml + "[solver]\nduration = 10\ntime_step = 2e-5\n");
  Simulation& sim = ready.sim;
  if (glued) sim.glue_joints(true);
  Damping damping;
  damping.local = 0.8;
  sim.change_damping(damping, true);
  sim.start(10.0);
  while (sim.state.steps < 20000) EXPECT_FALSE(sim.step().has_value());
  damping.local = 0.0;
  sim.change_damping(damping, true);
  const std::size_t b = sim.blocks.size() - 1;
  const Vec2 from = centroid(sim.state.x, sim.state.y, b);
  const double balance = sim.ledger_now().balance(), time = sim.state.time;
  change(sim);
  for (int k = 0; k < steps; ++k) EXPECT_FALSE(sim.step().has_value());
  const Ledger after = sim.ledger_now();
  EXPECT_NEAR(after.balance(), balance, 1e-6 * after.scale()) << toml.substr(toml.size() - 40);
  const double t = sim.state.time - time;
  return norm(centroid(sim.state.x, sim.state.y, b) - from) / (0.5 * a * t * t);
}

/// Half of what forces jump by counts in the step amid which they do: k steps later a block that
/// was at rest has gone a (k h)^2/2, not a k (k + 1) h^2/2.
TEST(Activation, JumpsOfContactsAndSpringsLeaveNobodyHalfAStepAhead) {
  const std::string hung = R"(
[materials.rock]
density = 2500.0
young = 10e9
poisson = 0.2
[joints.j]
friction_angle = 30
[[block]]
fixed = true
polygon = [[0, 1], [1, 1], [1, 2], [0, 2]]
[[block]]
polygon = [[0, 0], [1, 0], [1, 1.00000001], [0, 1.00000001]]
)";
  EXPECT_NEAR(gone_ahead(hung, true, 9.81, 20, [](Simulation& s) { s.glue_joints(false); }), 1.0,
              2e-3);
  const std::string on_springs =
      lone("[[boundary]]\nname = \"floor\"\nsides = [\"bottom\"]\n", "[0, -9.81]");
  EXPECT_NEAR(gone_ahead(on_springs, false, 9.81, 20,
                         [](Simulation& s) {
                           s.switch_over(rows_called(s.model, {"floor"}), NamedRows{});
                         }),
              1.0, 2e-3);
  const std::string on_slope = R"(
[materials.rock]
density = 2500.0
young = 10e9
poisson = 0.2
[joints.j]
friction_angle = 45
[[block]]
fixed = true
polygon = [[-8, -6], [8, 6], [8, -6]]
[[block]]
polygon = [[0, 0], [1.6, 1.2], [1.0, 2.0], [-0.6, 0.8]]
)";
  EXPECT_NEAR(gone_ahead(on_slope, false, 9.81 * (0.6 - 0.8 / 2.0), 10,
                         [](Simulation& s) { s.set_strength_factor(2.0); }),
              1.0, 0.03);
}

/// Blocks that fall on the floor, and on one another, while their joints are glued.
TEST(Activation, WhatClosesWhileGluedKeepsItsEnergy) {
  std::string toml = R"(
[materials.rock]
density = 2500.0
young = 1e9
poisson = 0.2
[joints.j]
friction_angle = 30
[[block]]
fixed = true
polygon = [[-5, -1], [5, -1], [5, 0], [-5, 0]]
)";
  for (int i = 0; i < 5; ++i) {
    const double x = 0.3 * (i % 2), y = 0.02 + 1.05 * i;
    toml += "[[block]]\npolygon = [[" + std::to_string(x) + "," + std::to_string(y) + "],[" +
            std::to_string(x + 1.0) + "," + std::to_string(y + 0.01 * i) + "],[" +
            std::to_string(x + 1.0) + "," + std::to_string(y + 1.0) + "],[" + std::to_string(x) +
            "," + std::to_string(y + 1.0) + "]]\n";
  }
  const Ran r = ran(toml + "[[stage]]\nduration = 0.4\njoints = \"glued\"\n");
  EXPECT_LT(r.outcome.largest_drift, 1e-4);
}

/// What hangs on glue goes on hanging in a second stage that glues, and falls in one that does not.
TEST(Activation, GlueHoldsFromStageToStage) {
  const auto hung = [](const std::string& last) {
    return ran(R"(
[materials.rock]
density = 2500.0
young = 10e9
poisson = 0.2
[joints.j]
friction_angle = 30
[[block]]
name = "roof"
fixed = true
polygon = [[0, 1], [1, 1], [1, 2], [0, 2]]
[[block]]
name = "b"
polygon = [[0, 0], [1, 0], [1, 1.00000001], [0, 1.00000001]]
[[stage]]
duration = 0.02
joints = "glued"
[[stage]]
duration = 0.05
)" + last)
        .moved("b")
        .y;
  };
  EXPECT_GT(hung("joints = \"glued\"\n"), -1e-4);
  EXPECT_NEAR(hung(""), -0.5 * 9.81 * 0.05 * 0.05, 2e-4);
}

/// A traction that dashpots take over from leaves no jolt.
TEST(Activation, ATractionIsTakenOverFromWithoutAJolt) {
  const Ran r = ran(lone(R"(
[[boundary]]
name = "stressed"
sides = ["left", "right", "bottom", "top"]
type = "stress"
traction = [0, 0]
[[load]]
name = "left"
along = [[0, 0], [0, 1]]
pressure = 1e7
[[load]]
name = "right"
along = [[1, 0], [1, 1]]
pressure = 1e7
[[boundary]]
name = "squeeze"
along = [[0, 1], [1, 1]]
type = "stress"
traction = [0, -1e7]
[[boundary]]
name = "foot"
along = [[0, 0], [1, 0]]
type = "stress"
traction = [0, 1e7]
[[boundary]]
name = "far"
sides = ["bottom", "top"]
type = "viscous"
[[stage]]
until = "equilibrium"
ratio = 1e-7
[[stage]]
duration = 0.01
deactivate = ["squeeze", "foot"]
activate = ["far"]
)"));
  const Simulation& s = r.ready.sim;
  double fastest = 0.0;
  for (std::size_t k = 0; k < 3; ++k) {
    fastest = std::max({fastest, std::abs(s.state.vx[k][0]), std::abs(s.state.vy[k][0])});
  }
  EXPECT_LT(fastest, 1e-5);
}

/// A pebble under a boulder: with masses scaled all have one step, the state at rest is the same,
/// and afterwards every mass is its own again, to the bit.
TEST(Activation, StaticMassesCostFewerStepsAndChangeNothingAtRest) {
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
  const Ran given = ran(model("mass_scaling = \"as given\"\n")), scaled = ran(model(""));
  EXPECT_LT(3 * scaled.outcome.steps, given.outcome.steps);
  EXPECT_NEAR(scaled.moved("b").y / given.moved("b").y, 1.0, 1e-4);
  const PreparedRun fresh = prepared(model(""));
  EXPECT_EQ(scaled.ready.sim.blocks.node_mass, fresh.sim.blocks.node_mass);
  EXPECT_EQ(scaled.ready.sim.blocks.point_inverse, fresh.sim.blocks.point_inverse);
  EXPECT_LT(scaled.outcome.largest_drift, 1e-6);
}

}  // namespace
}  // namespace edda::activation_test
