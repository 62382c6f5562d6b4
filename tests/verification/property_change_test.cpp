// Joints and rock that change at a stage (stage.change).
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>

#include "run/prepared.hpp"
#include "step/energy_balance.hpp"
#include "verification/models.hpp"
#include "verification/record.hpp"

namespace edda::property_change_test {
namespace {

using testing::prepared;
using testing::Ran;
using testing::ran;

/// A block on a ramp of 30 degrees, held by friction of 45 degrees and cohesion.
std::string on_ramp(const std::string& weathered, const std::string& change, double duration) {
  auto box = [](double u0, double u1, double v0, double v1) {
    return "[" + on_slope(30, u0, v0) + "," + on_slope(30, u1, v0) + "," + on_slope(30, u1, v1) +
           "," + on_slope(30, u0, v1) + "]";
  };
  return "gravity = [0, -9.8]\n[materials.rock]\ndensity = 2500\nyoung = 5e9\npoisson = 0.2\n"
         "[joints.fresh]\nfriction_angle = 45\ncohesion = 1e5\n[joints.weathered]\n" +
         weathered +
         "\n[contact]\njoint = 'fresh'\n[[block]]\nfixed = true\npolygon = " + box(-9, 9, -1, 0) +
         "\n[[block]]\nname = 'slider'\npolygon = " + box(-1, 1, 0, 1) +
         "\n[[stage]]\nuntil = 'equilibrium'\n[[stage]]\nreset_displacements = true\nduration = " +
         number(duration) + "\nchange = [" + change + "]\n";
}

/// It slides from rest as one that never had more than friction of 15 degrees.
TEST(PropertyChange, AJointThatWeathersLetsItsBlockSlide) {
  const double duration = 0.5, a = radians(30.0);
  const Ran r =
      ran(on_ramp("friction_angle = 15", "{ joints = 'fresh', to = 'weathered' }", duration));
  const Simulation& sim = r.ready.sim;
  EXPECT_LT(r.outcome.largest_energy_error, 1e-9);
  const Vec2 u = centroid(sim.motion.state.position, 1) - centroid(sim.motion.state.reference, 1);
  const double exact =
      0.5 * 9.8 * duration * duration * (std::sin(a) - std::tan(radians(15.0)) * std::cos(a));
  expect_relative({80, "friction from 45 to 15 deg", "distance slid", "m"},
                  u.x * std::cos(a) - u.y * std::sin(a), exact, 1e-5);
  EXPECT_EQ(sim.motion.contacts.broken, 0u);
}

/// Elsewhere nothing changes; where cohesion alone is left, or friction, it holds.
TEST(PropertyChange, WhatIsStrongEnoughHolds) {
  const std::string there = "{ joints = 'fresh', to = 'weathered' }";
  for (const auto& [joint, change] :
       {std::pair<std::string, std::string>{"friction_angle = 31", there},
        {"friction_angle = 0\ncohesion = 2e4", there},
        {"friction_angle = 0\ncohesion = 2e4\nresidual = { friction_angle = 0 }", there},
        {"type = 'glued'", there}}) {
    const Ran r = ran(on_ramp(joint, change, 0.2));
    const Simulation& sim = r.ready.sim;
    const Vec2 u = centroid(sim.motion.state.position, 1) - centroid(sim.motion.state.reference, 1);
    EXPECT_LT(norm(u), 1e-5) << joint;
    EXPECT_LT(r.outcome.largest_energy_error, 1e-9);
  }
}

/// Two blocks on a floor, pressed; both joints become ten times softer. A force of 50 kN more comes
/// with a third stage.
std::string column(const std::string& region) {
  return R"(
gravity = [0, -10]
[materials.rock]
density = 2000
young = 1e12
poisson = 0
[joints.hard]
friction_angle = 30
kn = 1e9
ks = 5e8
[joints.soft]
friction_angle = 30
kn = 1e8
ks = 5e7
[contact]
joint = 'hard'
[[block]]
fixed = true
polygon = [[-1, -1], [2, -1], [2, 0], [-1, 0]]
[[block]]
polygon = [[0, 0], [1, 0], [1, 1], [0, 1]]
[[block]]
polygon = [[0, 1], [1, 1], [1, 2], [0, 2]]
[[load]]
name = 'more'
point = [0.5, 1.9]
force = [1e3, -5e4]
[[stage]]
until = 'equilibrium'
ratio = 1e-9
[[stage]]
until = 'equilibrium'
ratio = 1e-9
change = [{ joints = 'hard', to = 'soft')" +
         region + R"( }]
reset_displacements = true
[[stage]]
until = 'equilibrium'
ratio = 1e-9
activate = ['more']
)";
}

/// Nothing moves by the change; what comes after it meets the new stiffness.
TEST(PropertyChange, ForcesGoOnAndStiffnessCounts) {
  for (const auto& [region, soft] :
       {std::pair<std::string, double>{"", 2.0},
        {", region = [[-2, -2], [3, -2], [3, 0.5], [-2, 0.5]]", 1.0}}) {
    PreparedRun ready = prepared(column(region));
    double moved = 0.0;
    const Simulation& sim = ready.sim;
    RunOptions options;
    options.after_step = [&] {
      for (std::size_t i = 1; i < 3; ++i) {
        const Vec2 u =
            centroid(sim.motion.state.position, i) - centroid(sim.motion.state.reference, i);
        if (sim.attached.loads.intervals.loads[0].acts()) continue;
        if (sim.motion.state.reference.x != sim.scene->blocks.node_x)
          moved = std::max(moved, norm(u));
      }
      return false;
    };
    const Result<Outcome> outcome = run_model(ready, options);
    ASSERT_TRUE(outcome.ok());
    EXPECT_EQ(outcome.value().status, Status::equilibrium) << outcome.value().message;
    EXPECT_LT(outcome.value().largest_energy_error, 1e-6);
    EXPECT_LT(moved, 1e-7);
    const Vec2 u = centroid(sim.motion.state.position, 2) - centroid(sim.motion.state.reference, 2);
    const std::string which = soft > 1.0 ? "both joints" : "the lower joint";
    expect_relative({80, which + " softer", "settlement by what comes after", "m"}, -u.y,
                    5e4 * (soft / 1e8 + (2.0 - soft) / 1e9), 1e-3);
  }
}

/// The step follows a joint that becomes harder: grout.
TEST(PropertyChange, TheStepIsThatOfTheNewStiffness) {
  std::string model = column("");
  const auto swap = [&](const char* from, const char* to) {
    model.replace(model.find(from), std::string(from).size(), to);
  };
  swap("joint = 'hard'", "joint = 'soft'");
  swap("{ joints = 'hard', to = 'soft' }", "{ joints = 'soft', to = 'hard' }");
  const Ran r = ran(model);
  EXPECT_EQ(r.outcome.status, Status::equilibrium) << r.outcome.message;
  EXPECT_LT(r.outcome.largest_energy_error, 1e-6);
}

/// A joint that has carried tension by its bond loses it, and the block below it falls; one that
/// has been grouted carries it.
TEST(PropertyChange, BondsAreLostAndMade) {
  for (const bool lost : {true, false}) {
    const Ran r = ran(R"(
gravity = [0, -10]
[materials.rock]
density = 2000
young = 1e10
poisson = 0
[joints.whole]
friction_angle = 30
cohesion = 1e6
tensile_strength = 1e6
[joints.open]
friction_angle = 30
[[block]]
fixed = true
polygon = [[-1, 1], [2, 1], [2, 2], [-1, 2]]
joint = ')" + std::string(lost ? "whole" : "open") +
                      R"('
[[block]]
polygon = [[0, 0], [1, 0], [1, 1], [0, 1]]
joint = ')" + std::string(lost ? "whole" : "open") +
                      R"('
[[load]]
name = 'prop'
point = [0.5, 0]
force = [0, 4e4]
[[stage]]
until = 'equilibrium'
[[stage]]
reset_displacements = true
duration = 0.1
change = [{ joints = ')" +
                      std::string(lost ? "whole', to = 'open" : "open', to = 'whole") + R"(' }]
deactivate = ['prop']
)");
    const Simulation& sim = r.ready.sim;
    const Vec2 u = centroid(sim.motion.state.position, 1) - centroid(sim.motion.state.reference, 1);
    EXPECT_NEAR(-u.y, lost ? 0.05 : 0.0, lost ? 5e-4 : 1e-5) << lost;
    EXPECT_LT(r.outcome.largest_energy_error, 1e-6) << lost;
  }
}

/// Two blocks of clay that bear their own weight with 2 c = 1.2 gamma H, until 2 c is 0.8 gamma H.
Ran clay(const std::string& second_stage) {
  const std::string rock =
      "density = 2000\nyoung = 5e7\npoisson = 0\nyield = { friction_angle = 0, ";
  return ran("gravity = [0, -10]\n[materials.firm]\n" + rock +
             "cohesion = 2.4e4, tensile_strength = 9e5 }\n[materials.wet]\n" + rock +
             "cohesion = 1.6e4, tensile_strength = 6e5 }\n" + R"([joints.j]
friction_angle = 20
[domain]
outline = [[0, 0], [4, 0], [4, 2], [0, 2]]
material = 'firm'
[[trace]]
points = [[2, 0], [2, 2]]
[[boundary]]
sides = ['bottom']
type = 'roller'
[zones]
size = 0.5
[contact]
joint = 'j'
[[stage]]
until = 'equilibrium'
[[stage]]
duration = 0.1
)" + second_stage +
             "\n");
}

double most_strain(const Simulation& sim, std::size_t block) {
  const Meshes& meshes = sim.scene->blocks.meshes;
  double most = 0.0;
  for (std::size_t z = meshes.zone_begin[block]; z < meshes.zone_begin[block + 1]; ++z)
    most = std::max(most, sim.motion.zones.state[z].plastic_shear);
  return most;
}

/// Rock of two thirds of the strength is rock whose strength is divided by 1.5; it yields where the
/// change is, and nowhere else.
TEST(PropertyChange, RockLosesItsStrength) {
  const Ran changed = clay("change = [{ material = 'firm', to = 'wet' }]"),
            divided = clay("strength_factor = 1.5"),
            half = clay(
                "change = [{ material = 'firm', to = 'wet', region = [[2, 0], [5, 0], [5, 2], "
                "[2, 2]] }]");
  const Simulation &a = changed.ready.sim, &b = divided.ready.sim, &c = half.ready.sim;
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_GT(most_strain(a, i), 1e-4);
    EXPECT_NEAR(most_strain(a, i) / most_strain(b, i), 1.0, 1e-6);
  }
  const std::size_t right = c.scene->blocks.centroid_x[0] > 2.0 ? 0 : 1;
  EXPECT_GT(most_strain(c, right), 1e-4);
  EXPECT_EQ(most_strain(c, 1 - right), 0.0);
}

/// Changes that find nothing are faults with their place.
TEST(PropertyChange, OneThatChangesNothingIsAFault) {
  std::string model = column("");
  const std::string from = "change = [{ joints = 'hard', to = 'soft' }]";
  for (const char* to :
       {"change = [{ joints = 'soft', to = 'hard' }]",
        "change = [{ joints = 'hard', to = 'soft' }, { joints = 'hard', to = 'soft' }]",
        "change = [{ joints = 'hard', to = 'soft', region = [[7, 0], [8, 0], [8, 1]] }]"}) {
    std::string text = model;
    text.replace(text.find(from), from.size(), to);
    Result<Model> read = read_model_text(text, "m.toml", {});
    ASSERT_TRUE(read.ok());
    const Result<PreparedRun> run = prepare_run(std::move(read.value()));
    ASSERT_FALSE(run.ok()) << to;
    ASSERT_EQ(run.faults().size(), 1u);
    EXPECT_EQ(run.faults()[0].where.line, 34) << to_string(run.faults()[0]);
    EXPECT_NE(to_string(run.faults()[0]).find("changes nothing"), std::string::npos);
  }
  // Nor does a ramp go on with what one before has begun.
  const std::string again = "[[stage]]\nuntil = 'equilibrium'\n" + from + "\nramp = { change = ";
  const Result<PreparedRun> run = prepare_run(
      read_model_text(column("") + again + "[0, 0.4] }\n" + again + "[0.4, 1] }\n", "m.toml", {})
          .value());
  ASSERT_FALSE(run.ok());
  EXPECT_NE(to_string(run.faults()[0]).find("take them further change \"soft\" to another law"),
            std::string::npos)
      << to_string(run.faults()[0]);
}

}  // namespace
}  // namespace edda::property_change_test
