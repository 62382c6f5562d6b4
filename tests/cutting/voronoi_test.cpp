// Voronoi polygons: they cover the domain, are as large as asked, convex, and repeat with their
// seed.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "cutting/checks.hpp"
#include "cutting/line_models.hpp"

namespace edda::voronoi_test {
namespace {

using namespace test;

Model voronoi_model(double width, double height, double size, int smoothing, long long seed) {
  Model model = domain_model(box(0, 0, width, height), 1e-9 * width);
  Voronoi v;
  v.size = size;
  v.smoothing = smoothing;
  v.seed = seed;
  v.joint = 2;
  v.where = {"voronoi", "test.toml", 7, 1};
  model.voronoi = v;
  return model;
}

PolygonSet cut(const Model& model) {
  const auto result = build_polygons(model);
  expect_sound(result, model.domain->snap);
  return result.ok() ? result.value() : PolygonSet{};
}

/// Polygons that do not touch the outline.
std::vector<BlockPolygon> inner(const PolygonSet& set, double width, double height) {
  std::vector<BlockPolygon> blocks;
  for (const BlockPolygon& block : set.blocks) {
    bool touches = false;
    for (const Vec2 p : block.rings[0]) {
      touches =
          touches || std::abs(p.x) > 0.5 * width - 1e-6 || std::abs(p.y) > 0.5 * height - 1e-6;
    }
    if (!touches) blocks.push_back(block);
  }
  return blocks;
}

TEST(Voronoi, PolygonsCoverTheDomainAndAreConvex) {
  for (const int smoothing : {0, 5}) {
    const PolygonSet set = cut(voronoi_model(30, 20, 1.5, smoothing, 7));
    EXPECT_EQ(set.report.dangling, 0);
    EXPECT_EQ(set.report.bridging, 0);
    EXPECT_NEAR(set.report.area_out, 600.0, 1e-9 * 600.0);
    for (const BlockPolygon& block : set.blocks) {
      ASSERT_EQ(block.rings.size(), 1U);
      const Ring& ring = block.rings[0];
      for (std::size_t i = 0; i < ring.size(); ++i) {
        const Vec2 a = ring[i], b = ring[(i + 1) % ring.size()], c = ring[(i + 2) % ring.size()];
        EXPECT_GT(cross(b - a, c - b), -1e-6 * norm(b - a) * norm(c - b) - 1e-7);
      }
    }
    EXPECT_GT(length_by_law(set.blocks).at(2), 0.0);
  }
}

/// The mean of those that the outline leaves whole; smoothing makes them alike.
TEST(Voronoi, PolygonsAreAsLargeAsAskedAndSmoothingMakesThemAlike) {
  double deviation[2] = {};
  for (const int smoothing : {0, 5}) {
    const PolygonSet set = cut(voronoi_model(60, 60, 1.5, smoothing, 3));
    const auto blocks = inner(set, 60, 60);
    double sum = 0.0, squares = 0.0;
    const double n = static_cast<double>(blocks.size());
    for (const BlockPolygon& block : blocks) {
      const double area = moments(block.rings).area;
      sum += area;
      squares += area * area;
    }
    EXPECT_GT(n, 1200.0);
    EXPECT_NEAR(sum / n, 2.25, (smoothing > 0 ? 0.03 : 0.07) * 2.25) << smoothing;
    deviation[smoothing > 0] = std::sqrt(squares / n - sum / n * sum / n) / (sum / n);
  }
  EXPECT_NEAR(deviation[0], 0.53, 0.05);  // of the polygons of a Poisson process: 0.529
  EXPECT_LT(deviation[1], 0.6 * deviation[0]);
}

TEST(Voronoi, SeedsRepeat) {
  const auto places = [](long long seed) {
    std::vector<std::pair<double, double>> all;
    for (const BlockPolygon& block : cut(voronoi_model(20, 10, 2.0, 5, seed)).blocks) {
      for (const Vec2 p : block.rings[0]) all.emplace_back(p.x, p.y);
    }
    return all;
  };
  EXPECT_EQ(places(4), places(4));
  EXPECT_NE(places(4), places(5));
}

TEST(Voronoi, FillARegionThatIsCutOut) {
  Model model = voronoi_model(30, 20, 1.5, 3, 7);
  model.voronoi->region = {{5, 5}, {20, 4}, {22, 15}, {12, 9}, {6, 14}};
  const PolygonSet set = cut(model);
  int outer = 0;
  double inside = 0.0;
  for (const BlockPolygon& block : set.blocks) {
    if (block.rings.size() > 1) {
      ++outer;
      continue;
    }
    inside += moments(block.rings).area;
  }
  EXPECT_EQ(outer, 1);
  EXPECT_NEAR(inside, signed_area(model.voronoi->region), 1e-6);
  EXPECT_GT(set.blocks.size(), 30U);
}

TEST(Voronoi, FitsAnOutlineThatIsNotConvexAndOpenings) {
  Model model = voronoi_model(30, 20, 1.0, 5, 1);
  model.domain->outline = {{0, 0}, {30, 0}, {30, 8}, {10, 8}, {10, 20}, {0, 20}};
  add_opening(model, box(2, 2, 6, 6));
  const PolygonSet set = cut(model);
  EXPECT_NEAR(set.report.area_out, 240.0 + 120.0 - 16.0, 1e-6);
}

double shortest_edge(const PolygonSet& set) {
  double least = 1e300;
  for (const BlockPolygon& block : set.blocks) {
    const Ring& ring = block.rings[0];
    for (std::size_t i = 0; i < ring.size(); ++i) {
      least = std::min(least, norm(ring[(i + 1) % ring.size()] - ring[i]));
    }
  }
  return least;
}

/// Length of the edges of blocks without a law: those on the outline.
double length_outside(const PolygonSet& set) {
  return length_by_law(set.blocks)[none];
}

TEST(Voronoi, ShortEdgesBecomePoints) {
  for (const int smoothing : {0, 5}) {
    for (long long seed = 1; seed <= 5; ++seed) {
      Model model = voronoi_model(30, 20, 1.0, smoothing, seed);
      const PolygonSet all = cut(model);
      model.voronoi->min_edge = 0.2;
      const PolygonSet set = cut(model);
      EXPECT_LT(shortest_edge(all), 0.05);
      EXPECT_GE(shortest_edge(set), 0.2 - 1e-9);
      EXPECT_NEAR(length_outside(set), 100.0, 1e-9);
      EXPECT_NEAR(set.report.area_out, 600.0, 1e-9);
      EXPECT_EQ(set.report.dangling + set.report.bridging, 0);
      const auto count = static_cast<double>(all.blocks.size());
      EXPECT_NEAR(static_cast<double>(set.blocks.size()), count, 0.06 * count) << smoothing;
    }
  }
}

/// The corners of outline and region are those given, and what lies between them is straight.
TEST(Voronoi, ShortEdgesLeaveTheBordersAsTheyAre) {
  Model model = voronoi_model(30, 20, 1.5, 3, 7);
  model.domain->outline = {{0, 0}, {30, 0}, {30, 8.1}, {29, 20}, {3, 20}, {0, 13}};
  model.voronoi->region = {{5, 5}, {20, 4}, {33, 15}, {12, 9}, {6, 14}};
  const PolygonSet all = cut(model);
  model.voronoi->min_edge = 0.3;
  const PolygonSet set = cut(model);
  EXPECT_NEAR(length_outside(set), length_outside(all), 1e-9);
  EXPECT_NEAR(set.report.area_out, all.report.area_out, 1e-9);
  for (const Ring* border : {&model.domain->outline, &model.voronoi->region}) {
    for (const Vec2 corner : *border) {
      double nearest = 1e300;
      for (const BlockPolygon& block : set.blocks) {
        for (const Vec2 p : block.rings[0]) {
          nearest = std::min(nearest, norm(p + set.origin - corner));
        }
      }
      if (corner.x > 30.0) continue;  // of the region, outside
      EXPECT_LT(nearest, 1e-7) << corner.x << ' ' << corner.y;
    }
  }
}

TEST(Voronoi, ShortEdgesAreTheSameFarAway) {
  Model model = voronoi_model(30, 20, 1.5, 5, 2);
  model.voronoi->min_edge = 0.3;
  const PolygonSet here = cut(model);
  for (Vec2& p : model.domain->outline) p += Vec2{4096.0, -512.0};
  const PolygonSet there = cut(model);
  ASSERT_EQ(here.blocks.size(), there.blocks.size());
  for (std::size_t i = 0; i < here.blocks.size(); ++i) {
    EXPECT_EQ(here.blocks[i].rings, there.blocks[i].rings);
  }
}

/// Tips of cells that walls cut off join a cell beside them: borders of cells are no joints that
/// run through.
TEST(Voronoi, WallsLeaveNoSlivers) {
  std::size_t merged = 0;
  for (long long seed = 1; seed <= 8; ++seed) {
    Model model = voronoi_model(20, 20, 1.0, 5, seed);
    Ring round;
    for (int k = 0; k < 48; ++k) {
      round.push_back(Vec2{10, 10} + rotated({4.0, 0.0}, 2.0 * std::numbers::pi * k / 48));
    }
    add_opening(model, round);
    model.quality.min_edge = 0.1;
    model.quality.min_area = 0.04;
    const PolygonSet set = cut(model);
    EXPECT_EQ(set.report.slivers, 0) << seed;
    EXPECT_TRUE(set.report.kept.empty()) << seed;
    merged += set.report.merges.size();
  }
  EXPECT_GT(merged, 8U);
}

}  // namespace
}  // namespace edda::voronoi_test
