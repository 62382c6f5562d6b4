#include "cutting/overlaps.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "cutting/checks.hpp"
#include "cutting/line_models.hpp"

namespace edda::overlaps_test {
namespace {

using namespace test;

BlockPolygon polygon(std::vector<Ring> rings) {
  BlockPolygon block;
  block.rings = std::move(rings);
  return block;
}

/// The depth, which must not depend on order, place or direction.
double depth(const std::vector<Ring>& a, const std::vector<Ring>& b) {
  const double d = overlap_depth(polygon(a), polygon(b));
  for (double angle : {0.0, 0.3, 1.0, 2.5, 4.0}) {
    const auto moved = [&](std::vector<Ring> rings) {
      for (Ring& ring : rings) {
        for (Vec2& p : ring) p = rotated(p, angle) + Vec2{7.0, -3.0};
      }
      return polygon(rings);
    };
    EXPECT_NEAR(overlap_depth(moved(a), moved(b)), d, 1e-12 + 0.5 * d);
    EXPECT_EQ(overlap_depth(moved(a), moved(b)), overlap_depth(moved(b), moved(a)));
  }
  return d;
}

TEST(OverlapDepth, IsZeroWhereBlocksAreApartOrTouch) {
  const Ring unit = box(0, 0, 1, 1);
  EXPECT_EQ(depth({unit}, {box(2, 0, 3, 1)}), 0.0);
  EXPECT_NEAR(depth({unit}, {box(1, 0, 2, 1)}), 0.0, 1e-15);
  EXPECT_NEAR(depth({unit}, {box(1, 0.5, 2, 3)}), 0.0, 1e-15);
  EXPECT_NEAR(depth({unit}, {box(1, 1, 2, 2)}), 0.0, 1e-15);
  EXPECT_NEAR(depth({unit}, {{{1, 0.5}, {2, 0}, {2, 1}}}), 0.0, 1e-15);
}

TEST(OverlapDepth, FindsCornersEdgesAndCrosses) {
  const Ring unit = box(0, 0, 1, 1);
  EXPECT_NEAR(depth({unit}, {box(0.9, 0, 2, 1)}), 0.1, 1e-12);
  EXPECT_NEAR(depth({unit}, {box(0.9, 0.2, 2, 0.8)}), 0.1, 1e-12);
  EXPECT_NEAR(depth({unit}, {box(0.9, 0.8, 2, 2)}), 0.1, 1e-12);
  EXPECT_NEAR(depth({unit}, {{{0.9, 0.5}, {2, 0}, {2, 1}}}), 0.1, 1e-12);
  EXPECT_GT(depth({box(-5, -0.5, 5, 0.5)}, {box(-0.5, -5, 0.5, 5)}), 0.4);
}

TEST(OverlapDepth, FindsOneOnAnother) {
  const Ring unit = box(0, 0, 1, 1);
  EXPECT_NEAR(depth({unit}, {unit}), 1.0, 0.3);
  EXPECT_NEAR(depth({unit}, {box(0.4, 0.4, 0.6, 0.6)}), 0.4, 1e-12);
  EXPECT_GT(depth({unit}, {box(0.2, 0, 0.5, 1)}), 0.2);
  const Ring comb = {{0, 0}, {5, 0}, {5, 3}, {4, 3}, {4, 1}, {3, 1},
                     {3, 3}, {2, 3}, {2, 1}, {1, 1}, {1, 3}, {0, 3}};
  EXPECT_GT(depth({comb}, {comb}), 0.4);
}

TEST(OverlapDepth, KnowsHoles) {
  Ring hole = box(1, 1, 4, 4);
  std::reverse(hole.begin(), hole.end());
  const std::vector<Ring> frame = {box(0, 0, 5, 5), hole};
  EXPECT_EQ(depth(frame, {box(2, 2, 3, 3)}), 0.0);
  EXPECT_NEAR(depth(frame, {box(1, 1, 4, 4)}), 0.0, 1e-15);
  EXPECT_NEAR(depth(frame, {box(1, 2, 2, 3)}), 0.0, 1e-15);
  EXPECT_NEAR(depth(frame, {box(0.8, 2, 3, 3)}), 0.2, 1e-12);
  EXPECT_GT(depth(frame, {box(0, 0, 5, 5)}), 0.4);
  EXPECT_GT(depth(frame, frame), 0.4);
}

/// Two unit blocks, the second let into the first by `d`.
Model let_in(double d) {
  Model model;
  add_block(model, box(0, 0, 1, 1));
  add_block(model, box(1 - d, 0.3, 2 - d, 1.3));
  model.blocks[0].name = "base";
  return model;
}

TEST(Overlaps, AreAllowedToAThousandthOfTheSmaller) {
  for (double angle = 0.0; angle < 360.0; angle += 15.0) {
    EXPECT_TRUE(build_polygons(turned(let_in(0.99e-3), angle)).ok());
    EXPECT_FALSE(build_polygons(turned(let_in(1.01e-3), angle)).ok());
    EXPECT_TRUE(build_polygons(scaled(turned(let_in(0.99e-3), angle), 100.0)).ok());
    EXPECT_FALSE(build_polygons(scaled(turned(let_in(1.01e-3), angle), 100.0)).ok());
  }
}

/// A tilted wall of bricks, its coordinates rounded to some decimals: blocks that touch, written
/// down.
Model rounded_wall(int decimals) {
  Model model;
  const double unit = std::pow(10.0, -decimals);
  for (int row = 0; row < 6; ++row) {
    for (int i = 0; i < 8; ++i) {
      const double x = 0.4 * i + 0.2 * (row % 2), y = 0.3 * row;
      Ring ring = box(x, y, x + 0.4, y + 0.3);
      for (Vec2& p : ring) {
        p = rotated(p, 0.2);
        p = {unit * std::round(p.x / unit), unit * std::round(p.y / unit)};
      }
      add_block(model, ring);
    }
  }
  return model;
}

TEST(Overlaps, OfRoundedCoordinatesAreNoFault) {
  for (const int decimals : {3, 4, 5, 6, 9}) {
    const auto result = build_polygons(rounded_wall(decimals));
    ASSERT_TRUE(result.ok()) << decimals << ' ' << to_string(result.faults()[0]);
    EXPECT_NEAR(result.value().report.rounding, 1.5 * std::pow(10.0, -decimals), 1e-12);
  }
  // What is drawn into each other by more is one, to however few digits.
  Model model = rounded_wall(3);
  for (Vec2& p : model.blocks[20].polygon) p.x += 0.005;
  EXPECT_FALSE(build_polygons(model).ok());
}

/// Numbers that look alike do not tell which is larger.
TEST(Overlaps, AreToldApartFromWhatIsAllowed) {
  const auto result = build_polygons(let_in(1.00000003e-3));
  ASSERT_FALSE(result.ok());
  EXPECT_NE(result.faults()[0].problem.find("by 0.00100000003 m, more than 0.001 m"),
            std::string::npos)
      << result.faults()[0].problem;
}

TEST(Overlaps, NameBothBlocksAndTheDepth) {
  const auto result = build_polygons(let_in(0.125));
  ASSERT_FALSE(result.ok());
  const Fault& fault = result.faults()[0];
  EXPECT_EQ(fault.where.key, "block.1");
  EXPECT_NE(fault.problem.find("block 1 overlaps block \"base\" by 0.125 m"), std::string::npos)
      << fault.problem;
}

TEST(Overlaps, OfHeldBlocksAreFree) {
  Model model = let_in(0.5);
  model.blocks[0].fixed = true;
  EXPECT_FALSE(build_polygons(model).ok());
  model.blocks[1].fixed = true;
  EXPECT_TRUE(build_polygons(model).ok());
}

TEST(Overlaps, WithTheDomainsRockCount) {
  Model model = domain_model(box(0, 0, 10, 10), 1e-8);
  add_opening(model, box(4, 4, 6, 6));
  add_set(model, 0.0, 1.0, {0, 0.5});
  add_block(model, box(4, 4, 6, 6));  // fills the opening
  EXPECT_TRUE(build_polygons(model).ok()) << reason(build_polygons(model));
  model.blocks[0].polygon = box(4, 10, 6, 12);  // stands on top
  EXPECT_TRUE(build_polygons(model).ok());
  model.blocks[0].polygon = box(4, 9.8, 6, 12);
  const auto result = build_polygons(model);
  ASSERT_FALSE(result.ok());
  EXPECT_EQ(result.faults()[0].where.key, "block.0");
  EXPECT_NE(result.faults()[0].problem.find("cut block"), std::string::npos);
}

TEST(Overlaps, OfWallsCount) {
  Model model;
  BrickWall wall;
  wall.columns = 4;
  wall.rows = 3;
  wall.brick = {1.0, 0.5};
  wall.where = {"brick_wall.0", "test.toml", 7, 1};
  model.walls = {wall};
  add_block(model, box(-1, -1, 5, 0));
  EXPECT_TRUE(build_polygons(model).ok());
  model.walls.push_back(wall);
  const auto result = build_polygons(model);
  ASSERT_FALSE(result.ok());
  EXPECT_EQ(result.faults().size(), 10u);
  EXPECT_NE(result.faults().back().problem.find("more pairs"), std::string::npos);
}

TEST(Overlaps, AgreeWithTryingAllPairs) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> place(0.0, 10.0), size(0.1, 0.6), angle(0.0, 6.28);
  for (int round = 0; round < 20; ++round) {
    std::vector<BlockPolygon> blocks;
    for (int i = 0; i < 40; ++i) {
      const Vec2 at{place(random), place(random)};
      const double w = size(random), h = size(random), a = angle(random);
      Ring ring;
      for (Vec2 p : box(-w, -h, w, h)) ring.push_back(at + rotated(p, a));
      blocks.push_back(polygon({ring}));
      blocks.back().fixed = random() % 2;
    }
    const std::size_t first_cut = 30;
    std::size_t pairs = 0;
    for (std::size_t i = 0; i < first_cut; ++i) {
      for (std::size_t j = i + 1; j < blocks.size(); ++j) {
        if (blocks[i].fixed && blocks[j].fixed) continue;
        pairs += overlap_depth(blocks[i], blocks[j]) > allowed_overlap(blocks[i], blocks[j]);
      }
    }
    const Faults faults = find_overlaps(blocks, first_cut);
    EXPECT_EQ(faults.size(), std::min<std::size_t>(pairs, 10));
    if (pairs > 10) {
      EXPECT_NE(faults.back().problem.find("so do " + std::to_string(pairs - 10) + " more"),
                std::string::npos);
    }
  }
}

TEST(Overlaps, AreSoughtFastInALargeWall) {
  Model model;
  BrickWall wall;
  wall.columns = 5000;
  wall.rows = 20;
  wall.brick = {1.0, 0.5};
  model.walls = {wall};
  add_block(model, box(-1, -1, 5001, 0));
  const auto result = build_polygons(model);
  ASSERT_TRUE(result.ok());
  EXPECT_EQ(result.value().blocks.size(), 100011u);
}

}  // namespace
}  // namespace edda::overlaps_test
