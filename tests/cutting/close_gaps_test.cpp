#include "cutting/close_gaps.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "base/rings.hpp"
#include "cutting/checks.hpp"
#include "cutting/line_models.hpp"

namespace edda::close_gaps_test {
namespace {

using namespace test;

Model blocks_of(const std::vector<Ring>& rings, double width) {
  Model model;
  for (const Ring& ring : rings) add_block(model, ring);
  model.contact.close_gaps = width;
  return model;
}

double area_of(const PolygonSet& set) {
  return total_area(set.blocks);
}

/// A wall of courses in running bond whose bricks are drawn a mortar joint apart.
std::vector<Ring> bricks(double length, double height, double mortar, int columns, int rows) {
  std::vector<Ring> rings;
  for (int row = 0; row < rows; ++row) {
    for (int i = 0; i < columns; ++i) {
      const double x = (i + 0.5 * (row % 2)) * (length + mortar), y = row * (height + mortar);
      rings.push_back(box(x, y, x + length, y + height));
    }
  }
  return rings;
}

TEST(CloseGaps, BricksMeetInTheMiddleOfTheirMortar) {
  const double mortar = 0.01;
  const PolygonSet set = build_polygons(blocks_of(bricks(0.24, 0.06, mortar, 6, 4), 0.015)).value();
  const BlockPolygon& inner = set.blocks[8];  // with bricks on all sides
  EXPECT_NEAR(moments(inner.rings).area, 0.25 * 0.07, 1e-12);
  const auto gap = [&](std::size_t i, std::size_t j) {
    double least = 1e9;
    for (const Vec2 p : set.blocks[i].rings[0]) {
      const Ring& ring = set.blocks[j].rings[0];
      for (std::size_t k = 0; k < ring.size(); ++k) {
        least = std::min(least, distance_to_segment(p, ring[k], ring[(k + 1) % ring.size()]));
      }
    }
    return least;
  };
  EXPECT_LT(gap(7, 8), 1e-12);
  EXPECT_LT(gap(8, 2), 1e-12);
  EXPECT_LT(gap(8, 3), 1e-12);
  ASSERT_EQ(set.report.notes.size(), 1U);
  EXPECT_NE(set.report.notes[0].find("of 24 blocks moved by up to 0.005 m"), std::string::npos);
}

TEST(CloseGaps, WhatIsWiderStaysOpen) {
  const auto rings = bricks(0.24, 0.06, 0.01, 3, 2);
  const PolygonSet open = build_polygons(blocks_of(rings, 0.0)).value();
  const PolygonSet narrow = build_polygons(blocks_of(rings, 0.009)).value();
  EXPECT_EQ(area_of(open), area_of(narrow));
  EXPECT_TRUE(narrow.report.notes.empty());
  const PolygonSet exact = build_polygons(blocks_of(rings, 0.01)).value();
  EXPECT_GT(area_of(exact), area_of(open));
}

/// Voussoirs with wedges of mortar between them: both move to the line half way.
TEST(CloseGaps, WedgesOfMortar) {
  std::vector<Ring> rings;
  const int count = 9;
  for (int i = 0; i < count; ++i) {
    const double from = 180.0 * i / count + 0.1, to = 180.0 * (i + 1) / count - 0.1;
    const Vec2 a = direction_of(from), b = direction_of(to);
    rings.push_back({4.0 * a, 5.0 * a, 5.0 * b, 4.0 * b});
  }
  const PolygonSet set = build_polygons(blocks_of(rings, 0.03)).value();
  for (int i = 0; i + 1 < count; ++i) {
    // Corners 2 and 3 of one are 1 and 0 of the next.
    const Ring& one = set.blocks[static_cast<std::size_t>(i)].rings[0];
    const Ring& next = set.blocks[static_cast<std::size_t>(i) + 1].rings[0];
    EXPECT_NEAR(norm(one[3] - next[0]), 0.0, 1e-4);
    EXPECT_NEAR(norm(one[2] - next[1]), 0.0, 1e-4);
    const Vec2 middle = direction_of(180.0 * (i + 1) / count);
    EXPECT_NEAR(std::abs(cross(one[3] + set.origin, middle)), 0.0, 1e-4);
  }
}

/// Turned and moved the gaps close by the same amounts.
TEST(CloseGaps, AnyWayRound) {
  const Model straight = blocks_of(bricks(0.5, 0.2, 0.01, 4, 3), 0.02);
  const double area = area_of(build_polygons(straight).value());
  for (const double angle : {17.0, 90.0, 211.0}) {
    EXPECT_NEAR(area_of(build_polygons(turned(straight, angle)).value()), area, 1e-9);
  }
}

}  // namespace
}  // namespace edda::close_gaps_test
