// Joints that cut nothing are told, with why.
#include <gtest/gtest.h>

#include "cutting/line_models.hpp"

namespace edda::idle_lines_test {
namespace {

using namespace test;

Model square() {
  return domain_model(box(0, 0, 20, 20), 1e-8);
}

std::vector<std::string> warnings_of(const Model& model) {
  const auto result = build_polygons(model);
  EXPECT_TRUE(result.ok());
  return result.ok() ? result.value().report.warnings : std::vector<std::string>{};
}

void expect_warning(const Model& model, const std::string& begin, const std::string& part) {
  const auto warnings = warnings_of(model);
  ASSERT_EQ(warnings.size(), 1U);
  EXPECT_EQ(warnings[0].substr(0, begin.size()), begin);
  EXPECT_NE(warnings[0].find(part), std::string::npos) << warnings[0];
}

TEST(IdleLines, OfASetWhoseRegionLiesOutside) {
  Model model = square();
  add_set(model, 30.0, 3.0, {0, 0}, none, {{30, 30}, {40, 30}, {40, 40}});
  expect_warning(model, "joint_set.0 cuts nothing: none of its joints crosses the domain",
                 "region");
}

TEST(IdleLines, OfASetThatPassesBy) {
  Model model = square();
  add_set(model, 30.0, 300.0, {-100, 0});
  expect_warning(model, "joint_set.0 cuts nothing", "origin and spacing");
}

TEST(IdleLines, OfTracesOutsideAndTrimmedAway) {
  Model model = square();
  add_trace(model, {{0, 10}, {20, 10}});
  add_trace(model, {{30, 30}, {40, 40}});
  expect_warning(model, "trace.1 cuts nothing", "does not cross");
  model.traces[1].points = {{5, 5}, {8, 8}};
  expect_warning(model, "trace.1 ends inside blocks on both sides", "trimmed away whole");
}

TEST(IdleLines, OfPolygonsLargerThanTheDomain) {
  Model model = square();
  Voronoi voronoi;
  voronoi.size = 2000.0;
  voronoi.where = {"voronoi", "test.toml", 5, 1};
  model.voronoi = voronoi;
  expect_warning(model, "voronoi cuts nothing", "smaller size");
}

TEST(IdleLines, OfATraceInAnOpeningAlone) {
  Model model = square();
  add_opening(model, box(5, 5, 15, 15));
  add_trace(model, {{6, 10}, {14, 10}});
  expect_warning(model, "trace.0 cuts nothing", "rock");
}

TEST(IdleLines, AreNotThoseThatLieOnOthersOrBoundABlockPartly) {
  Model model = square();
  add_trace(model, {{0, 10}, {20, 10}});
  add_trace(model, {{20, 10}, {0, 10}});
  add_trace(model, {{5, 5}, {5, 20}});
  add_set(model, 0.0, 10.0, {0, 0});
  EXPECT_TRUE(warnings_of(model).empty());
}

}  // namespace
}  // namespace edda::idle_lines_test
