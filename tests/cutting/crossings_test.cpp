// Crossings counted, and estimated where there are many; blocks with too many corners.
#include "cutting/crossings.hpp"

#include <gtest/gtest.h>

#include "cutting/line_models.hpp"

namespace edda::crossings_test {
namespace {

using namespace test;

/// n lines across n lines, all through the unit square.
std::vector<LineString> lattice(int n) {
  std::vector<LineString> lines;
  for (int i = 1; i <= n; ++i) {
    const double at = i / (n + 1.0);
    lines.push_back({{{0, at}, {1, at}}, 0});
    lines.push_back({{{at, 0}, {at, 1}}, 0});
  }
  return lines;
}

TEST(Crossings, FewSegmentsAreCounted) {
  EXPECT_EQ(estimated_crossings({}), 0.0);
  EXPECT_EQ(estimated_crossings(lattice(1)), 1.0);
  EXPECT_EQ(estimated_crossings(lattice(30)), 900.0);
}

TEST(Crossings, ManySegmentsAreEstimated) {
  EXPECT_NEAR(estimated_crossings(lattice(5000)), 25e6, 0.25e6);
}

TEST(Crossings, TooManyAreAFaultAndFewAreNot) {
  Model model = domain_model(box(0, 0, 1, 1), 1e-9);
  for (const LineString& line : lattice(60)) add_trace(model, line.points);
  model.domain->max_blocks = 3721;
  EXPECT_TRUE(build_polygons(model).ok());
  model.domain->max_blocks = 800;
  const auto result = build_polygons(model);
  ASSERT_FALSE(result.ok());
  EXPECT_EQ(result.faults()[0].problem,
            "the lines cross about 3600 times, too often for 800 blocks");
}

}  // namespace
}  // namespace edda::crossings_test
