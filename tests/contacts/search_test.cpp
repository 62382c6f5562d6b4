#include "contacts/search.hpp"

#include <gtest/gtest.h>

#include <numbers>
#include <random>

#include "blocks/build_blocks.hpp"
#include "blocks/pose.hpp"
#include "contacts/inside.hpp"

namespace edda::search_test {
namespace {

/// Random polygons, which may overlap, of very different sizes; some are fixed.
BlockSet random_blocks(unsigned seed, int n, double spread) {
  std::mt19937 rng(seed);
  std::uniform_real_distribution<double> u(0.0, 1.0);
  Model model;
  model.materials.push_back({"rock", 2600.0, 1e9, 0.2, {}});
  PolygonSet set;
  for (int i = 0; i < n; ++i) {
    const double size = std::pow(10.0, -2.0 * u(rng) * spread);
    const Vec2 c{10.0 * u(rng) - 5.0, 10.0 * u(rng) - 5.0};
    const int corners = 3 + static_cast<int>(6.0 * u(rng));
    Ring ring;
    for (int k = 0; k < corners; ++k) {
      const double a = 2.0 * std::numbers::pi * (k + 0.5 * u(rng)) / corners;
      ring.push_back(c + size * (0.5 + 0.5 * u(rng)) * Vec2{std::cos(a), std::sin(a)});
    }
    BlockPolygon p;
    p.rings = {ring};
    p.joint = {std::vector<Index>(ring.size(), none)};
    p.material = 0;
    p.fixed = u(rng) < 0.2;
    set.blocks.push_back(p);
  }
  return build_blocks(model, set);
}

double distance(Vec2 p, Vec2 a, Vec2 b) {
  const Vec2 u = b - a;
  const double s = std::clamp(dot(p - a, u) / dot(u, u), 0.0, 1.0);
  return norm(p - (a + s * u));
}

std::vector<NearPair> brute_force(const BlockSet& b, const std::vector<std::uint8_t>& alive,
                                  double reach) {
  std::vector<NearPair> pairs;
  for (Id v = 0; v < b.vertex_count(); ++v) {
    for (Id e = 0; e < b.vertex_count(); ++e) {
      const Id i = b.vertex_block[v], j = b.vertex_block[e];
      if (i == j || !alive[i] || !alive[j] || (b.fixed[i] && b.fixed[j])) continue;
      const Vec2 p = at(b.vertex_x, b.vertex_y, v), q = at(b.vertex_x, b.vertex_y, e);
      const Vec2 r = at(b.vertex_x, b.vertex_y, b.next[e]);
      if (distance(p, q, r) < reach) pairs.push_back({v, e});
    }
  }
  return pairs;
}

TEST(NearPairs, AgreeWithBruteForce) {
  std::size_t total = 0;
  for (unsigned seed = 0; seed < 60; ++seed) {
    const BlockSet b = random_blocks(seed, 60, (seed % 3) * 0.5);
    std::vector<std::uint8_t> alive(b.size(), 1);
    alive[seed % b.size()] = 0;
    for (const double reach : {1e-3, 0.03, 0.3, 2.0}) {
      const auto expected = brute_force(b, alive, reach);
      EXPECT_EQ(near_pairs(b, alive, b.vertex_x, b.vertex_y, reach), expected);
      total += expected.size();
    }
  }
  EXPECT_GT(total, 10000u);
}

TEST(NearPairs, FarOutlierIsFound) {
  Model model;
  model.materials.push_back({"rock", 2600.0, 1e9, 0.2, {}});
  PolygonSet set;
  for (const Vec2 c : {Vec2{0, 0}, Vec2{1e7, 1e7}, Vec2{1e7 + 1.0, 1e7}}) {
    BlockPolygon p;
    p.rings = {{c, c + Vec2{1, 0}, c + Vec2{1, 1}, c + Vec2{0, 1}}};
    p.joint = {std::vector<Index>(4, none)};
    p.material = 0;
    set.blocks.push_back(p);
  }
  const BlockSet b = build_blocks(model, set);
  const std::vector<std::uint8_t> alive(3, 1);
  const auto pairs = near_pairs(b, alive, b.vertex_x, b.vertex_y, 0.01);
  EXPECT_EQ(pairs, brute_force(b, alive, 0.01));
  EXPECT_EQ(pairs.size(), 8u);
}

TEST(NearPairs, ThinStripsBesideBlocksOfAnySize) {
  Model model;
  model.materials.push_back({"rock", 2600.0, 1e9, 0.2, {}});
  PolygonSet set;
  const auto add = [&](Vec2 low, Vec2 along, double width) {
    const Vec2 across = width / norm(along) * perp(along);
    BlockPolygon p;
    p.rings = {{low, low + along, low + along + across, low + across}};
    p.joint = {std::vector<Index>(4, none)};
    p.material = 0;
    set.blocks.push_back(p);
  };
  for (int k = 0; k < 100; ++k) add({0.0, 0.01 * k}, {50.0, 0.0}, 0.01);
  for (int k = 0; k < 100; ++k) add({0.01 * k, 2.0}, {20.0, 31.0}, 0.008);
  for (int k = 0; k < 40; ++k) add({10.0 + 1e-3 * k, -1e-3}, {1e-3, 0.0}, 1e-3);
  add({-500.0, -1000.0}, {1000.0, 0.0}, 1000.0 - 2e-3);
  const BlockSet b = build_blocks(model, set);
  const std::vector<std::uint8_t> alive(b.size(), 1);
  for (const double reach : {1e-5, 5e-4, 0.02}) {
    const auto pairs = near_pairs(b, alive, b.vertex_x, b.vertex_y, reach);
    EXPECT_EQ(pairs, brute_force(b, alive, reach));
    EXPECT_GT(pairs.size(), 300u);
  }
}

/// Random points, and such as lie at the height of a corner, on a boundary, or in a corner.
TEST(Inside, IsWhereTheDepthIsPositive) {
  const BlockSet b = random_blocks(11, 60, 0.5);
  Pose pose;
  pose.x = b.vertex_x;
  pose.y = b.vertex_y;
  std::mt19937 rng(12);
  std::uniform_real_distribution<double> u(-0.6, 0.6);
  int inside = 0, outside = 0;
  for (int n = 0; n < 20000; ++n) {
    const auto v = static_cast<std::size_t>(rng() % b.vertex_count()), e = std::size_t{b.next[v]};
    const std::size_t j = b.vertex_block[v];
    Vec2 p{b.centroid_x[j] + u(rng), b.centroid_y[j] + u(rng)};
    if (n % 4 == 1) p.y = b.vertex_y[v];
    if (n % 4 == 2) p = 0.5 * (b.vertex(v) + b.vertex(e));
    if (n % 16 == 3) p = b.vertex(v);
    const bool lies = lies_inside(b, pose, p, j);
    EXPECT_EQ(lies, depth_inside(b, pose, p, j) > 0.0);
    ++(lies ? inside : outside);
  }
  EXPECT_GT(inside, 1000);
  EXPECT_GT(outside, 1000);
}

}  // namespace
}  // namespace edda::search_test
