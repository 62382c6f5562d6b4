// Rings, free ends, bridges, regions, openings and outlines that are not convex.
#include <gtest/gtest.h>

#include "cutting/checks.hpp"
#include "cutting/line_models.hpp"

namespace edda::domain_test {
namespace {

using namespace test;

constexpr double snap = 1e-8;

Model square() {
  return domain_model(box(0, 0, 10, 10), snap);
}

int holes_of(const PolygonSet& set) {
  int holes = 0;
  for (const BlockPolygon& b : set.blocks) holes += static_cast<int>(b.rings.size()) - 1;
  return holes;
}

struct Expected {
  int blocks = 0, holes = 0, dangling = 0, bridging = 0;
};

/// The same counts as drawn and turned, and sound.
void expect_cut(const Model& model, Expected e) {
  for (double angle : {0.0, 10.0, 33.3, 90.0, 123.4, 271.0}) {
    SCOPED_TRACE(angle);
    const auto result = build_polygons(turned(model, angle));
    expect_sound(result, snap);
    ASSERT_TRUE(result.ok());
    EXPECT_EQ(static_cast<int>(result.value().blocks.size()), e.blocks);
    EXPECT_EQ(holes_of(result.value()), e.holes);
    EXPECT_EQ(result.value().report.dangling, e.dangling);
    EXPECT_EQ(result.value().report.bridging, e.bridging);
    EXPECT_EQ(result.value().report.snap_rounded, 0);
  }
}

std::vector<Vec2> ring_trace(double x0, double y0, double x1, double y1) {
  return {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}, {x0, y0}};
}

TEST(Domain, UncutIsOneBlock) {
  expect_cut(square(), {1, 0, 0, 0});
}

TEST(Domain, RingInABlockIsAHoleAndABlock) {
  Model model = square();
  add_trace(model, ring_trace(3, 3, 6, 7));
  expect_cut(model, {2, 1, 0, 0});
  add_trace(model, ring_trace(4, 4, 5, 5));
  expect_cut(model, {3, 2, 0, 0});
  add_trace(model, ring_trace(7, 7, 8, 8));
  add_trace(model, ring_trace(8, 7, 9, 8));  // shares a side with the one before: one hole
  expect_cut(model, {5, 3, 0, 0});
}

TEST(Domain, HolesAreFoundAmongManyRings) {
  Model model = square();
  for (int i = 0; i < 30; ++i) {
    for (int j = 0; j < 30; ++j) {
      const double x = 0.1 + i / 3.1, y = 0.1 + j / 3.1;
      add_trace(model, ring_trace(x, y, x + 0.2, y + 0.2));
      add_trace(model, ring_trace(x + 0.05, y + 0.05, x + 0.15, y + 0.1));
    }
  }
  expect_cut(model, {1801, 1800, 0, 0});
}

TEST(Domain, RingTouchingTheOutlineIsAHoleOfASimpleRing) {
  Model model = square();
  add_trace(model, {{5, 0}, {7, 3}, {3, 3}, {5, 0}});
  expect_cut(model, {2, 1, 0, 0});
  add_trace(model, {{5, 3}, {6, 5}, {4, 5}, {5, 3}});  // hangs on the first
  expect_cut(model, {3, 2, 0, 0});
}

TEST(Domain, FreeEndsAreTrimmedAndCounted) {
  Model model = square();
  add_trace(model, {{2, 2}, {4, 5}});
  expect_cut(model, {1, 0, 2, 0});
  add_trace(model, {{4, 2}, {2, 5}});  // crosses the first
  expect_cut(model, {1, 0, 4, 0});
  add_trace(model, {{10, 8}, {6, 8}, {5, 7}});  // from the outline
  expect_cut(model, {1, 0, 5, 0});
  add_trace(model, {{12, 9}, {-1, 9}});  // right across, its ends outside
  expect_cut(model, {2, 0, 5, 0});
}

TEST(Domain, BridgesAreRemovedUnlessTheyClose) {
  Model model = square();
  add_trace(model, ring_trace(4, 4, 6, 6));
  add_trace(model, {{0, 5}, {4, 5}});
  expect_cut(model, {2, 1, 0, 1});
  add_trace(model, {{2, 5}, {2, 8}});  // a free end on the bridge
  expect_cut(model, {2, 1, 1, 1});
  add_trace(model, {{6, 5}, {10, 5}});
  expect_cut(model, {3, 0, 1, 0});
}

TEST(Domain, SetInARegionEndsInBlocks) {
  Model model = square();
  add_set(model, 0.0, 1.0, {0, 0.5}, 1, box(2, 2, 8, 8));
  expect_cut(model, {1, 0, 12, 0});
  add_set(model, 90.0, 1.0, {0.5, 0}, 2, box(2, 2, 8, 8));
  expect_cut(model, {26, 1, 24, 0});
}

TEST(Domain, RegionUpToTheOutlineCutsThrough) {
  Model model = square();
  add_set(model, 0.0, 1.0, {0, 0.5}, 1, box(0, 2, 10, 8));
  expect_cut(model, {7, 0, 0, 0});
  Model beyond = square();
  add_set(beyond, 0.0, 1.0, {0, 0.5}, 1, box(-100, 2, 100, 8));
  expect_cut(beyond, {7, 0, 0, 0});
}

TEST(Domain, RegionNeedNotBeConvex) {
  Model model = square();
  const Ring u = {{1, 1}, {9, 1}, {9, 9}, {7, 9}, {7, 3}, {3, 3}, {3, 9}, {1, 9}};
  add_set(model, 0.0, 1.0, {0, 4.5}, 1, u);
  // y = 1.5, 2.5 in one piece; 3.5 to 8.5 in two.
  expect_cut(model, {1, 0, 2 * 2 + 6 * 4, 0});
}

TEST(Domain, JointsOnTheOutlineMakeNoSlivers) {
  Model model = square();
  add_set(model, 0.0, 1.0, {3, 5}, 1);
  add_set(model, 90.0, 2.0, {4, 1}, 2);
  expect_cut(model, {50, 0, 0, 0});
}

TEST(Domain, OutlineNeedNotBeConvex) {
  Model u = domain_model({{0, 0}, {9, 0}, {9, 9}, {6, 9}, {6, 3}, {3, 3}, {3, 9}, {0, 9}}, snap);
  add_trace(u, {{-1, 6}, {10, 6}});
  expect_cut(u, {3, 0, 0, 0});
  add_set(u, 0.0, 1.0, {0, 0.5});
  // 0.5, 1.5, 2.5 cut one piece, 3.5 to 8.5 two; 6 cuts two.
  expect_cut(u, {1 + 3 + 2 * 6 + 2, 0, 0, 0});
  add_trace(u, {{4.5, 5}, {4.5, 8}});  // in the notch, outside
  expect_cut(u, {1 + 3 + 2 * 6 + 2, 0, 0, 0});
}

TEST(Domain, SlotInTheOutlineThinnerThanSnapCloses) {
  const double w = 0.2 * snap;
  Model model =
      domain_model({{0, 0}, {10, 0}, {10, 10}, {5 + w, 10}, {5, 5}, {5 - w, 10}, {0, 10}}, snap);
  expect_cut(model, {1, 0, 0, 0});
  add_trace(model, {{-1, 5}, {11, 5}});
  expect_cut(model, {3, 0, 0, 0});
}

TEST(Domain, OpeningIsTakenOut) {
  Model model = square();
  add_opening(model, box(3, 3, 7, 7), 4);
  expect_cut(model, {1, 1, 0, 0});
  add_set(model, 0.0, 5.0, {0, 5});
  expect_cut(model, {2, 0, 0, 0});
  const auto result = build_polygons(model);
  EXPECT_DOUBLE_EQ(result.value().report.area_in, 84.0);
  EXPECT_EQ(result.value().removed.size(), 2u);
  EXPECT_NEAR(total_area(result.value().removed), 16.0, 1e-9);
  for (const BlockPolygon& gone : result.value().removed) EXPECT_EQ(gone.opening, 0);
  EXPECT_NEAR(length_by_law(result.value().blocks).at(4), 16.0, 1e-9);
  EXPECT_NEAR(length_by_law(result.value().removed).at(4), 16.0, 1e-9);
}

TEST(Domain, FreeEndsInAnOpeningDoNotCount) {
  Model model = square();
  add_opening(model, box(3, 3, 7, 7));
  add_trace(model, {{0, 5}, {5, 5}});
  add_trace(model, {{7, 5}, {10, 5}});
  expect_cut(model, {2, 0, 0, 0});
}

TEST(Domain, OpeningsMayOverlapAndReachOutside) {
  Model model = square();
  add_opening(model, box(3, 3, 6, 6));
  add_opening(model, box(5, 5, 12, 6));
  expect_cut(model, {1, 0, 0, 0});
  const auto result = build_polygons(model);
  EXPECT_NEAR(result.value().report.area_in, 100.0 - 9.0 - 4.0, 1e-9);
  EXPECT_NEAR(total_area(result.value().removed), 13.0, 1e-9);
}

TEST(Domain, AJointRoundAnOpeningLeavesRockBetween) {
  Model model = square();
  add_opening(model, box(4, 4, 6, 6));
  add_trace(model, ring_trace(3, 3, 7, 7));
  expect_cut(model, {2, 2, 0, 0});
}

TEST(Domain, LinesNearerThanSnapAreOne) {
  Model model = square();
  add_trace(model, {{-1, 5}, {11, 5}});
  add_trace(model, {{-1, 5 + 0.4 * snap}, {11, 5 + 0.4 * snap}});
  expect_cut(model, {2, 0, 0, 0});
}

TEST(Domain, SliversAreMergedAndCounted) {
  Model model = square();
  add_trace(model, {{-1, 5}, {11, 5}});
  add_trace(model, {{-1, 5 + 1.6 * snap}, {11, 5 + 1.6 * snap}});
  const auto result = build_polygons(model);
  expect_sound(result, snap);
  EXPECT_EQ(result.value().blocks.size(), 2u);
  EXPECT_EQ(result.value().report.merged, 1);
}

TEST(Domain, ThinBlocksAreReported) {
  Model model = square();
  add_trace(model, {{-1, 5}, {11, 5}});
  add_trace(model, {{-1, 5.001}, {11, 5.001}});
  const auto result = build_polygons(model);
  expect_sound(result, snap);
  ASSERT_EQ(result.value().blocks.size(), 3u);
  EXPECT_NEAR(result.value().report.smallest_area, 0.01, 1e-9);
  EXPECT_NEAR(result.value().report.smallest_edge, 0.001, 1e-9);
  EXPECT_NEAR(result.value().report.smallest_area_at.x, 5.0, 1e-9);
  EXPECT_NEAR(result.value().report.smallest_area_at.y, 5.0005, 1e-9);
}

TEST(Domain, CutBlocksComeByCentroid) {
  Model model = square();
  add_set(model, 0.0, 1.0, {0, 0});
  add_set(model, 90.0, 1.0, {0, 0});
  const auto result = build_polygons(shifted(model, {1234.567, 89.1}));
  ASSERT_TRUE(result.ok());
  ASSERT_EQ(result.value().blocks.size(), 100u);
  for (int id = 0; id < 100; ++id) {
    const Vec2 c = moments(result.value().blocks[static_cast<std::size_t>(id)].rings).centroid;
    EXPECT_NEAR(c.x, id % 10 - 4.5, 1e-9);
    EXPECT_NEAR(c.y, id / 10 - 4.5, 1e-9);
  }
}

TEST(Domain, DegenerateTablesDoNotCrash) {
  EXPECT_FALSE(build_polygons(domain_model({}, snap)).ok());
  EXPECT_FALSE(build_polygons(domain_model({{0, 0}, {1, 1}}, snap)).ok());
  EXPECT_FALSE(build_polygons(domain_model({{0, 0}, {1, 1}, {2, 2}}, snap)).ok());
  EXPECT_FALSE(build_polygons(domain_model({{0, 0}, {1, 0}, {0, 0}}, snap)).ok());
  EXPECT_FALSE(build_polygons(domain_model({{0, 0}, {1, 1}, {1, 0}, {0, 1}}, snap)).ok());
  EXPECT_FALSE(build_polygons(domain_model(box(0, 0, 1e-9, 1e-9), 1e-8)).ok());
  Model model = square();
  add_trace(model, {});
  add_trace(model, {{1, 1}});
  add_trace(model, {{1, 1}, {1, 1}});
  add_trace(model, {{2, 2}, {2, 2 + 0.1 * snap}});
  expect_cut(model, {1, 0, 0, 0});
  Model block;
  add_block(block, {});
  EXPECT_FALSE(build_polygons(block).ok());
}

}  // namespace
}  // namespace edda::domain_test
