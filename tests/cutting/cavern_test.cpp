#include <gtest/gtest.h>

#include "cutting/line_models.hpp"

namespace edda::cavern_test {
namespace {

using namespace test;

TEST(Cavern, HasTwoHundredAndTenBlocks) {
  for (int segments : {24, 48, 100}) {
    const auto result = build_polygons(cavern(segments));
    ASSERT_TRUE(result.ok()) << to_string(result.faults()[0]);
    const PolygonSet& set = result.value();
    EXPECT_EQ(set.blocks.size(), 210u) << segments;
    EXPECT_NEAR(set.report.smallest_area, 0.0463, 5e-5);
    EXPECT_EQ(set.report.dangling, 0);
    EXPECT_EQ(set.report.merged, 0);
    EXPECT_NEAR(set.report.area_out, set.report.area_in, 1e-9 * set.report.area_in);
    EXPECT_NEAR(total_area(set.blocks) + total_area(set.removed), 3000.0, 1e-6);
  }
}

TEST(Cavern, TurnsAndShiftsWithTheSameBlocks) {
  for (double angle = 1.0; angle < 360.0; angle += 17.0) {
    const auto result = build_polygons(shifted(turned(cavern(24), angle), {1e4, -2e4}));
    ASSERT_TRUE(result.ok()) << to_string(result.faults()[0]);
    EXPECT_EQ(result.value().blocks.size(), 210u) << angle;
    EXPECT_NEAR(result.value().report.smallest_area, 0.0463, 5e-5);
  }
}

}  // namespace
}  // namespace edda::cavern_test
