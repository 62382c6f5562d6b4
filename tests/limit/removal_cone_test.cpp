// Whether a block can leave, against trying all directions.
#include "limit/removal_cone.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>
#include <vector>

namespace edda {
namespace {

// The cone of directions against 7,200 that are tried one after the other.
TEST(RemovalCone, IsThatOfTryingAllDirections) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> angle(0.0, 2.0 * std::numbers::pi);
  int removable = 0, locked = 0;
  for (int n = 0; n < 2000; ++n) {
    std::vector<Vec2> outward;
    const int faces = 1 + n % 5;
    for (int i = 0; i < faces; ++i) {
      const double a = angle(random);
      outward.push_back({std::cos(a), std::sin(a)});
    }
    bool any = false;
    double best = -1e300;
    for (int k = 0; k < 7200; ++k) {
      const double a = 2.0 * std::numbers::pi * k / 7200.0;
      const Vec2 d{std::cos(a), std::sin(a)};
      double most = -1e300;
      for (const Vec2 normal : outward) most = std::max(most, dot(normal, d));
      best = std::max(best, -most);
      any = any || most <= 0.0;
    }
    if (std::abs(best) < 1e-3) continue;  // a cone narrower than the directions tried
    EXPECT_EQ(can_leave(outward), any) << n;
    ++(any ? removable : locked);
  }
  EXPECT_GT(removable, 300);
  EXPECT_GT(locked, 300);
}

TEST(RemovalCone, OneDirectionIsEnough) {
  const std::vector<Vec2> drawer{{0, 1}, {0, -1}, {1, 0}};
  EXPECT_TRUE(can_leave(drawer));
  EXPECT_TRUE(is_free(drawer, {-1, 0}));
  EXPECT_FALSE(is_free(drawer, {1, 0}));
  const std::vector<Vec2> shut{{0, 1}, {0, -1}, {1, 0}, {-1, 0}};
  EXPECT_FALSE(can_leave(shut));
}

}  // namespace
}  // namespace edda
