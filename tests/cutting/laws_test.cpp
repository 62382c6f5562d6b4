// Which law an edge gets where lines coincide, and where vertices on straight sides go.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "cutting/checks.hpp"
#include "cutting/line_models.hpp"
#include "cutting/straight_runs.hpp"
#include "model/read_model.hpp"

namespace edda::laws_test {
namespace {

using namespace test;

constexpr double snap = 1e-8;

Model square() {
  return domain_model(box(0, 0, 10, 10), snap);
}

std::map<Index, double> lengths(const Model& model) {
  const auto result = build_polygons(model);
  expect_sound(result, snap);
  return result.ok() ? length_by_law(result.value().blocks) : std::map<Index, double>{};
}

void expect_lengths(const Model& model, const std::map<Index, double>& expected) {
  for (double angle : {0.0, 12.3, 45.0, 100.0}) {
    SCOPED_TRACE(angle);
    const auto found = lengths(turned(model, angle));
    EXPECT_EQ(found.size(), expected.size());
    for (const auto& [law, length] : expected) {
      ASSERT_TRUE(found.contains(law)) << law;
      EXPECT_NEAR(found.at(law), length, 1e-6) << law;
    }
  }
}

TEST(Laws, FirstTraceWinsWhereTwoOverlap) {
  Model model = square();
  add_trace(model, {{-1, 3}, {6, 3}}, 5);
  add_trace(model, {{4, 3}, {11, 3}}, 2);
  expect_lengths(model, {{none, 40.0}, {5, 12.0}, {2, 8.0}});
  std::swap(model.traces[0], model.traces[1]);
  expect_lengths(model, {{none, 40.0}, {5, 8.0}, {2, 12.0}});
}

TEST(Laws, TraceBeforeSetBeforeOpeningBeforeOutline) {
  Model model = square();
  add_set(model, 0.0, 5.0, {0, 5}, 1);
  add_trace(model, {{0, 5}, {3, 5}}, 2);
  add_opening(model, {{4, 5}, {6, 5}, {6, 7}, {4, 7}}, 3);
  // The set covers y = 0, 5, 10, at y = 5 from 3 on both sides but for the opening's floor.
  expect_lengths(model, {{none, 20.0}, {1, 20.0 + 2.0 * 7.0 - 2.0}, {2, 6.0}, {3, 6.0}});
}

TEST(Laws, FirstSetWinsWhereTwoCoincide) {
  Model model = square();
  add_set(model, 0.0, 5.0, {0, 5}, 7);
  add_set(model, 180.0, 2.5, {0, 2.5}, 6);
  expect_lengths(model, {{none, 20.0}, {7, 20.0 + 20.0}, {6, 40.0}});
}

TEST(Laws, FirstTraceWinsOverASliverToo) {
  // Farther apart than snap, nearer than twice: a sliver is cut and merged, whichever side is
  // longer.
  for (double side : {1.6, -1.6}) {
    for (bool first : {true, false}) {
      Model model = square();
      add_trace(model, {{-1, 3}, {11, 3}}, first ? 5 : 2);
      add_trace(model, {{-1, 3 + side * snap}, {11, 3 + side * snap}}, first ? 2 : 5);
      add_trace(model, {{6, -1}, {6, 3}}, 7);
      expect_lengths(model, {{none, 40.0}, {first ? 5 : 2, 20.0}, {7, 6.0}});
    }
  }
}

TEST(Laws, DomainJointStandsInForTracesAndSetsOnly) {
  Model model = square();
  model.domain->joint = 9;
  add_trace(model, {{-1, 3}, {11, 3}});
  add_set(model, 90.0, 20.0, {5, 0});
  add_set(model, 90.0, 20.0, {6, 0}, 1);
  add_opening(model, box(7, 7, 8, 8));
  expect_lengths(model, {{none, 40.0 + 4.0}, {9, 40.0}, {1, 20.0}});
}

TEST(Laws, VerticesOnStraightSidesGoButLawChangesStay) {
  Model model = square();
  add_trace(model, {{0, 5}, {10, 5}}, 1);
  for (int i = 1; i < 10; ++i) {
    const double x = i;
    add_trace(model, {{x, 5}, {x, 11}}, 2);  // T junctions from above
  }
  const auto result = build_polygons(model);
  expect_sound(result, snap);
  ASSERT_EQ(result.value().blocks.size(), 11u);
  EXPECT_EQ(result.value().blocks[0].rings[0].size(), 4u);  // below: the junctions are gone
  model.traces[0].points = {{0, 5}, {5.5, 5}};
  add_trace(model, {{5.5, 5}, {10, 5}}, 3);
  const auto two_laws = build_polygons(model);
  expect_sound(two_laws, snap);
  ASSERT_EQ(two_laws.value().blocks.size(), 11u);
  EXPECT_EQ(two_laws.value().blocks[0].rings[0].size(), 5u);  // the law changes at x = 5.5
}

TEST(Laws, OutlineWithVerticesOnItsSidesIsFourCorners) {
  Model model =
      domain_model({{0, 0}, {2, 0}, {5, 0}, {10, 0}, {10, 10}, {5, 10}, {0, 10}, {0, 4}}, snap);
  for (double angle : {0.0, 20.0, 45.0, 213.0}) {
    const auto result = build_polygons(turned(model, angle));
    expect_sound(result, snap);
    EXPECT_EQ(result.value().blocks[0].rings[0].size(), 4u) << angle;
  }
}

TEST(StraightRuns, KeepCurvesWithinTheTolerance) {
  // A circle of many short edges: each vertex is near its neighbours' chord, yet they must not all
  // go.
  for (double tolerance : {1e-2, 1e-3, 1e-4}) {
    Ring circle;
    const int n = 20000;
    for (int i = 0; i < n; ++i)
      circle.push_back(rotated({1.0, 0.0}, 2.0 * std::numbers::pi * i / n));
    std::vector<Index> law(circle.size(), 1);
    const Ring before = circle;
    remove_straight_runs(circle, law, tolerance);
    EXPECT_EQ(circle.size(), law.size());
    EXPECT_LT(circle.size(), 3.0 * std::numbers::pi / std::sqrt(2.0 * tolerance) + 8.0);
    for (Vec2 p : before) EXPECT_LE(1.0 - tolerance, norm(p));
    for (std::size_t i = 0; i < circle.size(); ++i) {
      const Vec2 middle = 0.5 * (circle[i] + circle[(i + 1) % circle.size()]);
      EXPECT_GE(norm(middle), 1.0 - 1.001 * tolerance);
    }
  }
}

/// An edge knows the table from which its line comes, and lies along it.
TEST(Tables, AreThoseOfTheLinesOfEdges) {
  const auto model = read_model_text(R"(
[materials.rock]
density = 2600.0
young = 1e9
poisson = 0.2
[joints.rough]
friction_angle = 30.0
[contact]
joint = "rough"
[domain]
outline = [[0, 0], [10, 0], [10, 10], [0, 10]]
[[joint_set]]
name = "flat"
angle = 20.0
spacing = 2.3
[[joint_set]]
name = "steep"
angle = 75.0
spacing = 1.9
[[trace]]
points = [[-1, 9], [4, 5.5], [11, 5]]
[solver]
duration = 1.0
)",
                                     "m.toml", {});
  ASSERT_TRUE(model.ok());
  const auto set = build_polygons(model.value());
  ASSERT_TRUE(set.ok());
  std::map<std::string, double> length;
  for (const BlockPolygon& block : set.value().blocks) {
    ASSERT_EQ(block.table.size(), block.rings.size());
    for (std::size_t e = 0; e < block.rings[0].size(); ++e) {
      const Ring& ring = block.rings[0];
      const Vec2 along = ring[(e + 1) % ring.size()] - ring[e];
      const Vec2 middle = ring[e] + 0.5 * along + set.value().origin;
      const Index row = block.table[0][e];
      const std::string table =
          row == none ? "" : set.value().tables[static_cast<std::size_t>(row)];
      length[table] += norm(along);
      const double degrees = std::atan2(along.y, along.x) * 180.0 / std::numbers::pi;
      const auto runs_at = [&](double angle) {
        return std::abs(std::remainder(degrees - angle, 180.0)) < 1e-4;
      };
      const bool outer = std::min({middle.x, middle.y, 10.0 - middle.x, 10.0 - middle.y}) < 1e-6;
      const double first = std::atan2(-3.5, 5.0), second = std::atan2(-0.5, 7.0);
      const double per_radian = 180.0 / std::numbers::pi;
      const bool fits = table == "joint_set.flat"    ? runs_at(20.0)
                        : table == "joint_set.steep" ? runs_at(75.0)
                        : table == "trace.0"
                            ? runs_at(first * per_radian) || runs_at(second * per_radian)
                            : outer;
      EXPECT_TRUE(fits) << table << " at " << middle.x << ' ' << middle.y << ", " << degrees;
    }
  }
  EXPECT_EQ(length.size(), 4u);
  for (const char* table : {"joint_set.flat", "joint_set.steep", "trace.0"})
    EXPECT_GT(length[table], 10.0) << table;
}

TEST(StraightRuns, KeepSpikesAndCorners) {
  Ring ring = {{0, 0}, {10, 0}, {10, 10}, {5, 10}, {5, 11}, {5 - 1e-3, 10}, {0, 10}};
  std::vector<Index> law(ring.size(), 1);
  const Ring before = ring;
  remove_straight_runs(ring, law, 1e-6);
  EXPECT_EQ(ring, before);
}

TEST(StraightRuns, WorkFromAnyStartingVertex) {
  const Ring whole = {{0, 0}, {1, 0}, {2, 1e-9}, {4, 0}, {4, 1},
                      {4, 3}, {2, 3}, {1, 3},    {0, 3}, {-1e-9, 2}};
  for (std::size_t first = 0; first < whole.size(); ++first) {
    Ring ring = whole;
    std::rotate(ring.begin(), ring.begin() + static_cast<std::ptrdiff_t>(first), ring.end());
    std::vector<Index> law(ring.size(), 0), table;
    for (const Vec2 from : ring)
      table.push_back(static_cast<Index>(std::lround(10.0 * from.x + from.y)));
    remove_straight_runs(ring, law, 1e-7, &table);
    EXPECT_EQ(ring.size(), 4u) << first;
    // Of the longest part of each side.
    std::sort(table.begin(), table.end());
    EXPECT_EQ(table, (std::vector<Index>{2, 20, 41, 43})) << first;
    EXPECT_NEAR(signed_area(ring), 12.0, 1e-12);
  }
}

}  // namespace
}  // namespace edda::laws_test
