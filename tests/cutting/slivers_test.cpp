// [quality]: what is merged, into what, and what stays as it is.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "cutting/checks.hpp"
#include "cutting/line_models.hpp"

namespace edda::slivers_test {
namespace {

using namespace test;

constexpr double snap = 1e-8;

Model square() {
  return domain_model(box(0, 0, 10, 10), snap);
}

PolygonSet cut(const Model& model) {
  const auto result = build_polygons(model);
  expect_sound(result, snap);
  return result.ok() ? result.value() : PolygonSet{};
}

Quality limits(double area, double edge, double angle = 0.0) {
  Quality q;
  q.min_area = area;
  q.min_edge = edge;
  q.min_angle = angle;
  return q;
}

/// A joint right through at y = 5; on it two that end there, x = 3 and x = 7; and between those one
/// that leaves a strip of 4 m x 0.03 m on the first.
Model strip() {
  Model model = square();
  add_trace(model, {{-1, 5}, {11, 5}}, 1);
  add_trace(model, {{3, 5}, {3, 11}}, 2);
  add_trace(model, {{7, 5}, {7, 11}}, 2);
  add_trace(model, {{3, 5.03}, {7, 5.03}}, 3);
  return model;
}

double area_round(const PolygonSet& set, Vec2 point) {
  for (const BlockPolygon& block : set.blocks) {
    if (side_of(block.rings, point - set.origin, 0.0) > 0) return moments(block.rings).area;
  }
  return 0.0;
}

/// Of its four faces the shortest are the tips of joints that end there; the one below runs
/// through.
TEST(Slivers, JoinTheNeighbourAcrossTheirShortestEdge) {
  Model model = strip();
  EXPECT_EQ(cut(model).blocks.size(), 5U);
  model.quality = limits(0.0, 0.05);
  const PolygonSet set = cut(model);
  EXPECT_EQ(set.blocks.size(), 4U);
  EXPECT_EQ(set.report.quality_merged, 1);
  EXPECT_NEAR(set.report.quality_area, 0.12, 1e-9);
  EXPECT_EQ(set.report.slivers, 0);
  EXPECT_EQ(set.report.merged, 0);
  EXPECT_NEAR(area_round(set, {5, 2}), 50.0, 1e-9);
  EXPECT_NEAR(area_round(set, {5, 8}), 19.88, 1e-9);
  EXPECT_NEAR(area_round(set, {1, 8}) + area_round(set, {9, 8}), 30.12, 1e-9);
  ASSERT_EQ(set.report.merges.size(), 1U);
  const MergedSliver& merge = set.report.merges[0];
  EXPECT_NEAR(norm(merge.at - Vec2{5, 5.015}), 0.0, 1e-6);
  EXPECT_NEAR(merge.area, 0.12, 1e-9);
  EXPECT_NEAR(merge.face, 0.03, 1e-9);
  EXPECT_TRUE(merge.joint == "trace.1" || merge.joint == "trace.2") << merge.joint;
}

TEST(Slivers, ThinStripsBetweenJointsThatRunThroughStay) {
  Model model = square();
  add_trace(model, {{-1, 5}, {11, 5}});
  add_trace(model, {{-1, 5.03}, {11, 5.03}});
  model.quality = limits(0.0, 0.05);
  const PolygonSet set = cut(model);
  EXPECT_EQ(set.blocks.size(), 3U);
  EXPECT_EQ(set.report.quality_merged, 0);
  EXPECT_EQ(set.report.slivers, 1);
  ASSERT_EQ(set.report.kept.size(), 1U);
  EXPECT_NEAR(norm(set.report.kept[0].at - Vec2{5, 5.015}), 0.0, 1e-6);
  EXPECT_NEAR(set.report.kept[0].area, 0.3, 1e-9);
  for (const BlockPolygon& block : set.blocks) {
    EXPECT_EQ(block.slow, moments(block.rings).area < 1.0);
  }
}

/// A third line cuts off a triangle where two cross: it stays where all run through, and joins what
/// lies beyond the third where that ends on the two.
TEST(Slivers, SmallTrianglesAtNearCrossingsGoWhereOneJointEnds) {
  Model model = square();
  add_trace(model, {{-1, 5}, {11, 5}});
  add_trace(model, {{5, -1}, {5, 11}});
  Model ends = model;
  add_trace(model, {{-1, 11.05}, {11, -0.95}});
  EXPECT_EQ(cut(model).blocks.size(), 7U);
  model.quality = limits(0.01, 0.0);
  EXPECT_EQ(cut(model).blocks.size(), 7U);
  add_trace(ends, {{5, 5.05}, {5.05, 5}});
  EXPECT_EQ(cut(ends).blocks.size(), 5U);
  ends.quality = limits(0.01, 0.0);
  const PolygonSet set = cut(ends);
  EXPECT_EQ(set.blocks.size(), 4U);
  ASSERT_EQ(set.report.merges.size(), 1U);
  EXPECT_EQ(set.report.merges[0].joint, "trace.2");
  for (const BlockPolygon& block : set.blocks) EXPECT_NEAR(moments(block.rings).area, 25.0, 1e-9);
}

TEST(Slivers, MergedBlocksKeepTheLawsOfTheEdgesThatStay) {
  Model model = strip();
  model.quality = limits(0.0, 0.05);
  auto length = length_by_law(cut(model).blocks);
  EXPECT_NEAR(length[1], 20.0, 1e-6);
  EXPECT_NEAR(length[2], 2.0 * (10.0 - 0.03), 1e-6);
  EXPECT_NEAR(length[3], 8.0, 1e-6);
}

TEST(Slivers, ManyStripsGrowStepByStep) {
  Model model = square();
  add_trace(model, {{2, -1}, {2, 11}});
  add_trace(model, {{8, -1}, {8, 11}});
  add_set(model, 0.0, 0.1, {0, 0.05}, none, box(2, -1, 8, 11));
  EXPECT_EQ(cut(model).blocks.size(), 103U);
  model.quality = limits(0.0, 0.35);
  const PolygonSet set = cut(model);
  EXPECT_EQ(set.report.slivers, 0);
  EXPECT_GT(set.blocks.size(), 12U);  // and not one of them all
  EXPECT_EQ(set.report.merges.size() + set.blocks.size(), 103U);
  EXPECT_NEAR(area_round(set, {1, 5}), 20.0, 1e-9);
  for (const BlockPolygon& block : set.blocks) EXPECT_LT(moments(block.rings).area, 20.1);
}

/// Each tooth has but one face that it may lose, that to the long block above.
TEST(Slivers, ManyBesideOneLongFaceGoAtOnce) {
  constexpr int n = 3000;
  Model model = domain_model(box(0, 0, n, 4), snap);
  add_trace(model, {{-1, 2}, {n + 1, 2}});
  for (int i = 0; i < n; ++i) add_trace(model, {{i + 0.1, 2}, {i + 0.5, 2.05}, {i + 0.9, 2}});
  model.quality = limits(0.0, 0.1);
  model.fixed.push_back({{1, 1}, {"fixed.0", "test.toml", 1, 1}});
  const PolygonSet set = cut(model);
  EXPECT_EQ(set.report.merges.size(), static_cast<std::size_t>(n));
  ASSERT_EQ(set.blocks.size(), 2U);
  for (const BlockPolygon& block : set.blocks) {
    EXPECT_NEAR(moments(block.rings).area, 2.0 * n, 1e-6);
    EXPECT_EQ(block.rings[0].size(), 4U);
  }
}

/// How far a block reaches beyond a line on both of its sides, the lesser, m.
double reach_across(const BlockPolygon& block, Vec2 a, Vec2 b) {
  const Vec2 t = unit(b - a);
  double left = 0.0, right = 0.0;
  for (const Vec2 p : block.rings[0]) {
    left = std::max(left, cross(t, p - a));
    right = std::max(right, -cross(t, p - a));
  }
  return std::min(left, right);
}

/// Lines right through, and traces at random that end on them and on one another: whatever is
/// merged, no rock lies across the former, and none is lost.
TEST(Slivers, NoRockIsPutAcrossAJointThatRunsThrough) {
  std::size_t merged = 0, kept = 0;
  for (unsigned seed = 0; seed < 60; ++seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> place(0.0, 10.0), turn(0.0, std::numbers::pi),
        length(0.5, 5.0);
    Model model = square();
    std::vector<std::pair<Vec2, Vec2>> through;
    for (int i = 0; i < 8; ++i) {
      const Vec2 p{place(random), place(random)}, d = rotated({20.0, 0.0}, turn(random));
      through.emplace_back(p - d, p + d);
      add_trace(model, {p - d, p + d}, 0);
    }
    for (int i = 0; i < 60; ++i) {
      const Vec2 p{place(random), place(random)}, d = rotated({length(random), 0.0}, turn(random));
      add_trace(model, {p, p + d}, 1);
    }
    model.quality = limits(0.03, 0.1, seed % 2 == 0 ? 0.0 : 4.0);
    const PolygonSet set = cut(model);
    EXPECT_NEAR(set.report.area_out, set.report.area_in, 1e-9 * set.report.area_in);
    EXPECT_EQ(set.report.merges.size(), static_cast<std::size_t>(set.report.quality_merged));
    for (const auto& [a, b] : through) {
      for (const BlockPolygon& block : set.blocks) {
        EXPECT_LT(reach_across(block, a - set.origin, b - set.origin), 1e-6) << seed;
      }
    }
    merged += set.report.merges.size();
    kept += set.report.kept.size();
  }
  EXPECT_GT(merged, 300U);
  EXPECT_GT(kept, 50U);
}

TEST(Slivers, WellShapedBlocksWithAShortEdgeStay) {
  Model model = square();
  add_trace(model, {{-1, 0.1 - 0.1}, {11, 1.2}});  // leaves the left side 0.1 above its foot
  model.quality = limits(0.01, 0.2);
  const PolygonSet set = cut(model);
  EXPECT_EQ(set.blocks.size(), 2U);
  EXPECT_EQ(set.report.quality_merged, 0);
  EXPECT_EQ(set.report.short_edges, 1);
}

TEST(Slivers, SharpWedgesGoWhereTheirCornerGoesWithThem) {
  Model model = square();
  add_trace(model, {{-1, 5}, {11, 5}});
  add_trace(model, {{8, 5}, {8, 11}});
  add_trace(model, {{2, 5}, {8, 5.2}});  // leaves the first at 1.9 degrees
  EXPECT_EQ(cut(model).blocks.size(), 4U);
  model.quality = limits(0.0, 0.0, 3.0);
  const PolygonSet set = cut(model);
  EXPECT_EQ(set.blocks.size(), 3U);
  EXPECT_NEAR(area_round(set, {5, 8}), 40.0, 1e-9);
  Model surface = square();
  add_trace(surface, {{-1, 0.0}, {2, 0.0}, {12, 0.3}});  // it runs through
  surface.quality = limits(0.0, 0.0, 3.0);
  EXPECT_EQ(cut(surface).blocks.size(), 2U);
  // Two sets at 2 degrees: every block is sharp twice, and would be after any merging.
  Model rhombs = domain_model(box(0, 0, 200, 6), snap);
  add_set(rhombs, 0.0, 1.0, {0, 0.5});
  add_set(rhombs, 2.0, 1.0, {0, 0.2});
  const std::size_t before = cut(rhombs).blocks.size();
  rhombs.quality = limits(0.0, 0.0, 3.0);
  const PolygonSet after = cut(rhombs);
  EXPECT_GT(after.report.sharp_corners, 0);
  EXPECT_GT(after.blocks.size(), before / 2);
}

TEST(Slivers, ReportLeavesThemAndErrorRefusesThem) {
  Model model = square();
  add_trace(model, {{-1, 5}, {11, 5}});
  add_trace(model, {{-1, 5.03}, {11, 5.03}});
  model.quality = limits(0.0, 0.05);
  model.quality.action = QualityAction::report;
  const PolygonSet set = cut(model);
  EXPECT_EQ(set.blocks.size(), 3U);
  EXPECT_EQ(set.report.slivers, 1);
  EXPECT_EQ(set.report.short_edges, 2);
  model.quality.action = QualityAction::error;
  const auto result = build_polygons(model);
  ASSERT_FALSE(result.ok());
  EXPECT_NE(reason(result).find("quality.min_area: 1 block is smaller"), std::string::npos)
      << reason(result);
}

TEST(Slivers, HeldBlocksNeitherGoNorGrow) {
  Model model = strip();
  model.quality = limits(0.0, 0.05);
  const auto hold = [&](Vec2 point) {
    model.fixed.push_back(
        {point, {"fixed." + std::to_string(model.fixed.size()), "test.toml", 1, 1}});
  };
  hold({5, 5.015});
  EXPECT_EQ(cut(model).blocks.size(), 5U);
  EXPECT_TRUE(cut(model).report.kept.empty());  // it does not move anyway
  model.fixed.clear();
  hold({1, 8});
  PolygonSet set = cut(model);
  ASSERT_EQ(set.blocks.size(), 4U);
  EXPECT_NEAR(area_round(set, {1, 8}), 15.0, 1e-9);
  EXPECT_NEAR(area_round(set, {9, 8}), 15.12, 1e-9);
  hold({9, 8});
  EXPECT_NEAR(area_round(cut(model), {5, 8}), 20.0, 1e-9);
  hold({5, 8});
  EXPECT_EQ(cut(model).blocks.size(), 5U);
}

TEST(Slivers, JoinOnlyTheirOwnRegion) {
  Model model = strip();
  Region region;
  region.polygon = box(3, 5, 7, 11);
  region.material = 1;
  region.where = {"region.0", "test.toml", 1, 1};
  model.regions.push_back(region);
  model.quality = limits(0.0, 0.05);
  PolygonSet set = cut(model);
  ASSERT_EQ(set.blocks.size(), 4U);
  EXPECT_NEAR(area_round(set, {5, 8}), 20.0, 1e-9);
  model.regions[0].polygon = box(3, 5.0, 7, 5.03);  // a thin layer of its own stays
  set = cut(model);
  EXPECT_EQ(set.blocks.size(), 5U);
  EXPECT_EQ(set.report.slivers, 1);
}

/// What the default of a model file asks for (2 % of the spacing) leaves a common jointing alone.
TEST(Slivers, CommonJointingIsLeftAlone) {
  Model model = domain_model(box(0, 0, 50, 40), 5e-8);
  add_set(model, 65.0, 2.0, {3.5, 0.1});
  add_set(model, -15.0, 2.5, {0.3, 0.5});
  const PolygonSet before = cut(model);
  model.quality = limits(4 * 0.04 * 0.04, 0.04);
  const PolygonSet after = cut(model);
  EXPECT_LE(after.report.quality_merged, 2);
  EXPECT_GE(after.blocks.size() + 2, before.blocks.size());
}

}  // namespace
}  // namespace edda::slivers_test
