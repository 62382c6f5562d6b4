#include "cutting/triangulate.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

namespace edda::triangulate_test {
namespace {

std::vector<Vec2> corners_of(const std::vector<Ring>& rings) {
  std::vector<Vec2> all;
  for (const Ring& r : rings) all.insert(all.end(), r.begin(), r.end());
  return all;
}

/// The triangles run counter-clockwise, have the region's area together, lie in it, and none
/// overlap: with positive areas that add up to the region's, all within it, they cannot.
void expect_covers(const std::vector<Ring>& rings) {
  const std::vector<Vec2> p = corners_of(rings);
  const double area = moments(rings).area;
  double sum = 0.0;
  for (const Triangle& t : triangulate(rings)) {
    const double twice = cross(p[t[1]] - p[t[0]], p[t[2]] - p[t[0]]);
    EXPECT_GT(twice, -1e-12 * area);
    sum += 0.5 * twice;
    const Vec2 middle = (p[t[0]] + p[t[1]] + p[t[2]]) / 3.0;
    EXPECT_TRUE(twice <= 1e-9 * area || side_of(rings, middle, 1e-12) >= 0);
  }
  EXPECT_NEAR(sum, area, 1e-12 * area);
}

Ring reversed(Ring ring) {
  return {ring.rbegin(), ring.rend()};
}

Ring box(double x0, double y0, double x1, double y1) {
  return {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}};
}

TEST(Triangulate, LShapeAndComb) {
  expect_covers({{{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}}});
  Ring comb{{0, 0}, {10, 0}};
  for (int k = 9; k >= 0; --k) {
    comb.push_back({k + 0.9, 5.0});
    comb.push_back({k + 0.1, 5.0});
    if (k > 0) comb.push_back({k + 0.0, 0.5});
  }
  expect_covers({comb});
}

TEST(Triangulate, HolesAlsoWhereTheyTouch) {
  expect_covers({box(0, 0, 4, 4), reversed(box(1, 1, 3, 3))});
  expect_covers({box(0, 0, 9, 9), reversed(box(1, 1, 3, 3)), reversed(box(4, 1, 6, 3)),
                 reversed(box(1, 5, 8, 8)), reversed(box(7, 1, 8, 3))});
  // A corner of a hole on a corner of the outer ring's notch, and two holes that meet at a corner.
  expect_covers({box(0, 0, 9, 9), reversed(box(1, 1, 3, 3)), reversed(box(3, 3, 5, 5))});
  expect_covers({{{0, 0}, {4, 0}, {4, 4}, {2, 3}, {0, 4}}, reversed({{2, 3}, {1, 1}, {3, 1}})});
}

TEST(Triangulate, RandomStarsWithRandomHoles) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> u(0.0, 1.0);
  for (int k = 0; k < 500; ++k) {
    auto star = [&](Vec2 at, double low, double high) {
      Ring ring;
      const int n = 3 + static_cast<int>(20 * u(random));
      for (int q = 0; q < n; ++q) {
        ring.push_back(
            at + rotated({low + (high - low) * u(random), 0.0}, 2.0 * std::numbers::pi * q / n));
      }
      return ring;
    };
    // n >= 6 keeps the hole's circle inside the outer star.
    Ring outer = star({5.0, -3.0}, 2.0, 6.0);
    while (outer.size() < 6) outer = star({5.0, -3.0}, 2.0, 6.0);
    expect_covers(
        {outer, reversed(star({4.8, -3.3}, 0.1, 0.5)), reversed(star({5.7, -2.8}, 0.1, 0.4))});
  }
}

TEST(Triangulate, KnowsConvexRings) {
  EXPECT_TRUE(is_convex(box(0, 0, 1, 1)));
  EXPECT_FALSE(is_convex(Ring{{0, 0}, {2, 0}, {1, 0.5}, {2, 2}}));
}

}  // namespace
}  // namespace edda::triangulate_test
