#include "base/polygon.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

namespace edda::polygon_test {
namespace {

TEST(LeastWidth, IsThatBetweenTheClosestParallelLines) {
  EXPECT_EQ(least_width(Ring{{0, 0}, {1, 0}}), 0.0);
  EXPECT_EQ(least_width(Ring{{0, 0}, {1, 1}, {2, 2}, {3, 3}}), 0.0);
  EXPECT_DOUBLE_EQ(least_width(Ring{{0, 0}, {3, 0}, {3, 2}, {0, 2}}), 2.0);
  EXPECT_NEAR(least_width(Ring{{0, 0}, {4, 0}, {0, 3}}), 12.0 / 5.0, 1e-15);
  std::mt19937 random(1);
  std::uniform_real_distribution<double> u(-1.0, 1.0);
  for (int n = 3; n < 60; ++n) {
    Ring points;
    for (int i = 0; i < n; ++i) points.push_back({u(random), 0.3 * u(random)});
    // Along the line of some two of them: all others lie between it and its parallel.
    double least = 1e9;
    for (const Vec2 a : points) {
      for (const Vec2 b : points) {
        if (a == b) continue;
        double low = 0.0, high = 0.0;
        for (const Vec2 p : points) {
          const double h = cross(b - a, p - a) / norm(b - a);
          low = std::min(low, h);
          high = std::max(high, h);
        }
        least = std::min(least, high - low);
      }
    }
    EXPECT_NEAR(least_width(points), least, 1e-12);
    Ring turned;
    for (const Vec2 p : points) turned.push_back(rotated(p, 0.7) + Vec2{5, -3});
    EXPECT_NEAR(least_width(turned), least, 1e-12);
  }
}

/// Corners on straight sides, not quite in line once turned.
TEST(LeastWidth, StraightSidesInPieces) {
  for (int turn = 0; turn < 90; ++turn) {
    Ring points;
    for (int i = 0; i <= 10; ++i) {
      for (const double y : {0.0, 1.0}) points.push_back(rotated({i - 4.0, y}, turn * 0.0174533));
    }
    EXPECT_NEAR(least_width(points), 1.0, 1e-9) << turn;
  }
}

TEST(Moments, FarFromTheOriginKeepsItsDigits) {
  const Vec2 far{3e6, -5e6};
  Ring near_ring, far_ring;
  for (int i = 0; i < 7; ++i) {
    const double a = 2 * std::numbers::pi * i / 7;
    const Vec2 p{std::round(64 * std::cos(a)) / 64, std::round(64 * std::sin(a)) / 64};
    near_ring.push_back(p);
    far_ring.push_back(p + far);
  }
  const Moments m = moments(std::vector<Ring>{near_ring}), n = moments(std::vector<Ring>{far_ring});
  EXPECT_DOUBLE_EQ(m.area, n.area);
  EXPECT_NEAR(m.sxx, n.sxx, 1e-9);
  EXPECT_NEAR(norm(n.centroid - far - m.centroid), 0.0, 1e-9);
}

TEST(Moments, OfTrianglesAgreeWithTheSumOverTheirParts) {
  // Second moments of a triangle about its centroid: A/36 (sum of squared vertex coordinates ...),
  // by cutting.
  std::mt19937 rng(1);
  std::uniform_real_distribution<double> u(-1, 1);
  for (int trial = 0; trial < 50; ++trial) {
    Ring t{{u(rng), u(rng)}, {u(rng), u(rng)}, {u(rng), u(rng)}};
    if (signed_area(t) < 0) std::swap(t[0], t[1]);
    const Moments m = moments(std::vector<Ring>{t});
    double sxx = 0.0;
    for (Vec2 p : t) sxx += (p.x - m.centroid.x) * (p.x - m.centroid.x);
    EXPECT_NEAR(m.sxx, m.area * sxx / 12.0, 1e-14);
  }
}

TEST(SideOf, NonConvexWithAHole) {
  const std::vector<Ring> rings{{{0, 0}, {4, 0}, {4, 4}, {2, 2}, {0, 4}},
                                {{1, 0.5}, {1, 1}, {1.5, 1}, {1.5, 0.5}}};
  EXPECT_EQ(side_of(rings, {0.5, 0.5}, 1e-12), 1);
  EXPECT_EQ(side_of(rings, {1.2, 0.7}, 1e-12), -1);
  EXPECT_EQ(side_of(rings, {2, 3}, 1e-12), -1);
  EXPECT_EQ(side_of(rings, {4, 2}, 1e-12), 0);
  EXPECT_EQ(side_of(rings, {5, 2}, 1e-12), -1);
}

TEST(SelfCrossing, FindsWhatBruteForceFinds) {
  std::mt19937 rng(2);
  std::uniform_real_distribution<double> u(0, 1);
  int crossing = 0, simple = 0;
  for (int trial = 0; trial < 400; ++trial) {
    Ring ring;
    const int n = 3 + trial % 6;
    for (int i = 0; i < n; ++i) ring.push_back({u(rng), u(rng)});
    auto turn = [](Vec2 a, Vec2 b, Vec2 c) { return cross(b - a, c - a) > 0; };
    bool expected = false;
    for (int i = 0; i < n; ++i) {
      for (int j = i + 2; j < n; ++j) {
        if (i == 0 && j == n - 1) continue;
        const auto at = [&](int k) { return ring[static_cast<std::size_t>(k % n)]; };
        expected =
            expected || (turn(at(i), at(i + 1), at(j)) != turn(at(i), at(i + 1), at(j + 1)) &&
                         turn(at(j), at(j + 1), at(i)) != turn(at(j), at(j + 1), at(i + 1)));
      }
    }
    EXPECT_EQ(self_crossing(ring), expected);
    ++(expected ? crossing : simple);
  }
  EXPECT_GT(std::min(crossing, simple), 50);
  EXPECT_TRUE(self_crossing(Ring{{0, 0}, {2, 0}, {1, 0}, {1, 1}}));  // folds back
  EXPECT_TRUE(self_crossing(Ring{{0, 0}, {1, 0}, {1, 0}, {0, 1}}));  // repeats a point
}

}  // namespace
}  // namespace edda::polygon_test
