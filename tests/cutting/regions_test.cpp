// [[region]]: another material inside a polygon; and [[arch]].
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numbers>

#include "cutting/checks.hpp"
#include "cutting/given_blocks.hpp"
#include "cutting/line_models.hpp"

namespace edda::regions_test {
namespace {

using namespace test;

constexpr double snap = 1e-8;

void add_region(Model& model, Ring polygon, Index material, Index joint = 5) {
  Region region;
  region.polygon = std::move(polygon);
  region.material = material;
  region.joint = joint;
  region.where = {"region." + std::to_string(model.regions.size()), "test.toml", 9, 1};
  model.regions.push_back(region);
}

std::map<Index, double> area_by_material(const PolygonSet& set) {
  std::map<Index, double> area;
  for (const BlockPolygon& block : set.blocks) area[block.material] += moments(block.rings).area;
  return area;
}

PolygonSet cut(const Model& model) {
  const auto result = build_polygons(model);
  expect_sound(result, snap);
  return result.ok() ? result.value() : PolygonSet{};
}

TEST(Regions, CutBlocksAlongTheirOutline) {
  Model model = domain_model(box(0, 0, 10, 10), snap);
  add_region(model, box(2, 2, 6, 7), 1);
  PolygonSet set = cut(model);
  EXPECT_EQ(set.blocks.size(), 2U);
  EXPECT_NEAR(area_by_material(set)[1], 20.0, 1e-9);
  EXPECT_NEAR(length_by_law(set.blocks)[5], 2.0 * 18.0, 1e-9);
  add_set(model, 90.0, 1.0, {0.5, 0}, 3);
  set = cut(model);
  EXPECT_NEAR(area_by_material(set)[1], 20.0, 1e-9);
  EXPECT_NEAR(area_by_material(set)[0], 80.0, 1e-9);
}

TEST(Regions, LaterOnesLieOnEarlierOnes) {
  Model model = domain_model(box(0, 0, 10, 10), snap);
  add_region(model, box(1, 1, 6, 6), 1);
  add_region(model, box(4, 4, 9, 9), 2);
  add_region(model, box(2, 2, 3, 3), 0);
  const PolygonSet set = cut(model);
  EXPECT_NEAR(area_by_material(set)[1], 25.0 - 4.0 - 1.0, 1e-9);
  EXPECT_NEAR(area_by_material(set)[2], 25.0, 1e-9);
}

TEST(Regions, MayReachOutsideAndRoundOpenings) {
  Model model = domain_model(box(0, 0, 10, 10), snap);
  add_region(model, box(-5, 4, 15, 20), 1);
  add_opening(model, box(3, 3, 5, 6));
  const PolygonSet set = cut(model);
  EXPECT_NEAR(area_by_material(set)[1], 60.0 - 4.0, 1e-9);
  EXPECT_NEAR(area_by_material(set)[0], 40.0 - 2.0, 1e-9);
  for (const BlockPolygon& gone : set.removed) {
    EXPECT_NEAR(moments(gone.rings).area, gone.material == 1 ? 4.0 : 2.0, 1e-9);
  }
}

TEST(Regions, JointsOnTheirOutlineComeFirst) {
  Model model = domain_model(box(0, 0, 10, 10), snap);
  add_region(model, box(2, 2, 6, 7), 1);
  add_trace(model, {{2, 2}, {6, 2}}, 3);
  auto length = length_by_law(cut(model).blocks);
  EXPECT_NEAR(length[3], 2.0 * 4.0, 1e-9);
  EXPECT_NEAR(length[5], 2.0 * 14.0, 1e-9);
}

/// A joint as near to the outline of a region as snapping allows: the face between them goes, and
/// the region stays where it is.
TEST(Regions, SurviveSliversOnTheirOutline) {
  Model model = domain_model(box(0, 0, 10, 10), snap);
  add_region(model, box(-1, 5, 11, 11), 1);
  for (const double by : {1.6 * snap, -1.6 * snap}) {
    Model near = model;
    add_trace(near, {{-1, 5 + by}, {11, 5 + by}});
    const PolygonSet set = cut(near);
    ASSERT_EQ(set.blocks.size(), 2U);
    EXPECT_EQ(set.report.merged, 1);
    EXPECT_EQ(set.blocks[0].material, 0);
    EXPECT_EQ(set.blocks[1].material, 1);
  }
}

TEST(Regions, OutsideTheDomainAreAFault) {
  Model model = domain_model(box(0, 0, 10, 10), snap);
  add_region(model, box(20, 20, 30, 30), 1);
  const auto result = build_polygons(model);
  ASSERT_FALSE(result.ok());
  EXPECT_NE(reason(result).find("region.0.polygon: lies wholly outside"), std::string::npos);
}

Arch half_circle(int count) {
  Arch arch;
  arch.centre = {1.0, 2.0};
  arch.radius = 5.0;
  arch.thickness = 0.6;
  arch.count = count;
  arch.material = 0;
  arch.joint = 4;
  return arch;
}

/// n voussoirs with corners at R -+ t/2: each a trapezium of area sin(angle) R t.
TEST(Arches, VoussoirsAreEqualAndTouch) {
  Model model;
  model.arches.push_back(half_circle(16));
  const auto result = build_polygons(model);
  ASSERT_TRUE(result.ok()) << reason(result);
  const auto& blocks = result.value().blocks;
  ASSERT_EQ(blocks.size(), 16U);
  const double area = std::sin(std::numbers::pi / 16.0) * 5.0 * 0.6;
  for (const BlockPolygon& block : blocks) {
    EXPECT_NEAR(signed_area(block.rings[0]), area, 1e-12);
    EXPECT_EQ(block.joint[0], std::vector<Index>(4, 4));
  }
  for (std::size_t i = 0; i + 1 < blocks.size(); ++i) {
    EXPECT_EQ(blocks[i].rings[0][2], blocks[i + 1].rings[0][1]);
    EXPECT_EQ(blocks[i].rings[0][3], blocks[i + 1].rings[0][0]);
  }
  const Vec2 first = blocks[0].rings[0][0] + result.value().origin;
  EXPECT_NEAR(first.x, 1.0 + 4.7, 1e-12);
  EXPECT_NEAR(first.y, 2.0, 1e-12);
}

TEST(Arches, MayCloseARing) {
  Model model;
  model.arches.push_back(half_circle(12));
  model.arches[0].from_angle = -30.0;
  model.arches[0].to_angle = 330.0;
  const auto result = build_polygons(model);
  ASSERT_TRUE(result.ok()) << reason(result);
  const auto& blocks = result.value().blocks;
  EXPECT_EQ(blocks.back().rings[0][2], blocks.front().rings[0][1]);
  EXPECT_EQ(blocks.back().rings[0][3], blocks.front().rings[0][0]);
}

}  // namespace
}  // namespace edda::regions_test
