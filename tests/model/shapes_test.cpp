// Shapes of openings and slopes: corners, areas and sizes that are known.
#include "model/completion/shapes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/polygon.hpp"

namespace edda::shapes_test {
namespace {

using std::numbers::pi;

struct Box {
  Vec2 low, high;
};

Box box_of(const Ring& ring) {
  Box box{ring[0], ring[0]};
  for (const Vec2 p : ring) {
    box.low = {std::min(box.low.x, p.x), std::min(box.low.y, p.y)};
    box.high = {std::max(box.high.x, p.x), std::max(box.high.y, p.y)};
  }
  return box;
}

OpeningShape shape(ShapeKind kind, double width, double height, int segments = 48) {
  return {kind, {3.0, -2.0}, width, height, segments};
}

/// Area of the n-sided polygon inscribed in a half circle of radius 1, over its own.
double inscribed(int pieces) {
  return 0.5 * pieces * std::sin(pi / pieces);
}

void expect_box(const Ring& ring, Vec2 low, Vec2 high) {
  const Box box = box_of(ring);
  EXPECT_NEAR(box.low.x, low.x, 1e-12);
  EXPECT_NEAR(box.low.y, low.y, 1e-12);
  EXPECT_NEAR(box.high.x, high.x, 1e-12);
  EXPECT_NEAR(box.high.y, high.y, 1e-12);
}

void expect_simple(const Ring& ring) {
  EXPECT_FALSE(self_crossing(ring));
  EXPECT_GT(signed_area(ring), 0.0);
}

TEST(Shapes, RectangleStandsOnTheMiddleOfItsFloor) {
  const Ring ring = ring_of(shape(ShapeKind::rectangle, 4.0, 3.0));
  EXPECT_EQ(ring, (Ring{{1, -2}, {5, -2}, {5, 1}, {1, 1}}));
}

TEST(Shapes, CircleLiesRoundItsCentre) {
  const Ring ring = ring_of({ShapeKind::circle, {3.0, -2.0}, 4.0, {}, 60});
  ASSERT_EQ(ring.size(), 60U);
  expect_simple(ring);
  for (const Vec2 p : ring) EXPECT_NEAR(norm(p - Vec2{3, -2}), 2.0, 1e-14);
  EXPECT_NEAR(signed_area(ring), 4.0 * 30.0 * std::sin(2.0 * pi / 60.0), 1e-12);
}

TEST(Shapes, ArchHasWallsUnderAHalfCircle) {
  const Ring ring = ring_of(shape(ShapeKind::arch, 10.0, 8.0));
  expect_simple(ring);
  expect_box(ring, {-2, -2}, {8, 6});
  EXPECT_EQ(ring.size(), 2U + 25U);
  EXPECT_NEAR(signed_area(ring), 10.0 * 3.0 + 25.0 * inscribed(24), 1e-11);
}

TEST(Shapes, ArchOfHalfItsWidthIsAHalfCircle) {
  const Ring ring = ring_of(shape(ShapeKind::arch, 10.0, 5.0));
  expect_simple(ring);
  EXPECT_EQ(ring.size(), 25U);
  EXPECT_NEAR(signed_area(ring), 25.0 * inscribed(24), 1e-11);
}

/// A flat arc: radius (5^2 + 2^2)/4 = 7.25, area of the segment r^2 (t - sin t)/2, t its angle.
TEST(Shapes, LowArchIsAFlatArc) {
  const Ring ring = ring_of(shape(ShapeKind::arch, 10.0, 2.0, 2000));
  expect_simple(ring);
  expect_box(ring, {-2, -2}, {8, 0});
  const double angle = 2.0 * std::asin(5.0 / 7.25);
  EXPECT_NEAR(signed_area(ring), 0.5 * 7.25 * 7.25 * (angle - std::sin(angle)), 1e-4);
}

/// Below the widest line the walls are circles of radius 6 round the opposite wall.
TEST(Shapes, HorseshoeComesInBelowItsWidestLine) {
  const Ring ring = ring_of(shape(ShapeKind::horseshoe, 6.0, 5.0));
  expect_simple(ring);
  expect_box(ring, {0, -2}, {6, 3});
  const double floor = 2.0 * (std::sqrt(36.0 - 4.0) - 3.0);
  EXPECT_NEAR(ring[0].x - ring.back().x, floor, 1e-12);
  EXPECT_EQ(ring[0].y, -2.0);
  for (const Vec2 p : ring) {
    const double right = norm(p - Vec2{0, 0}), left = norm(p - Vec2{6, 0});
    if (p.y <= 0.0) {
      EXPECT_NEAR(p.x > 3.0 ? right : left, 6.0, 1e-12);
    }
    if (p.y >= 0.0) {
      EXPECT_NEAR(norm(p - Vec2{3, 0}), 3.0, 1e-12);
    }
  }
}

TEST(Shapes, AreMirrorImages) {
  for (const ShapeKind kind : {ShapeKind::arch, ShapeKind::horseshoe}) {
    const Ring ring = ring_of({kind, {0.0, 0.0}, 6.0, 5.0, 37});
    for (const Vec2 p : ring) {
      EXPECT_NE(std::find(ring.begin(), ring.end(), Vec2{-p.x, p.y}), ring.end());
    }
  }
}

TEST(Shapes, HeightGoesWithTheKind) {
  EXPECT_FALSE(shape_fault({ShapeKind::circle, {}, 4.0, 4.0, 48}).first.empty());
  EXPECT_FALSE(shape_fault({ShapeKind::arch, {}, 4.0, {}, 48}).first.empty());
  EXPECT_FALSE(shape_fault({ShapeKind::horseshoe, {}, 4.0, 2.0, 48}).first.empty());
  EXPECT_FALSE(shape_fault({ShapeKind::horseshoe, {}, 4.0, 5.3, 48}).first.empty());
  EXPECT_TRUE(shape_fault({ShapeKind::horseshoe, {}, 4.0, 5.2, 48}).first.empty());
  EXPECT_TRUE(shape_fault({ShapeKind::circle, {}, 4.0, {}, 48}).first.empty());
}

Slope slope() {
  Slope s;
  s.toe = {50, 20};
  s.height = 40.0;
  s.face_angle = 45.0;
  s.extent = {0, 130};
  return s;
}

TEST(Slopes, HaveAToeAndACrest) {
  const Ring ring = ring_of(slope());
  ASSERT_EQ(ring.size(), 6U);
  expect_simple(ring);
  const Ring expected{{0, 0}, {130, 0}, {130, 60}, {90, 60}, {50, 20}, {0, 20}};
  for (std::size_t i = 0; i < 6; ++i) EXPECT_NEAR(norm(ring[i] - expected[i]), 0.0, 1e-12);
}

TEST(Slopes, MayBeUpright) {
  Slope s = slope();
  s.face_angle = 90.0;
  EXPECT_EQ(ring_of(s), (Ring{{0, 0}, {130, 0}, {130, 60}, {50, 60}, {50, 20}, {0, 20}}));
}

TEST(Slopes, MayBeginAtTheToe) {
  Slope s = slope();
  s.toe.x = 0.0;
  EXPECT_EQ(ring_of(s).size(), 5U);
  expect_simple(ring_of(s));
}

TEST(Slopes, HaveBenches) {
  Slope s = slope();
  s.benches = 4;
  s.bench_width = 5.0;
  const Ring ring = ring_of(s);
  expect_simple(ring);
  ASSERT_EQ(ring.size(), 12U);
  EXPECT_NEAR(run_of(s), 40.0 + 15.0, 1e-12);
  EXPECT_NEAR(norm(ring[3] - Vec2{105, 60}), 0.0, 1e-12);  // crest
  EXPECT_NEAR(norm(ring[4] - Vec2{95, 50}), 0.0, 1e-12);   // toe of the highest face
  EXPECT_NEAR(norm(ring[5] - Vec2{90, 50}), 0.0, 1e-12);   // and the berm below it
  EXPECT_NEAR(norm(ring[10] - Vec2{50, 20}), 0.0, 1e-12);  // toe
}

}  // namespace
}  // namespace edda::shapes_test
