// What must hold for every cut, whatever the line work.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <string>
#include <utility>

#include "cutting/build_polygons.hpp"

namespace edda::test {

inline std::string reason(const Result<PolygonSet>& result) {
  return result.ok() ? "" : to_string(result.faults()[0]);
}

/// Length of edge per law, over all rings of all blocks (an edge between two blocks counts twice).
inline std::map<Index, double> length_by_law(const std::vector<BlockPolygon>& blocks) {
  std::map<Index, double> length;
  for (const BlockPolygon& block : blocks) {
    for (std::size_t r = 0; r < block.rings.size(); ++r) {
      const Ring& ring = block.rings[r];
      for (std::size_t i = 0; i < ring.size(); ++i) {
        length[block.joint[r][i]] += norm(ring[(i + 1) % ring.size()] - ring[i]);
      }
    }
  }
  return length;
}

inline double distance_to_line(Vec2 p, Vec2 a, Vec2 b) {
  return std::abs(cross(p - a, b - a)) / norm(b - a);
}

/// Rings simple and turned the right way, a law for each edge, no vertex on a straight side, order
/// by centroid, area out = area in and equal to the polygons' own.
inline void expect_sound(const PolygonSet& set, double snap, double area_tolerance = 1e-9) {
  double area = 0.0;
  for (const BlockPolygon& block : set.blocks) {
    ASSERT_FALSE(block.rings.empty());
    ASSERT_EQ(block.rings.size(), block.joint.size());
    for (std::size_t r = 0; r < block.rings.size(); ++r) {
      const Ring& ring = block.rings[r];
      const std::size_t n = ring.size();
      ASSERT_GE(n, 3u);
      ASSERT_EQ(n, block.joint[r].size());
      ASSERT_TRUE(r == 0 ? signed_area(ring) > 0.0 : signed_area(ring) < 0.0);
      ASSERT_FALSE(self_crossing(ring));
      std::set<std::pair<double, double>> distinct;
      for (Vec2 p : ring) distinct.insert({p.x, p.y});
      ASSERT_EQ(distinct.size(), n);
      double perimeter = 0.0;
      for (std::size_t i = 0; i < n; ++i) perimeter += norm(ring[(i + 1) % n] - ring[i]);
      const bool thin = 2.0 * std::abs(signed_area(ring)) < 16.0 * snap * perimeter;
      for (std::size_t i = 0; i < n && n > 3 && !thin; ++i) {
        const Vec2 a = ring[i], b = ring[(i + 1) % n], c = ring[(i + 2) % n];
        if (block.joint[r][i] != block.joint[r][(i + 1) % n] || dot(b - a, c - b) <= 0.0) continue;
        if (norm(b - a) < 100.0 * snap || norm(c - b) < 100.0 * snap) continue;
        ASSERT_GE(distance_to_line(b, a, c), 0.99 * 4.0 * snap);
      }
    }
    area += moments(block.rings).area;
  }
  EXPECT_NEAR(area, set.report.area_in, area_tolerance * set.report.area_in);
  EXPECT_NEAR(area, set.report.area_out, 1e-11 * set.report.area_in);
}

inline void expect_sound(const Result<PolygonSet>& result, double snap,
                         double area_tolerance = 1e-9) {
  ASSERT_TRUE(result.ok()) << reason(result);
  expect_sound(result.value(), snap, area_tolerance);
}

}  // namespace edda::test
