// Regular patterns of joints whose blocks can be counted: bricks, hexagons, joints from bed to bed.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>

#include "cutting/checks.hpp"
#include "cutting/line_models.hpp"

namespace edda::joint_patterns_test {
namespace {

using namespace test;

JointSet traces_of(double angle, double spacing, double length, double gap, double stagger,
                   Vec2 origin = {}) {
  JointSet set;
  set.angle = angle;
  set.spacing = spacing;
  set.trace_length = length;
  set.gap = gap;
  set.stagger = stagger;
  set.origin = origin;
  set.where = {"joint_set.cross", "test.toml", 9, 1};
  return set;
}

PolygonSet cut(const Model& model) {
  const auto result = build_polygons(model);
  expect_sound(result, model.domain->snap);
  return result.ok() ? result.value() : PolygonSet{};
}

/// Traces of 1 m with gaps of 1 m on two joints cut every other column of 1 m into three.
TEST(JointPatterns, TracesBeginAtTheOrigin) {
  Model model = domain_model(box(0, 0, 10, 3), 1e-8);
  add_set(model, 90.0, 1.0, {0, 0});
  JointSet set = traces_of(0.0, 1.0, 1.0, 1.0, 0.0);
  set.stagger.reset();
  model.joint_sets.push_back(set);
  EXPECT_EQ(cut(model).blocks.size(), 20U);
  model.joint_sets.back().origin = {1.0, 0.0};
  EXPECT_EQ(cut(model).blocks.size(), 20U);
  // Shifted by half, each trace ends inside blocks on both sides of a column.
  model.joint_sets.back().origin = {0.5, 0.0};
  EXPECT_EQ(cut(model).blocks.size(), 10U);
}

/// Rows of 0.5 m of bricks of 1 m, every other row half a brick later: 10 and 11 bricks by turns.
TEST(JointPatterns, RunningBond) {
  for (const double turn : {0.0, 33.0}) {
    Model model = domain_model(box(0, 0, 10, 3), 1e-8);
    add_set(model, 0.0, 0.5, {0, 0});
    model.joint_sets.push_back(traces_of(90.0, 0.5, 0.5, 0.5, 0.5));
    const PolygonSet set = cut(turned(model, turn));
    EXPECT_EQ(set.blocks.size(), 3U * 10U + 3U * 11U);
    EXPECT_EQ(set.report.dangling, 0);
  }
}

/// Hexagons of side 1: three sets of traces of 1 m with gaps of 2 m, in the directions 30, 90 and
/// 150 degrees, joints sqrt(3)/2 apart, each 1.5 m later than the one before. They have the area
/// 3 sqrt(3)/2.
TEST(JointPatterns, Hexagons) {
  const double spacing = std::sqrt(3.0) / 2.0;
  Model model = domain_model(box(0.1, 0.2, 40.3, 35.1), 1e-8);
  // About a hexagon round (0, 0), each set begins at a corner of it.
  for (const double angle : {30.0, 90.0, 150.0}) {
    const Vec2 corner = rotated({1.0, 0.0}, (angle - 120.0) * std::numbers::pi / 180.0);
    model.joint_sets.push_back(traces_of(angle, spacing, 1.0, 2.0, 1.5, corner));
  }
  const PolygonSet set = cut(model);
  const double area = 1.5 * std::sqrt(3.0);
  std::size_t whole = 0;
  for (const BlockPolygon& block : set.blocks) {
    const double a = moments(block.rings).area;
    ASSERT_LT(a, area + 1e-6);
    whole += block.rings[0].size() == 6 && std::abs(a - area) < 1e-9;
  }
  EXPECT_GT(static_cast<double>(whole), 0.85 * 40.2 * 34.9 / area);
  EXPECT_TRUE(set.report.warnings.empty());
}

Model layered(double stagger) {
  Model model = domain_model(box(0, 0, 12, 5), 1e-8);
  add_set(model, 0.0, 1.0, {0, 0});
  JointSet cross = traces_of(90.0, 2.0, 1.0, 0.0, stagger);
  cross.trace_length.reset();
  cross.beds = 0;
  model.joint_sets.push_back(cross);
  return model;
}

/// Five layers of 1 m, joints 2 m apart in each.
TEST(JointPatterns, JointsRunFromBedToBed) {
  const PolygonSet aligned = cut(layered(0.0));
  EXPECT_EQ(aligned.blocks.size(), 5U * 6U);
  EXPECT_EQ(aligned.report.dangling, 0);
  // A metre later in each layer: 6 and 7 blocks by turns.
  const PolygonSet staggered = cut(layered(1.0));
  EXPECT_EQ(staggered.blocks.size(), 3U * 6U + 2U * 7U);
  for (const BlockPolygon& block : staggered.blocks) EXPECT_EQ(block.rings[0].size(), 4U);
  const PolygonSet inclined = cut(turned(layered(1.0), 25.0));
  EXPECT_EQ(inclined.blocks.size(), 3U * 6U + 2U * 7U);
}

/// Beds of any thickness and joints at an angle, with deviations: none ends inside a block, and the
/// layers do not have the same joints.
TEST(JointPatterns, JointsBetweenBedsAtRandom) {
  Model model = domain_model(box(0, 0, 30, 20), 1e-8);
  add_set(model, 12.0, 1.0, {0, 0});
  model.joint_sets[0].deviation.spacing = 0.6;
  JointSet cross = traces_of(95.0, 1.5, 1.0, 0.0, 0.0);
  cross.trace_length.reset();
  cross.stagger.reset();
  cross.beds = 0;
  cross.deviation.angle = 8.0;
  cross.deviation.spacing = 0.7;
  model.joint_sets.push_back(cross);
  const PolygonSet set = cut(model);
  EXPECT_EQ(set.report.dangling, 0);
  EXPECT_TRUE(set.report.warnings.empty());
  EXPECT_NEAR(static_cast<double>(set.blocks.size()), 30.0 * 20.0 / 1.5, 120.0);
  model.joint_sets[1].seed = 4;
  EXPECT_NE(cut(model).blocks.size(), 0U);
}

/// Traces as long as the beds are thick end inside blocks.
TEST(JointPatterns, SetsThatLoseMuchOfTheirLengthAreNamed) {
  Model model = domain_model(box(0, 0, 10, 4), 1e-8);
  add_set(model, 0.0, 1.0, {0, 0});
  JointSet cross = traces_of(90.0, 1.0, 1.0, 1.0, 0.0, {0.5, 0.0});
  model.joint_sets.push_back(cross);
  EXPECT_TRUE(cut(model).report.warnings.empty());
  model.joint_sets[1].trace_length = 1.8;
  model.joint_sets[1].gap = 0.2;
  const PolygonSet set = cut(model);
  ASSERT_EQ(set.report.warnings.size(), 1U);
  EXPECT_NE(set.report.warnings[0].find("joint_set.cross: 16 m of its 36 m end inside blocks"),
            std::string::npos)
      << set.report.warnings[0];
}

}  // namespace
}  // namespace edda::joint_patterns_test
