// Gravity that acts at once is no news where blocks are meant to move.
#include "observe/cannot_rest.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "run/prepared.hpp"

namespace edda::cannot_rest_test {
namespace {

std::string corners(const Ring& ring, double angle) {
  std::string text = "polygon = [";
  for (const Vec2 p : ring) {
    const Vec2 q = rotated(p, angle * std::numbers::pi / 180.0);
    text += "[" + std::to_string(q.x) + ", " + std::to_string(q.y) + "],";
  }
  return text + "]\n";
}

/// A block of this shape on a plane of this slope, with friction of 30 degrees.
bool moves(const Ring& shape, double slope, const std::string& more = {},
           const std::string& joint = {}) {
  const PreparedRun run = testing::prepared(
      "[materials.rock]\ndensity = 2600\nyoung = 1e10\npoisson = 0.25\n[joints.j]\n"
      "friction_angle = 30\n" +
      joint + "[solver]\nduration = 1\n[[block]]\nfixed = true\n" +
      corners({{-20, -2}, {20, -2}, {20, 0}, {-20, 0}}, slope) + "[[block]]\n" +
      corners(shape, slope) + more);
  const bool warned = std::any_of(run.warnings.begin(), run.warnings.end(), [](const auto& w) {
    return w.starts_with("gravity acts at once");
  });
  const bool found = some_block_moves(run.sim);
  EXPECT_NE(warned, found);
  return found;
}

Ring box(double wide, double high) {
  return {{-0.5 * wide, 0}, {0.5 * wide, 0}, {0.5 * wide, high}, {-0.5 * wide, high}};
}

/// A regular polygon on one of its sides.
Ring wheel(int sides) {
  Ring ring;
  const double half = std::numbers::pi / sides;
  for (int k = 0; k < sides; ++k) {
    const double angle = -0.5 * std::numbers::pi - half + 2.0 * half * k;
    ring.push_back({std::cos(angle), std::sin(angle) + std::cos(half)});
  }
  return ring;
}

TEST(CannotRest, WhatSlides) {
  for (const double slope : {-45.0, -32.0, 31.0, 40.0, 60.0})
    EXPECT_TRUE(moves(box(2, 1), slope)) << slope;
  for (const double slope : {-29.0, -10.0, 0.0, 15.0, 29.0})
    EXPECT_FALSE(moves(box(2, 1), slope)) << slope;
  EXPECT_FALSE(moves(box(2, 1), 40.0, {}, "cohesion = 1e5\n"));
}

/// A column topples beyond atan(width / height), a wheel rolls beyond half the angle of a side.
TEST(CannotRest, WhatTopplesOrRolls) {
  EXPECT_TRUE(moves(box(1, 4), 16.0));
  EXPECT_FALSE(moves(box(1, 4), 12.0));
  for (const int sides : {6, 12, 24}) {
    const double half = 180.0 / sides;
    EXPECT_EQ(moves(wheel(sides), half + 2.0), true) << sides;
    EXPECT_FALSE(moves(wheel(sides), half - 2.0)) << sides;
  }
}

TEST(CannotRest, WhatHasAVelocityOrALoad) {
  EXPECT_TRUE(moves(box(2, 1), 0.0, "velocity = [1, 0]\n"));
  const auto pushed = [](double force) {
    return moves(
        box(2, 1), 0.0,
        "name = 'b'\n[[load]]\npoint = [0, 0.1]\nforce = [" + std::to_string(force) + ", 0]\n");
  };
  const double weight = 2.0 * 2600.0 * 9.81, limit = weight * std::tan(std::numbers::pi / 6.0);
  EXPECT_TRUE(pushed(1.05 * limit));
  EXPECT_FALSE(pushed(0.95 * limit));
}

}  // namespace
}  // namespace edda::cannot_rest_test
