// [quality]: what is merged, into what, and what stays as it is.
#include <gtest/gtest.h>

#include <cmath>

#include "lines/checks.hpp"
#include "lines/line_models.hpp"

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

TEST(Slivers, ThinStripsJoinTheNeighbourAcrossTheirLongestEdge) {
  Model model = square();
  add_trace(model, {{-1, 5}, {11, 5}});
  add_trace(model, {{-1, 5.03}, {11, 5.03}});
  EXPECT_EQ(cut(model).blocks.size(), 3U);
  model.quality = limits(0.0, 0.05);
  const PolygonSet set = cut(model);
  EXPECT_EQ(set.blocks.size(), 2U);
  EXPECT_EQ(set.report.quality_merged, 1);
  EXPECT_NEAR(set.report.quality_area, 0.3, 1e-9);
  EXPECT_EQ(set.report.slivers, 0);
  EXPECT_EQ(set.report.merged, 0);
}

/// Two lines cross at (5, 5); a third passes 0.05 from there and cuts off a triangle.
TEST(Slivers, SmallTrianglesAtNearCrossingsGo) {
  Model model = square();
  add_trace(model, {{-1, 5}, {11, 5}});
  add_trace(model, {{5, -1}, {5, 11}});
  add_trace(model, {{-1, 11.05}, {11, -0.95}});
  EXPECT_EQ(cut(model).blocks.size(), 7U);
  model.quality = limits(0.01, 0.0);
  const PolygonSet set = cut(model);
  EXPECT_EQ(set.blocks.size(), 6U);
  EXPECT_EQ(set.report.quality_merged, 1);
  // Across its longest edge, that on the third line: the block there now ends in the crossing.
  int in_crossing = 0;
  for (const BlockPolygon& block : set.blocks) {
    for (const Vec2 p : block.rings[0]) in_crossing += norm(p + set.origin - Vec2{5, 5}) < 1e-6;
  }
  EXPECT_EQ(in_crossing, 4);
}

TEST(Slivers, MergedBlocksKeepTheLawsOfTheEdgesThatStay) {
  Model model = square();
  add_trace(model, {{-1, 5}, {11, 5}}, 1);
  add_trace(model, {{-1, 5.03}, {11, 5.03}}, 2);
  add_trace(model, {{5, -1}, {5, 11}}, 3);
  model.quality = limits(0.0, 0.05);
  const PolygonSet set = cut(model);
  EXPECT_EQ(set.blocks.size(), 4U);
  auto length = length_by_law(set.blocks);
  EXPECT_NEAR(length[1] + length[2], 20.0, 0.2);
  EXPECT_NEAR(length[3], 20.0, 1e-6);
}

TEST(Slivers, ManyStripsGrowStepByStep) {
  Model model = square();
  add_set(model, 0.0, 0.1, {0, 0.05});
  EXPECT_EQ(cut(model).blocks.size(), 101U);
  model.quality = limits(0.0, 0.35);
  const PolygonSet set = cut(model);
  EXPECT_EQ(set.report.slivers, 0);
  EXPECT_GT(set.blocks.size(), 12U);  // and not one of them all
  for (const BlockPolygon& block : set.blocks) EXPECT_LT(moments(block.rings).area, 13.0);
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
  add_trace(model, {{-1, 0.0}, {2, 0.0}, {12, 0.3}});  // leaves the bottom at 1.7 degrees
  EXPECT_EQ(cut(model).blocks.size(), 2U);
  model.quality = limits(0.0, 0.0, 3.0);
  EXPECT_EQ(cut(model).blocks.size(), 1U);
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
  Model model = square();
  add_trace(model, {{-1, 5}, {11, 5}});
  add_trace(model, {{-1, 5.03}, {11, 5.03}});
  model.quality = limits(0.0, 0.05);
  model.held.push_back({{5, 5.015}, {"held.0", "test.toml", 1, 1}});
  EXPECT_EQ(cut(model).blocks.size(), 3U);
  model.held[0].point = {5, 2};
  const PolygonSet set = cut(model);
  ASSERT_EQ(set.blocks.size(), 2U);
  EXPECT_TRUE(set.blocks[0].fixed);
  EXPECT_NEAR(moments(set.blocks[0].rings).area, 50.0, 1e-9);
  model.held.push_back({{5, 8}, {"held.1", "test.toml", 1, 1}});
  EXPECT_EQ(cut(model).blocks.size(), 3U);
}

TEST(Slivers, JoinOnlyTheirOwnRegion) {
  Model model = square();
  Region region;
  region.polygon = box(-1, 5.03, 11, 11);
  region.material = 1;
  region.where = {"region.0", "test.toml", 1, 1};
  model.regions.push_back(region);
  add_trace(model, {{-1, 5}, {11, 5}});
  model.quality = limits(0.0, 0.05);
  PolygonSet set = cut(model);
  ASSERT_EQ(set.blocks.size(), 2U);
  EXPECT_NEAR(moments(set.blocks[0].rings).area, 50.3, 1e-9);
  EXPECT_EQ(set.blocks[0].material, 0);
  EXPECT_EQ(set.blocks[1].material, 1);
  model.regions[0].polygon = box(-1, 5.0, 11, 5.03);  // a thin layer of its own stays
  set = cut(model);
  EXPECT_EQ(set.blocks.size(), 3U);
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
