// Classification of the motion of a block.
#include "study/mechanism.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "run/prepared.hpp"

namespace edda::mechanism_test {
namespace {

/// A block of 1 m by 2 m that stands on a base: its centroid is at (0.5, 1).
Simulation standing(const std::string& gravity) {
  return testing::prepared("gravity = " + gravity +
                           "\n[materials.rock]\ndensity = 2500\nyoung = 1e9\npoisson = 0.2\n"
                           "[joints.j]\nfriction_angle = 30\n[solver]\nduration = 1\n[[block]]\n"
                           "fixed = true\npolygon = [[-3,-1],[4,-1],[4,0],[-3,0]]\n[[block]]\n"
                           "polygon = [[0,0],[1,0],[1,2],[0,2]]\n")
      .sim;
}

/// Motion of the block after a rotation by this angle about a point.
FailureMode turned_about(const Simulation& before, Vec2 point, double by) {
  Simulation after = before;
  const Vec2 p = point - before.scene->blocks.origin;
  const auto turn = [&](double& x, double& y) {
    const Vec2 moved = p + rotated(Vec2{x, y} - p, by);
    x = moved.x;
    y = moved.y;
  };
  for (std::size_t k = 0; k < 3; ++k)
    turn(after.motion.state.position.x[k][1], after.motion.state.position.y[k][1]);
  for (Id v = before.scene->blocks.vertex_begin[1]; v < before.scene->blocks.vertex_begin[2]; ++v)
    turn(after.motion.pose.x[v], after.motion.pose.y[v]);
  const Mechanism m = mechanism_of(before, after, 0.1, before);  // contacts as they were
  EXPECT_EQ(m.blocks.size(), 1u);
  return m.blocks.empty() ? FailureMode::falls : m.blocks[0].motion;
}

/// A meshed block of which one end moves yields; moved as a whole it slides.
TEST(Mechanism, ABlockThatDeformsYields) {
  const Simulation sim =
      testing::prepared(
          "[materials.rock]\ndensity = 2500\nyoung = 1e9\npoisson = 0.2\n"
          "deformation = 'zones'\nzone_size = 0.5\n[joints.j]\n"
          "friction_angle = 30\n[solver]\nduration = 1\n[[block]]\nfixed = true\n"
          "polygon = [[-3,-1],[4,-1],[4,0],[-3,0]]\n[[block]]\n"
          "polygon = [[0,0],[2,0],[2,2],[0,2]]\n")
          .sim;
  const BlockSet& b = sim.scene->blocks;
  ASSERT_TRUE(b.is_meshed(1));
  Simulation slid = sim, yielded = sim;
  for (std::size_t k = 0; k < nodes_per_block; ++k) slid.motion.state.position.x[k][1] += 0.1;
  for (std::size_t j = 0; j < b.meshes.nodes(); ++j) {
    if (b.meshes.arm_y[j] > 0.0)
      yielded.motion.state.position.modes.add(b.bending.modes() + j, {0.1, 0.0});
  }
  for (Simulation* after : {&slid, &yielded}) {
    State& s = after->motion.state;
    place_vertices(b, s.position, 1, after->motion.pose.x, after->motion.pose.y);
  }
  EXPECT_EQ(mechanism_of(sim, slid, 0.1, sim).blocks.at(0).motion, FailureMode::slides);
  const Mechanism m = mechanism_of(sim, yielded, 0.1, sim);
  EXPECT_EQ(m.blocks.at(0).motion, FailureMode::yields);
  EXPECT_EQ(m.yielding, 1.0);
  EXPECT_EQ(m.text, "yielding: 1 block");
}

/// Rotation about a point below its centroid, on either side and in either direction; where the
/// rotation is half of its motion or more.
TEST(Mechanism, TopplesAboutAPointBelow) {
  const Simulation sim = standing("[0, -9.81]");
  const double radius = std::hypot(0.5, 1.0);
  for (const double by : {1e-3, -1e-3, 0.05, -0.05}) {
    for (const double x : {0.0, 0.5, 1.0}) {
      EXPECT_EQ(turned_about(sim, {x, 0.0}, by), FailureMode::topples) << x << ' ' << by;
      EXPECT_EQ(turned_about(sim, {x, 2.0}, by), FailureMode::slides) << x << ' ' << by;
    }
    // At about its own height, a step of a twentieth of its width up or down.
    for (const double x : {-0.5, 1.5}) {
      EXPECT_EQ(turned_about(sim, {x, 0.95}, by), FailureMode::topples) << x << ' ' << by;
      EXPECT_EQ(turned_about(sim, {x, 1.05}, by), FailureMode::slides) << x << ' ' << by;
    }
    EXPECT_EQ(turned_about(sim, {0.5, 1.0 - 1.9 * radius}, by), FailureMode::topples) << by;
    EXPECT_EQ(turned_about(sim, {0.5, 1.0 - 2.1 * radius}, by), FailureMode::slides) << by;
  }
}

/// Below is in the direction of gravity.
TEST(Mechanism, TopplesAsGravityHasIt) {
  const Simulation sideways = standing("[9.81, 0]"), upwards = standing("[0, 9.81]");
  EXPECT_EQ(turned_about(sideways, {1.5, 1.0}, 1e-3), FailureMode::topples);
  EXPECT_EQ(turned_about(sideways, {-0.5, 1.0}, 1e-3), FailureMode::slides);
  EXPECT_EQ(turned_about(upwards, {0.5, 2.0}, 1e-3), FailureMode::topples);
  EXPECT_EQ(turned_about(upwards, {0.5, 0.0}, 1e-3), FailureMode::slides);
}

}  // namespace
}  // namespace edda::mechanism_test
