#include "report/shapes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "report/two_blocks.hpp"

namespace edda::shapes_test {
namespace {

TEST(Shapes, TrianglesOfOneBlockHaveOneOutline) {
  const Grid g = two_blocks();
  const auto shapes = block_shapes(g);
  ASSERT_EQ(shapes.size(), 2u);
  for (const BlockShape& shape : shapes) {
    EXPECT_EQ(shape.outline.size(), 4u);
    ASSERT_EQ(shape.rings.size(), 1u);
    EXPECT_EQ(shape.rings[0].size(), 4u);
  }
  const Vec2 c = centre_of(g, shapes[0], drawn_points(g, 1.0));
  EXPECT_NEAR(c.x, 0.5, 1e-12);
  EXPECT_NEAR(c.y, 0.5, 1e-12);
}

/// A square of this side round a square hole between a and b along x and y, of eight triangles.
Grid square_with_hole(double side, double a, double b) {
  Grid g;
  g.points = {0, 0, 0, side, 0, 0, side, side, 0, 0, side, 0, a, a, 0, b, a, 0, b, b, 0, a, b, 0};
  g.corners = {0, 1, 5, 0, 5, 4, 1, 2, 6, 1, 6, 5, 2, 3, 7, 2, 7, 6, 3, 0, 4, 3, 4, 7};
  for (int c = 1; c <= 8; ++c) {
    g.ends.push_back(3 * c);
    g.types.push_back(cell_type::triangle);
  }
  g.cell_fields = {{"id", 1, std::vector<double>(8, 0.0), {}, true}};
  return g;
}

TEST(Shapes, AHoleIsARingOfItsOwn) {
  const Grid g = square_with_hole(3, 1, 2);
  const auto shapes = block_shapes(g);
  ASSERT_EQ(shapes.size(), 1u);
  ASSERT_EQ(shapes[0].rings.size(), 2u);
  EXPECT_EQ(shapes[0].rings[0].size(), 4u);
  EXPECT_EQ(shapes[0].rings[1].size(), 4u);
  // The centre is in the hole, marks of the block are in the rock.
  const std::vector<Vec2> points = drawn_points(g, 1.0);
  const Vec2 at = mark_place(g, shapes[0], points);
  EXPECT_GT(std::max(std::abs(at.x - 1.5), std::abs(at.y - 1.5)), 0.6);
  EXPECT_LT(std::max(std::abs(at.x - 1.5), std::abs(at.y - 1.5)), 1.4);
}

TEST(Shapes, MarksLieInTheBlock) {
  // An L of two arms: its centre lies outside the thin ones.
  for (const double wide : {0.2, 0.5, 1.0, 1.6}) {
    Grid g;
    g.points = {0, 0, 0, 2, 0, 0, 2, wide, 0, wide, wide, 0, wide, 2, 0, 0, 2, 0};
    g.corners = {0, 1, 2, 0, 2, 3, 0, 3, 4, 0, 4, 5};
    for (int c = 1; c <= 4; ++c) {
      g.ends.push_back(3 * c);
      g.types.push_back(cell_type::triangle);
    }
    g.cell_fields = {{"id", 1, std::vector<double>(4, 0.0), {}, true}};
    const auto shapes = block_shapes(g);
    const Vec2 at = mark_place(g, shapes[0], drawn_points(g, 1.0));
    EXPECT_LT(std::min(at.x, at.y), wide) << wide;
    EXPECT_GT(std::min(at.x, at.y), 0.0) << wide;
    const Vec2 centre = centre_of(g, shapes[0], drawn_points(g, 1.0));
    EXPECT_TRUE(centre.x >= wide || at == centre) << wide;
  }
}

TEST(Shapes, MarksLieBesideAHole) {
  // A square of 4 m with a hole from 1 m to 1 m + `wide`: not through the middle of the narrow
  // ones.
  for (const double wide : {0.5, 1.0, 1.5, 2.0, 2.5}) {
    const double a = 1.0, b = a + wide;
    const Grid g = square_with_hole(4, a, b);
    const auto shapes = block_shapes(g);
    const Vec2 at = mark_place(g, shapes[0], drawn_points(g, 1.0));
    const bool in_hole = at.x > a && at.x < b && at.y > a && at.y < b;
    EXPECT_FALSE(in_hole) << wide;
    EXPECT_GT(std::min(at.x, at.y), 0.0) << wide;
    EXPECT_LT(std::max(at.x, at.y), 4.0) << wide;
    const Vec2 centre = centre_of(g, shapes[0], drawn_points(g, 1.0));
    EXPECT_TRUE(std::min(centre.x, centre.y) < b || at == centre) << wide;
  }
}

TEST(Shapes, MaterialPointsAreFollowed) {
  const Grid g = two_blocks();
  const auto drawn = drawn_points(g, 3.0);
  const Follower follow(g, drawn_points(g, 0.0), drawn);
  const auto now = follow({-0.25, 0.75});  // in block 4 as it lay at the start
  ASSERT_TRUE(now);
  EXPECT_NEAR(now->x, -0.25 + 1.5, 1e-12);
  EXPECT_NEAR(now->y, 0.75, 1e-12);
  EXPECT_FALSE(follow({9.0, 9.0}));
  // Outside by as much as its surface had settled before.
  const Vec2 above{-0.25, 1.0 + 1e-4};
  EXPECT_FALSE(follow(above));
  const auto surface = follow.on_surface(above);
  ASSERT_TRUE(surface);
  EXPECT_NEAR(surface->x, -0.25 + 1.5, 1e-12);
  EXPECT_NEAR(surface->y, above.y, 1e-12);
  EXPECT_FALSE(follow.on_surface({9.0, 9.0}));
}

TEST(Shapes, OnePerSquareIsLeftWhenThinned) {
  const std::vector<Vec2> centres{{0.1, 0.1}, {0.5, 0.6}, {0.9, 0.9}, {1.5, 0.5}};
  EXPECT_EQ(thinned(centres, 1.0), (std::vector<std::size_t>{1, 3}));
  EXPECT_EQ(thinned(centres, 0.1).size(), 4u);
}

TEST(Follower, OnABorderGoesWithTheBlockThatIsFree) {
  Grid g = two_blocks();
  for (std::size_t k = 12; k < g.points.size(); k += 3) g.points[k] -= 1.0;  // beside each other
  g.cell_fields[1].values = {1, 1, 0};
  const std::vector<Vec2> from = drawn_points(g, 0.0);
  std::vector<Vec2> to = from;
  for (std::size_t k = 4; k < to.size(); ++k) to[k] += Vec2{0.0, 0.25};
  const Vec2 border{0.5, 0.5};
  EXPECT_NEAR(Follower(g, from, to)(border)->y, 0.75, 1e-12);
  g.cell_fields[1].values = {0, 0, 1};
  EXPECT_NEAR(Follower(g, from, to)(border)->y, 0.5, 1e-12);
}

}  // namespace
}  // namespace edda::shapes_test
