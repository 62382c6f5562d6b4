#include "base/arc.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace edda::arc_test {
namespace {

TEST(Arc, CornersLieOnTheCircleAtEqualAngles) {
  const Vec2 centre{3, -1}, from{5, -1};
  for (const double turn : {0.1, 1.0, -2.5, 2.0 * std::numbers::pi}) {
    const auto corners = arc_corners(centre, from, turn, 32);
    const double pieces = static_cast<double>(corners.size()) + 1.0;
    EXPECT_LE(std::abs(turn) / pieces, 2.0 * std::numbers::pi / 32.0 * (1.0 + 1e-8));
    EXPECT_GT(std::abs(turn) / (pieces - 1.0 + 1e-9), 2.0 * std::numbers::pi / 32.0 * (1.0 - 1e-8));
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const Vec2 arm = corners[i] - centre;
      EXPECT_NEAR(norm(arm), 2.0, 1e-14);
      const double angle = turn * static_cast<double>(i + 1) / pieces;
      EXPECT_NEAR(arm.x, 2.0 * std::cos(angle), 1e-14);
      EXPECT_NEAR(arm.y, 2.0 * std::sin(angle), 1e-14);
    }
  }
}

TEST(Arc, BulgeOfOneIsAHalfCircleToTheRight) {
  const auto corners = bulge_corners({0, 0}, {2, 0}, 1.0, 48);
  ASSERT_EQ(corners.size(), 23U);
  EXPECT_NEAR(corners[11].x, 1.0, 1e-14);
  EXPECT_NEAR(corners[11].y, -1.0, 1e-14);
  const auto other = bulge_corners({0, 0}, {2, 0}, -1.0, 48);
  EXPECT_NEAR(other[11].y, 1.0, 1e-14);
}

/// The middle of an arc with bulge b lies b times half the chord beside it.
TEST(Arc, BulgeIsTheRiseOverHalfTheChord) {
  for (const double bulge : {0.2, 0.7, 1.8, -0.4}) {
    const auto corners = bulge_corners({1, 1}, {1, 5}, bulge, 1000);
    ASSERT_FALSE(corners.empty());
    double farthest = 0.0;
    for (const Vec2 p : corners) farthest = std::max(farthest, std::abs(p.x - 1.0));
    if (std::abs(bulge) <= 1.0) {
      EXPECT_NEAR(farthest, std::abs(bulge) * 2.0, 1e-3);
    }
    for (const Vec2 p : corners) EXPECT_EQ(p.x > 1.0, bulge > 0.0);
  }
  EXPECT_TRUE(bulge_corners({0, 0}, {1, 0}, 0.0, 48).empty());
  EXPECT_TRUE(bulge_corners({1, 1}, {1, 1}, 0.5, 48).empty());
}

}  // namespace
}  // namespace edda::arc_test
