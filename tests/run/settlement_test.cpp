// Supports that settle, spread or push: blocks follow them by their weight, in as few or as many
// increments as there are.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "run/prepared.hpp"

namespace edda {
namespace {

using testing::ran;
using testing::Ran;

std::string stone(double young, double friction) {
  return fmt::format(
      "[materials.stone]\ndensity = 2400\nyoung = {}\npoisson = 0.2\n[joints.dry]\n"
      "friction_angle = {}\n",
      young, friction);
}

std::string block(const std::string& name, double x0, double y0, double x1, double y1,
                  const std::string& more = "") {
  return fmt::format(
      "[[block]]\nname = '{}'\n{}polygon = [[{}, {}], [{}, {}], [{}, {}], [{}, {}]]\n", name, more,
      x0, y0, x1, y0, x1, y1, x0, y1);
}

/// A support of the block whose side lies along x or y.
std::string support(const std::string& along, const std::string& displacement) {
  return "[[boundary]]\nname = 'support'\nalong = " + along +
         "\ntype = 'displacement'\ndisplacement = " + displacement + "\n";
}

const std::string weight_first = "[[stage]]\nname = 'weight'\nuntil = 'equilibrium'\n";

TEST(Settlement, ATowerFollowsItsFloor) {
  for (const double way : {0.0005, 0.01, 0.6}) {
    for (const bool in_first_stage : {true, false}) {
      if (way > 0.1 && !in_first_stage) continue;  // in 240 parts
      std::string text = stone(20e9, 30) + block("floor", -2, -0.5, 4, 0) +
                         support("[[-2, -0.5], [4, -0.5]]", fmt::format("[0, {}]", -way));
      for (int i = 0; i < 5; ++i)
        text += block(fmt::format("b{}", i), 0, 0.5 * i, 1, 0.5 * (i + 1));
      text += in_first_stage ? weight_first
                             : "[[stage]]\nuntil = 'equilibrium'\n[[stage]]\n"
                               "ramp = { 'boundary:support' = [0, 1], steps = 3 }\n";
      const Ran r = ran(text);
      EXPECT_EQ(r.outcome.status, Status::equilibrium) << r.outcome.message;
      EXPECT_EQ(r.outcome.message.find("falls"), std::string::npos) << r.outcome.message;
      for (int i = 0; i < 5; ++i)
        EXPECT_NEAR(r.moved(fmt::format("b{}", i).c_str()).y, -way, 2e-5) << way << ' ' << i;
    }
  }
}

/// Two stones of a flat arch of 1.0 x 0.3 m turn about their lower outer and upper inner corners
/// until these are in line.
TEST(Settlement, AFlatArchFallsWhereItsAbutmentHasSpreadTooFar) {
  const double exact = 2.0 * std::hypot(1.0, 0.3) - 2.0;
  const std::string arch = stone(30e9, 45) + block("left", -3, -0.5, -1, 0.3, "fixed = true\n") +
                           block("right", 1, -0.5, 3, 0.3) + block("l", -1, 0, 0, 0.3) +
                           block("r", 0, 0, 1, 0.3) + support("[[3, -3], [3, 3]]", "[0.1, 0]");
  const Ran r = ran(arch + weight_first +
                    "[[stage]]\nuntil = 'collapse'\n"
                    "ramp = { 'boundary:support' = [0.5, 1], steps = 50 }\n");
  ASSERT_EQ(r.outcome.ramps.size(), 1u);
  ASSERT_TRUE(r.outcome.ramps[0].holds && r.outcome.ramps[0].fails) << r.outcome.message;
  EXPECT_LT(*r.outcome.ramps[0].holds, 1.005 * exact / 0.1);
  EXPECT_GT(*r.outcome.ramps[0].fails, 0.995 * exact / 0.1);
}

/// A lintel loses its bearing of 0.3 m, and its end falls past the corner of the pier: the edges
/// that lay behind each other until then begin to act without a gain of energy.
TEST(Settlement, ALintelFallsOffItsBearing) {
  const Ran r = ran(stone(1e9, 30) + block("left", -1, 0, 1, 2, "fixed = true\n") +
                    block("pier", 3.7, 0, 4.7, 2) + block("lintel", 0, 2, 4, 2.5) +
                    support("[[3.7, 0], [4.7, 0]]", "[0.3, 0]") + weight_first +
                    "[[stage]]\nuntil = 'collapse'\n"
                    "ramp = { 'boundary:support' = [0, 1.5], steps = 30 }\n");
  ASSERT_EQ(r.outcome.ramps.size(), 1u);
  EXPECT_NEAR(r.outcome.ramps[0].holds.value_or(0.0), 0.95, 1e-9) << r.outcome.message;
  EXPECT_NEAR(r.outcome.ramps[0].fails.value_or(0.0), 1.0, 1e-9) << r.outcome.message;
  EXPECT_LT(std::abs(r.outcome.energy.error), 1e-5);
}

/// A block that a jack pushes along a floor: at the end of the last increment the jack has the
/// force with which it slides.
TEST(Settlement, AJackHasTheForceOfSliding) {
  constexpr double friction = 25.0, block_weight = 2400 * 9.81 * 2 * 1,
                   jack_weight = 2400 * 9.81 * 1 * 0.8;
  const Ran r = ran(stone(10e9, friction) + block("floor", -2, -0.5, 6, 0, "fixed = true\n") +
                    block("jack", -1, 0.1, 0, 0.9) + block("pushed", 0, 0, 2, 1) +
                    support("[[-1, 0], [-1, 1]]", "[0.05, 0]") + weight_first +
                    "[[stage]]\nramp = { 'boundary:support' = [0, 1], steps = 10 }\n");
  EXPECT_EQ(r.outcome.status, Status::equilibrium) << r.outcome.message;
  const Simulation& s = r.ready.sim;
  Vec2 force;
  for (std::size_t q = 0; q < s.attached.springs.size(); ++q)
    force += spring_force(s.attached.springs, q, s.motion.pose.x, s.motion.pose.y);
  const double slides =
      std::tan(friction * std::numbers::pi / 180.0) * (block_weight + jack_weight - force.y);
  EXPECT_NEAR(force.x, slides, 0.006 * slides);
  EXPECT_NEAR(r.moved("pushed").x, 0.05, 1e-4);
}

/// Half of the floor of a wall settles: where its bricks come to lie does not depend on the number
/// of increments.
TEST(Settlement, AWallCracksAlikeInFewAndManyIncrements) {
  const std::string wall = stone(10e9, 35) + block("floor", -0.4, -0.2, 0.6, 0, "fixed = true\n") +
                           block("moving", 0.6, -0.2, 1.6, 0) +
                           "[[brick_wall]]\ncolumns = 3\nrows = 3\nbrick = [0.4, 0.2]\n" +
                           support("[[0.6, -0.2], [1.6, -0.2]]", "[0, -0.01]") + weight_first;
  const auto places = [](const Ran& r) {
    std::vector<Vec2> moved;
    const State& s = r.ready.sim.motion.state;
    for (std::size_t i = 0; i < r.ready.sim.scene->blocks.size(); ++i)
      moved.push_back(displacement_of(s, i, centroid_weights));
    return moved;
  };
  const auto ramped = [&](int steps) {
    const Ran r =
        ran(wall + fmt::format("[[stage]]\nramp = {{ 'boundary:support' = [0, 1], steps = {} }}\n",
                               steps));
    EXPECT_EQ(r.outcome.status, Status::equilibrium) << r.outcome.message;
    return places(r);
  };
  const std::vector<Vec2> few = ramped(2), many = ramped(12);
  double most = 0.0;
  for (std::size_t i = 0; i < few.size(); ++i) {
    EXPECT_LT(norm(few[i] - many[i]), 5e-5) << i;
    most = std::max(most, norm(few[i]));
  }
  EXPECT_GT(most, 0.009);
}

}  // namespace
}  // namespace edda
