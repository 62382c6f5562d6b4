#include "observe/locked_toes.hpp"

#include <gtest/gtest.h>

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "run/prepared.hpp"

namespace edda {
namespace {

const char* const rock = R"([materials.rock]
density = 2600
young = 1e10
poisson = 0.25
[joints.bed]
friction_angle = 30
[joints.other]
friction_angle = 30
[contact]
joint = "other"
[solver]
duration = 1
)";

/// A slope with its toe at (10, 5), and one joint, between two points.
std::vector<LockedToe> with_joint(const std::string& outline, const std::string& points) {
  return locked_toes(
      testing::prepared(std::string(rock) + "[[fixed]]\npoint = [30, 1]\n[domain]\noutline = " +
                        outline + "\n[[trace]]\njoint = 'bed'\npoints = " + points + "\n")
          .sim);
}

const std::string slope = "[[0, 0], [60, 0], [60, 25], [21.547, 25], [10, 5], [0, 5]]";

/// tan 30 up from the toe.
TEST(LockedToes, AreTipsInAnInnerCorner) {
  const std::vector<LockedToe> toes = with_joint(slope, "[[10, 5], [44.641, 25]]");
  ASSERT_EQ(toes.size(), 1u);
  EXPECT_NEAR(toes[0].into, std::numbers::pi / 6.0, 1e-4);
  EXPECT_EQ(toes[0].joint, 0);
}

TEST(LockedToes, NotWhereTheWayIsFree) {
  EXPECT_TRUE(with_joint(slope, "[[10.5774, 6], [43.4863, 25]]").empty()) << "on the face";
  EXPECT_TRUE(with_joint("[[0, 0], [60, 0], [60, 25], [21.547, 25], [10, 5], [10, 4], [0, 4]]",
                         "[[10, 5], [44.641, 25]]")
                  .empty())
      << "lower ground in front";
  EXPECT_TRUE(with_joint(slope, "[[10, 5], [60, 5]]").empty()) << "level, as the ground is";
  EXPECT_TRUE(with_joint(slope, "[[10, 5], [60, 0.5]]").empty()) << "dips into the slope";
}

/// The same the other way round, by blocks as drawn.
TEST(LockedToes, ToTheRightAsWell) {
  const std::string blocks = R"([[block]]
polygon = [[0, 0], [40, 0], [40, 5], [30, 5], [0, 22.3205]]
fixed = true
[[block]]
polygon = [[30, 5], [18.453, 25], [0, 25], [0, 22.3205]]
)";
  const std::vector<LockedToe> toes = locked_toes(testing::prepared(rock + blocks).sim);
  ASSERT_EQ(toes.size(), 1u);
  EXPECT_NEAR(toes[0].into, std::numbers::pi / 6.0, 1e-4);
  EXPECT_EQ(toes[0].block, 1u);
}

/// A block in the corner of floor and wall.
TEST(LockedToes, NotBlocksThatStand) {
  const std::string blocks = R"([[block]]
polygon = [[0, 0], [10, 0], [10, 10], [8, 10], [8, 2], [0, 2]]
fixed = true
[[block]]
polygon = [[6, 2], [8, 2], [8, 4], [6, 4]]
)";
  EXPECT_TRUE(locked_toes(testing::prepared(rock + blocks).sim).empty());
}

}  // namespace
}  // namespace edda
