#include "cutting/given_blocks.hpp"

#include <gtest/gtest.h>

#include <map>
#include <utility>

#include "base/polygon.hpp"
#include "cutting/build_polygons.hpp"

namespace edda::given_blocks_test {
namespace {

Model wall_model(int columns, int rows, Vec2 origin, Vec2 brick) {
  Model model;
  BrickWall wall;
  wall.origin = origin;
  wall.columns = columns;
  wall.rows = rows;
  wall.brick = brick;
  wall.material = 2;
  wall.joint = 5;
  model.walls.push_back(wall);
  return model;
}

TEST(GivenBlocks, TurnCounterClockwiseAndKeepFileOrder) {
  Model model;
  BlockInput ccw, cw;
  ccw.name = "a";
  ccw.polygon = {{10, 0}, {12, 0}, {12, 1}, {10, 1}};
  ccw.joint = 3;
  ccw.velocity = {1, 2};
  ccw.angular_velocity = 0.5;
  cw.name = "b";
  cw.polygon = {{0, 0}, {0, 1}, {2, 1}, {2, 0}};
  cw.fixed = true;
  model.blocks = {ccw, cw};
  const auto result = build_polygons(model);
  ASSERT_TRUE(result.ok());
  const PolygonSet& set = result.value();
  ASSERT_EQ(set.blocks.size(), 2u);
  EXPECT_EQ(set.origin, (Vec2{6.0, 0.5}));
  EXPECT_EQ(set.blocks[0].name, "a");
  EXPECT_DOUBLE_EQ(signed_area(set.blocks[0].rings[0]), 2.0);
  EXPECT_DOUBLE_EQ(signed_area(set.blocks[1].rings[0]), 2.0);
  EXPECT_EQ(set.blocks[0].joint, (std::vector<std::vector<Index>>{{3, 3, 3, 3}}));
  EXPECT_EQ(set.blocks[1].joint, (std::vector<std::vector<Index>>{{none, none, none, none}}));
  EXPECT_EQ(set.blocks[0].rings[0][0], (Vec2{4.0, -0.5}));
  EXPECT_EQ(set.blocks[0].velocity, (Vec2{1, 2}));
  EXPECT_EQ(set.blocks[0].angular_velocity, 0.5);
  EXPECT_TRUE(set.blocks[1].fixed);
  EXPECT_DOUBLE_EQ(set.report.smallest_area, 2.0);
  EXPECT_DOUBLE_EQ(set.report.smallest_edge, 1.0);
  EXPECT_DOUBLE_EQ(set.report.smallest_angle, 90.0);
}

TEST(Walls, CountBricksAndHalfBricks) {
  const auto small = build_polygons(wall_model(3, 2, {0, 0}, {1, 0.5}));
  ASSERT_TRUE(small.ok());
  EXPECT_EQ(small.value().blocks.size(), 7u);
  const auto single = build_polygons(wall_model(1, 2, {0, 0}, {1, 0.5}));
  EXPECT_EQ(single.value().blocks.size(), 3u);
  const auto large = build_polygons(wall_model(1000, 20, {0, 0}, {1, 0.5}));
  EXPECT_EQ(large.value().blocks.size(), 20010u);
}

TEST(Walls, RunRowByRowFromTheLowerLeft) {
  const auto result = build_polygons(wall_model(7, 9, {3, 4}, {0.3, 0.1}));
  ASSERT_TRUE(result.ok());
  Vec2 last{-1e9, -1e9};
  double area = 0.0;
  for (const BlockPolygon& block : result.value().blocks) {
    const Moments m = moments(block.rings);
    area += m.area;
    EXPECT_TRUE(m.centroid.y > last.y + 0.05 || m.centroid.x > last.x + 0.05);
    EXPECT_GT(m.centroid.y, last.y - 1e-9);
    EXPECT_EQ(block.material, 2);
    EXPECT_EQ(block.joint[0], (std::vector<Index>(4, 5)));
    last = m.centroid;
  }
  EXPECT_NEAR(area, 7 * 0.3 * 9 * 0.1, 1e-12);
}

TEST(Walls, SharedCornersHaveTheSameBits) {
  const auto result = build_polygons(wall_model(200, 50, {0.1, 0.7}, {0.3, 0.1}));
  ASSERT_TRUE(result.ok());
  // Every distinct coordinate must be a distinct corner: 401 half bricks across, 51 lines up.
  std::map<double, int> xs, ys;
  for (const BlockPolygon& block : result.value().blocks) {
    for (Vec2 p : block.rings[0]) ++xs[p.x], ++ys[p.y];
  }
  EXPECT_EQ(xs.size(), 401u);
  EXPECT_EQ(ys.size(), 51u);
}

}  // namespace
}  // namespace edda::given_blocks_test
