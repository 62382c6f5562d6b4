// What cannot be cut or fixed is reported with its place.
#include <gtest/gtest.h>

#include "cutting/checks.hpp"
#include "cutting/line_models.hpp"

namespace edda::faults_test {
namespace {

using namespace test;

Model square() {
  return domain_model(box(0, 0, 10, 10), 1e-8);
}

void hold(Model& model, Vec2 p) {
  FixedPoint fixed;
  fixed.point = p;
  fixed.where = {"fixed." + std::to_string(model.fixed.size()), "test.toml", 20, 1};
  model.fixed.push_back(fixed);
}

void expect_fault(const Model& model, const std::string& key, const std::string& problem) {
  const auto result = build_polygons(model);
  ASSERT_FALSE(result.ok());
  EXPECT_EQ(result.faults()[0].where.key, key);
  EXPECT_NE(result.faults()[0].problem.find(problem), std::string::npos)
      << result.faults()[0].problem;
  EXPECT_FALSE(result.faults()[0].remedy.empty());
  EXPECT_GT(result.faults()[0].where.line, 0);
}

TEST(Faults, OpeningOutsideTheOutline) {
  Model model = square();
  add_opening(model, box(2, 2, 3, 3));
  add_opening(model, box(20, 2, 23, 3));
  expect_fault(model, "opening.1.polygon", "lies wholly outside domain.outline");
  model.openings[1].polygon = box(10, 2, 12, 3);  // shares a side only
  expect_fault(model, "opening.1.polygon", "lies wholly outside domain.outline");
}

TEST(Faults, DomainWhollyTakenOut) {
  Model model = square();
  add_opening(model, box(-1, -1, 11, 11));
  expect_fault(model, "domain.outline", "is wholly excavated");
}

TEST(Faults, TooManyBlocks) {
  Model model = square();
  add_set(model, 0.0, 1.0, {0, 0.5});
  add_set(model, 90.0, 1.0, {0.5, 0.0});
  model.domain->max_blocks = 121;
  EXPECT_TRUE(build_polygons(model).ok());
  model.domain->max_blocks = 120;
  expect_fault(model, "domain.max_blocks", "121 blocks");
}

TEST(Faults, TooManyLinesStopBeforeTheCut) {
  Model model = square();
  add_set(model, 10.0, 1e-12, {0, 0.5});
  expect_fault(model, "joint_set.0.spacing", "more lines than");
}

TEST(Faults, OutlineCrossingItself) {
  expect_fault(domain_model({{0, 0}, {1, 1}, {1, 0}, {0, 1}}, 1e-8), "domain.outline",
               "crosses or touches itself");
  Model model = square();
  add_opening(model, {{2, 2}, {3, 3}, {3, 2}, {2, 3.5}});
  expect_fault(model, "opening.0.polygon", "crosses or touches itself");
}

TEST(PointInBlocks, PointsFixTheBlockThatHoldsThem) {
  Model model = square();
  add_set(model, 0.0, 1.0, {0, 0});
  hold(model, {3, 4.5});
  hold(model, {0, 7.5});  // on the outline: one block only
  for (double angle : {0.0, 31.0, 170.0}) {
    const auto result = build_polygons(turned(model, angle));
    ASSERT_TRUE(result.ok()) << reason(result);
    int fixed = 0;
    for (const BlockPolygon& b : result.value().blocks) fixed += b.fixed;
    EXPECT_EQ(fixed, 2);
  }
  const auto result = build_polygons(model);
  EXPECT_TRUE(result.value().blocks[4].fixed);
  EXPECT_TRUE(result.value().blocks[7].fixed);
}

TEST(PointInBlocks, PointsOnSharedEdgesAreRefused) {
  Model model = square();
  add_set(model, 0.0, 1.0, {0, 0});
  hold(model, {3, 4.5});
  hold(model, {3, 4});
  expect_fault(model, "fixed.1.point", "shared by blocks 3 and 4");
}

TEST(PointInBlocks, PointsInNoBlockAreRefused) {
  Model model = square();
  add_opening(model, box(4, 4, 6, 6));
  model.openings[0].name = "adit";
  hold(model, {5, 5});
  expect_fault(model, "fixed.0.point", "opening \"adit\"");
  model.fixed[0].point = {11, 5};
  expect_fault(model, "fixed.0.point", "in no cut block");
  Model blocks_only;
  add_block(blocks_only, box(0, 0, 1, 1));
  hold(blocks_only, {0.5, 0.5});
  expect_fault(blocks_only, "fixed.0.point", "in no cut block");
}

TEST(PointInBlocks, CountsFromTheCutBlocksOn) {
  Model model = square();
  add_block(model, box(20, 0, 21, 1));
  hold(model, {5, 5});
  const auto result = build_polygons(model);
  ASSERT_TRUE(result.ok()) << reason(result);
  EXPECT_FALSE(result.value().blocks[0].fixed);
  EXPECT_TRUE(result.value().blocks[1].fixed);
  model.fixed[0].point = {20.5, 0.5};
  EXPECT_FALSE(build_polygons(model).ok());
}

}  // namespace
}  // namespace edda::faults_test
