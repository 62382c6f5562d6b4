// Joints that a stage glues and releases.
#include <gtest/gtest.h>

#include <functional>
#include <string>

#include "run/prepared.hpp"
#include "step/changes.hpp"
#include "step/lone_block.hpp"
#include "step/step.hpp"

namespace edda::glued_joints_test {
namespace {

using testing::lone;
using testing::prepared;
using testing::ran;
using testing::Ran;

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

/// Nothing slides while joints are glued; afterwards the block slides as if the run had begun
/// there.
TEST(Activation, GluedJointsDoNotSlide) {
  const std::string damped = "[solver]\ndamping = { contact = 0.1 }\n";
  const Ran glued =
      ran(std::string(slope) + "[[stage]]\nduration = 0.2\njoints = \"glued\"\n" + damped);
  EXPECT_LT(norm(glued.moved("b")), 1e-4);
  const Ran r =
      ran(std::string(slope) +
          "[[stage]]\nduration = 0.2\njoints = \"glued\"\n[[stage]]\nduration = 0.1\n" + damped);
  EXPECT_NEAR(norm(r.moved("b")), 0.5 * 9.81 * 0.6 * 0.01, 2e-4);
  EXPECT_LT(r.outcome.largest_energy_error, 1e-6);
  EXPECT_GE(r.outcome.energy.friction, -1e-9);
  EXPECT_GE(r.outcome.energy.fracture, -1e-9);
}

/// Displacement of block b over a t^2/2, `steps` steps after `change` was made in equilibrium.
double gone_ahead(const std::string& toml, bool glued, double a, int steps,
                  const std::function<void(Simulation&)>& change) {
  PreparedRun ready = prepared(toml + "[solver]\nduration = 10\ntime_step = 2e-5\n");
  Simulation& sim = ready.sim;
  if (glued) glue_joints(sim, true);
  Damping damping;
  damping.local = 0.8;
  change_damping(sim, damping, true);
  start(sim, 10.0);
  while (sim.motion.state.steps < 20000) EXPECT_FALSE(step(sim).has_value());
  damping.local = 0.0;
  change_damping(sim, damping, true);
  const std::size_t b = sim.scene->blocks.size() - 1;
  const Vec2 from = centroid(sim.motion.state.position, b);
  const double balance = energy_balance(sim).balance(), time = sim.motion.state.time;
  change(sim);
  for (int k = 0; k < steps; ++k) EXPECT_FALSE(step(sim).has_value());
  const EnergyBalance after = energy_balance(sim);
  EXPECT_NEAR(after.balance(), balance, 1e-6 * after.scale()) << toml.substr(toml.size() - 40);
  const double t = sim.motion.state.time - time;
  return norm(centroid(sim.motion.state.position, b) - from) / (0.5 * a * t * t);
}

/// A jump of forces counts half in the step in the middle of which it occurs: k steps later a block
/// that started from rest has moved by a (k h)^2/2, not a k (k + 1) h^2/2.
TEST(Activation, JumpsOfContactsAndSpringsLeaveNoBlockHalfAStepAhead) {
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
  EXPECT_NEAR(gone_ahead(hung, true, 9.81, 20, [](Simulation& s) { glue_joints(s, false); }), 1.0,
              2e-3);
  const std::string on_springs =
      lone("[[boundary]]\nname = \"floor\"\nsides = [\"bottom\"]\n", "[0, -9.81]");
  EXPECT_NEAR(gone_ahead(on_springs, false, 9.81, 20,
                         [](Simulation& s) {
                           switch_over(s, rows_called(s.scene->model, {"floor"}), NamedRows{});
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
                         [](Simulation& s) { set_strength_factor(s, 2.0); }),
              1.0, 0.03);
}

/// Blocks that fall on the floor, and on each other, while their joints are glued.
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
  EXPECT_LT(r.outcome.largest_energy_error, 5e-4);
}

/// A block that hangs on a glued joint stays in place in a second stage with glued joints, and
/// falls in one without.
TEST(Activation, JointsStayGluedFromStageToStage) {
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

/// Slopes with slivers where joints cross close to the surface. While corners on edges were glued,
/// too, the first was still in motion after 5 s, and the second ended with twice its energy.
TEST(Activation, GluedSliversComeToRest) {
  for (const int seed : {122, 236}) {
    const Ran r = ran(
        "[materials.rock]\nunit_weight = '26.5 kN/m3'\nyoung = '15 GPa'\npoisson = 0.25\n"
        "[joints.j]\nfriction_angle = 36\ncohesion = '60 kPa'\nkn = '10 GPa/m'\n"
        "[domain]\njoint = 'j'\noutline = [[0, 0], [12, 0], [12, 10], [6, 10], [1, 2], [0, 2]]\n"
        "[[joint_set]]\nangle = 110\nspacing = 1.8\ndeviation = { angle = 3, spacing = 0.5, "
        "distribution = 'normal' }\nseed = " +
        std::to_string(seed) +
        "\n[[joint_set]]\nangle = 18\nspacing = 3\ntrace_length = 20\ngap = 4\n"
        "deviation = { angle = 4, spacing = 0.6, trace_length = 5, gap = 1, distribution = "
        "'normal' }\nseed = " +
        std::to_string(seed + 5) +
        "\n[initial_stress]\nk0 = 0.5\nsurface = 'outline'\n"
        "[[boundary]]\nsides = ['bottom']\ntype = 'fixed'\n"
        "[[boundary]]\nsides = ['left', 'right']\ntype = 'roller'\n"
        "[[stage]]\nuntil = 'equilibrium'\njoints = 'glued'\nduration = 5\n");
    EXPECT_EQ(r.outcome.status, Status::equilibrium) << seed << r.outcome.message;
    EXPECT_LT(r.outcome.time, 0.3) << seed;
    EXPECT_LT(r.outcome.largest_energy_error, 1e-4) << seed;
  }
}

}  // namespace
}  // namespace edda::glued_joints_test
