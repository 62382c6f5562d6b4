// Lines in general position: the number of blocks is known, 1 + lines + crossings inside.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "cutting/checks.hpp"
#include "cutting/line_models.hpp"

namespace edda::random_lines_test {
namespace {

using namespace test;

/// Crossings strictly inside the box, by brute force.
int crossings_inside(const Model& model) {
  const Vec2 high = model.domain->outline[2];
  int count = 0;
  for (std::size_t i = 0; i < model.traces.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      const Vec2 p = model.traces[i].points[0], d = model.traces[i].points[1] - p;
      const Vec2 q = model.traces[j].points[0], e = model.traces[j].points[1] - q;
      const Vec2 meet = p + (cross(q - p, e) / cross(d, e)) * d;
      count += meet.x > 0 && meet.x < high.x && meet.y > 0 && meet.y < high.y;
    }
  }
  return count;
}

int expected_blocks(const Model& model) {
  return 1 + static_cast<int>(model.traces.size()) + crossings_inside(model);
}

void expect_count(const Model& model, int expected) {
  const auto result = build_polygons(model);
  expect_sound(result, model.domain->snap);
  ASSERT_TRUE(result.ok());
  EXPECT_EQ(static_cast<int>(result.value().blocks.size()), expected);
  EXPECT_EQ(result.value().report.dangling, 0);
  EXPECT_EQ(result.value().report.merged, 0);
}

TEST(RandomLines, GiveOneBlockPerLineAndCrossing) {
  for (int n : {0, 1, 2, 3, 5, 10, 30, 100, 300, 1000}) {
    SCOPED_TRACE(n);
    const Model model = random_lines(n, 17u + static_cast<unsigned>(n));
    expect_count(model, expected_blocks(model));
  }
}

TEST(RandomLines, AreTheSameTurned) {
  const Model model = random_lines(40, 5);
  const int expected = expected_blocks(model);
  for (int i = 0; i < 200; ++i) expect_count(turned(model, 1.8 * i + 0.123), expected);
}

TEST(RandomLines, AreTheSameFarAway) {
  const Model model = random_lines(60, 6);
  const int expected = expected_blocks(model);
  for (Vec2 by : {Vec2{1e6, 0}, Vec2{-1e6, 1e6}, Vec2{4.2e5, -7.7e6}}) {
    expect_count(shifted(model, by), expected);
  }
}

TEST(RandomLines, AreTheSameScaled) {
  const Model model = random_lines(60, 7);
  const int expected = expected_blocks(model);
  for (double by : {1e-3, 1e-1, 1e3, 1e5}) expect_count(scaled(model, by), expected);
}

TEST(RandomLines, AreTheSameInAnyOrder) {
  Model model = random_lines(60, 8);
  const auto reference = build_polygons(model);
  ASSERT_TRUE(reference.ok());
  std::mt19937 random(3);
  for (int i = 0; i < 20; ++i) {
    std::shuffle(model.traces.begin(), model.traces.end(), random);
    for (Trace& t : model.traces) {
      if (random() % 2) std::reverse(t.points.begin(), t.points.end());
    }
    const auto result = build_polygons(model);
    expect_sound(result, model.domain->snap);
    ASSERT_EQ(result.value().blocks.size(), reference.value().blocks.size());
    for (std::size_t b = 0; b < result.value().blocks.size(); ++b) {
      const Moments m = moments(result.value().blocks[b].rings);
      const Moments r = moments(reference.value().blocks[b].rings);
      ASSERT_NEAR(m.area, r.area, 1e-12);
      ASSERT_NEAR(norm(m.centroid - r.centroid), 0.0, 1e-9);
    }
  }
}

TEST(RandomLines, GiveEveryEdgeItsJoint) {
  const Model model = random_lines(80, 9);
  const auto result = build_polygons(model);
  expect_sound(result, model.domain->snap);
  const PolygonSet& set = result.value();
  for (const BlockPolygon& block : set.blocks) {
    for (std::size_t i = 0; i < block.rings[0].size(); ++i) {
      const Vec2 a = block.rings[0][i] + set.origin;
      const Vec2 b = block.rings[0][(i + 1) % block.rings[0].size()] + set.origin;
      int lines_under = 0;
      for (int t = 0; t < 80; ++t) {
        const auto& points = model.traces[static_cast<std::size_t>(t)].points;
        const double off = std::max(distance_to_line(a, points[0], points[1]),
                                    distance_to_line(b, points[0], points[1]));
        if (off > 1e-11) continue;
        ++lines_under;
        EXPECT_EQ(block.joint[0][i], t);
      }
      const bool on_outline =
          (a.x == b.x && (a.x == 0 || a.x == 10)) || (a.y == b.y && (a.y == 0 || a.y == 7));
      EXPECT_EQ(lines_under, on_outline ? 0 : 1);
      if (on_outline) {
        EXPECT_EQ(block.joint[0][i], none);
      }
    }
  }
  // Both sides of the whole of each line are there.
  const auto length = length_by_law(set.blocks);
  EXPECT_NEAR(length.at(none), 34.0, 1e-9);
  for (int t = 0; t < 80; ++t) {
    const auto& points = model.traces[static_cast<std::size_t>(t)].points;
    double low = 0.0, high = 1.0;
    for (int axis = 0; axis < 2; ++axis) {
      const double p = axis ? points[0].y : points[0].x, q = axis ? points[1].y : points[1].x;
      const double end = axis ? 7.0 : 10.0;
      const double s = (0.0 - p) / (q - p), e = (end - p) / (q - p);
      low = std::max(low, std::min(s, e));
      high = std::min(high, std::max(s, e));
    }
    EXPECT_NEAR(length.at(t), 2.0 * (high - low) * norm(points[1] - points[0]), 1e-8) << t;
  }
}

}  // namespace
}  // namespace edda::random_lines_test
