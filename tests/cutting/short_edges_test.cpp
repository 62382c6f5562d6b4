// Short edges of polygons become points: known answers, and what must hold of any tiling.
#include "cutting/short_edges.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <random>
#include <set>
#include <utility>

#include "base/polygon.hpp"

namespace edda::short_edges_test {
namespace {

constexpr double straight = 1e-9;

Ring points_of(const Tiling& t, std::size_t f) {
  Ring ring;
  for (const int v : t.ring[f]) ring.push_back(t.node[static_cast<std::size_t>(v)]);
  return ring;
}

std::size_t count_edges_below(const Tiling& t, double least) {
  std::size_t count = 0;
  for (std::size_t f = 0; f < t.ring.size(); ++f) {
    const Ring ring = points_of(t, f);
    for (std::size_t i = 0; i < ring.size(); ++i) {
      count += norm(ring[(i + 1) % ring.size()] - ring[i]) < least ? 1 : 0;
    }
  }
  return count;
}

/// Four squares of side 1 about the origin, whose two triple points lie `apart`.
Tiling four_squares(double apart) {
  const double h = 0.5 * apart;
  return {{{-1, -1}, {0, -1}, {1, -1}, {-1, 0}, {-h, 0}, {h, 0}, {1, 0}, {-1, 1}, {0, 1}, {1, 1}},
          {{0, 1, 5, 4, 3}, {1, 2, 6, 5}, {3, 4, 8, 7}, {4, 5, 6, 9, 8}}};
}

TEST(ShortEdges, FreeEndsMeetInTheMiddle) {
  Tiling t = four_squares(0.1);
  t.node[4].y = 0.02;
  collapse_short_edges(t, 0.2, straight);
  const Ring square = points_of(t, 0);
  ASSERT_EQ(square.size(), 4u);
  EXPECT_NEAR(norm(square[2] - Vec2{0.0, 0.01}), 0.0, 1e-15);
  EXPECT_EQ(points_of(t, 1)[3], square[2]);
  EXPECT_EQ(count_edges_below(t, 0.2), 0u);
}

TEST(ShortEdges, AsLongAsAskedStay) {
  for (const double least : {0.0, 0.1, 0.2}) {
    Tiling t = four_squares(0.2);
    collapse_short_edges(t, least, straight);
    EXPECT_EQ(t.node, four_squares(0.2).node);
    EXPECT_EQ(t.ring, four_squares(0.2).ring);
  }
}

/// A square of side 2 in which two lines run from the bottom, at x = a and x = b, to the top.
Tiling three_strips(double a, double b) {
  return {{{0, 0}, {a, 0}, {b, 0}, {2, 0}, {2, 2}, {1.5, 2}, {0.5, 2}, {0, 2}},
          {{0, 1, 6, 7}, {1, 2, 5, 6}, {2, 3, 4, 5}}};
}

TEST(ShortEdges, AlongTheBorderEndOnIt) {
  Tiling t = three_strips(0.9, 1.0);
  collapse_short_edges(t, 0.2, straight);
  ASSERT_EQ(t.ring[1].size(), 3u);
  EXPECT_EQ(points_of(t, 1)[0], (Vec2{0.95, 0.0}));

  t = three_strips(0.1, 1.0);  // the corner stays
  collapse_short_edges(t, 0.2, straight);
  ASSERT_EQ(t.ring[0].size(), 3u);
  EXPECT_EQ(points_of(t, 0)[0], (Vec2{0.0, 0.0}));
  EXPECT_EQ(points_of(t, 1).size(), 4u);
}

TEST(ShortEdges, IntoTheBorderEndOnIt) {
  Tiling t = three_strips(0.9, 1.6);  // from (0.9, 0) to (0.9, 0.1), and there a fork
  t.node[1] = {0.9, 0.1};
  t.node.push_back({0.9, 0.0});
  t.node.push_back({0.5, 1.0});
  t.ring = {{0, 8, 1, 9, 6, 7}, {8, 2, 5, 1}, {2, 3, 4, 5}, {1, 5, 6, 9}};
  collapse_short_edges(t, 0.2, straight);
  for (const std::size_t f : {0u, 1u, 3u}) {
    const Ring ring = points_of(t, f);
    EXPECT_EQ(std::count(ring.begin(), ring.end(), Vec2{0.9, 0.0}), 1) << f;
  }
  EXPECT_EQ(count_edges_below(t, 0.2), 0u);
}

/// A triangle would become a line; it goes to the polygon beside it, with the ends of the edge
/// between them.
TEST(ShortEdges, OfATriangleJoinItToItsNeighbour) {
  Tiling t{{{0, 0}, {1, 0}, {1, 1}, {0, 1}, {0.9, 0}, {1, 0.1}}, {{4, 1, 5}, {0, 4, 5, 2, 3}}};
  collapse_short_edges(t, 0.2, straight);
  ASSERT_EQ(t.ring.size(), 1u);
  EXPECT_EQ(t.ring[0], (std::vector<int>{0, 1, 2, 3}));
}

/// Without a short edge, but thinner than one.
TEST(ShortEdges, AreNoLongerThanAPolygonIsWide) {
  Tiling t{{{0, 0}, {1, 0}, {1, 1}, {0, 1}, {0.5, 0.1}}, {{0, 1, 4}, {0, 4, 1, 2, 3}}};
  collapse_short_edges(t, 0.09, straight);
  EXPECT_EQ(t.ring.size(), 2u);
  collapse_short_edges(t, 0.2, straight);  // two edges between them go
  ASSERT_EQ(t.ring.size(), 1u);
  EXPECT_EQ(t.ring[0], (std::vector<int>{0, 1, 2, 3}));
}

TEST(ShortEdges, OfALargeTriangleWithoutAny) {
  Tiling t{{{0, 0}, {1, 0}, {1, 1}, {0, 1}, {0.5, 0}, {1, 0.5}}, {{4, 1, 5}, {0, 4, 5, 2, 3}}};
  const Tiling before = t;
  collapse_short_edges(t, 0.2, straight);
  EXPECT_EQ(t.ring, before.ring);
}

/// Bricks in courses between joints at random, with nodes where others end on them. No two edges
/// are equally long.
Tiling bricks(unsigned seed, int courses, int joints) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> along(0.0, 1.0);
  std::map<std::pair<int, double>, int> number;  // of the node of a bed at x
  Tiling t;
  std::vector<std::vector<double>> course(static_cast<std::size_t>(courses)),
      bed(static_cast<std::size_t>(courses) + 1);
  for (std::size_t k = 0; k < course.size(); ++k) {
    course[k] = {0.0, 1.0};
    for (int i = 0; i < joints; ++i) course[k].push_back(along(random));
    std::sort(course[k].begin(), course[k].end());
    for (const std::size_t b : {k, k + 1}) {
      bed[b].insert(bed[b].end(), course[k].begin(), course[k].end());
    }
  }
  for (std::size_t b = 0; b < bed.size(); ++b) {
    std::sort(bed[b].begin(), bed[b].end());
    bed[b].erase(std::unique(bed[b].begin(), bed[b].end()), bed[b].end());
    const bool inner = b > 0 && b + 1 < bed.size();
    for (const double x : bed[b]) {
      number[{static_cast<int>(b), x}] = static_cast<int>(t.node.size());
      const double off = inner ? 0.01 * along(random) : 0.0;
      t.node.push_back({x, static_cast<double>(b) / courses + off});
    }
  }
  for (std::size_t k = 0; k < course.size(); ++k) {
    for (std::size_t i = 0; i + 1 < course[k].size(); ++i) {
      const double x0 = course[k][i], x1 = course[k][i + 1];
      std::vector<int>& ring = t.ring.emplace_back();
      for (const double x : bed[k]) {
        if (x >= x0 && x <= x1) ring.push_back(number[{static_cast<int>(k), x}]);
      }
      for (auto x = bed[k + 1].rbegin(); x != bed[k + 1].rend(); ++x) {
        if (*x >= x0 && *x <= x1) ring.push_back(number[{static_cast<int>(k) + 1, *x}]);
      }
    }
  }
  return t;
}

using Edges = std::multiset<std::pair<int, int>>;

/// Polygons are simple, and fill the unit square: each edge inside runs once either way.
void expect_sound(const Tiling& t) {
  Edges edges;
  double area = 0.0;
  for (std::size_t f = 0; f < t.ring.size(); ++f) {
    const Ring ring = points_of(t, f);
    ASSERT_GE(ring.size(), 3u);
    ASSERT_GT(signed_area(ring), 0.0);
    ASSERT_FALSE(self_crossing(ring));
    area += signed_area(ring);
    for (std::size_t i = 0; i < ring.size(); ++i) {
      edges.insert({t.ring[f][i], t.ring[f][(i + 1) % ring.size()]});
    }
  }
  EXPECT_NEAR(area, 1.0, 1e-12);
  double border = 0.0;
  for (const auto& [v, w] : edges) {
    ASSERT_EQ(edges.count({v, w}), 1u);
    if (edges.count({w, v}) == 1) continue;
    const Vec2 p = t.node[static_cast<std::size_t>(v)], q = t.node[static_cast<std::size_t>(w)];
    EXPECT_TRUE((p.x == q.x && (p.x == 0.0 || p.x == 1.0)) ||
                (p.y == q.y && (p.y == 0.0 || p.y == 1.0)));
    border += norm(q - p);
  }
  EXPECT_NEAR(border, 4.0, 1e-12);
}

/// Nodes in use, in order.
std::vector<std::pair<double, double>> places(const Tiling& t, bool mirrored, Vec2 by) {
  std::set<int> used;
  for (const std::vector<int>& ring : t.ring) used.insert(ring.begin(), ring.end());
  std::vector<std::pair<double, double>> all;
  for (const int v : used) {
    const Vec2 p = t.node[static_cast<std::size_t>(v)] - by;
    all.emplace_back(std::round(1e9 * (mirrored ? 1.0 - p.x : p.x)), std::round(1e9 * p.y));
  }
  std::sort(all.begin(), all.end());
  return all;
}

TEST(ShortEdges, LeaveATilingSound) {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    Tiling t = bricks(seed, 8, 6);
    const std::size_t polygons = t.ring.size();
    ASSERT_GT(count_edges_below(t, 0.02), 10u);
    collapse_short_edges(t, 0.02, straight);
    EXPECT_GT(t.ring.size(), polygons - polygons / 5) << seed;
    expect_sound(t);
    EXPECT_EQ(count_edges_below(t, 0.02), 0u) << seed;
  }
}

TEST(ShortEdges, BecomeTheSamePointsMovedOrMirrored) {
  for (unsigned seed = 1; seed <= 10; ++seed) {
    const Tiling first = bricks(seed, 6, 5);
    Tiling plain = first, moved = first, mirrored = first;
    for (Vec2& p : moved.node) p += Vec2{64.0, -32.0};
    for (Vec2& p : mirrored.node) p.x = 1.0 - p.x;
    for (std::vector<int>& ring : mirrored.ring) std::reverse(ring.begin(), ring.end());
    for (Tiling* t : {&plain, &moved, &mirrored}) collapse_short_edges(*t, 0.04, straight);
    EXPECT_EQ(places(plain, false, {}), places(moved, false, {64.0, -32.0}));
    EXPECT_EQ(places(plain, false, {}), places(mirrored, true, {}));
  }
}

}  // namespace
}  // namespace edda::short_edges_test
