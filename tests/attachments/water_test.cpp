// Pressure of water on the faces of blocks.
#include <gtest/gtest.h>

#include "attachments/loaded_blocks.hpp"

namespace edda::water_test {
namespace {

using test::lake;
using test::Loaded;
using test::odd_shape;

/// Archimedes: water all round pushes up with its weight, through the centroid.
TEST(Water, LiftsWhatIsUnderIt) {
  Loaded l;
  l.add(odd_shape);
  l.model.waters = {lake({{-9, 7}, {2, 7}, {2.2, 7}, {9, 7}})};
  l.model.thickness = 2.0;
  l.attach();
  ASSERT_TRUE(l.faults.empty());
  const auto r = l.on(0);
  const double up = 9810.0 * 2.0 * l.blocks.area[0];
  EXPECT_NEAR(r.force.y / up, 1.0, 1e-12);
  EXPECT_NEAR(r.force.x, 0.0, 1e-9 * up);
  EXPECT_NEAR(r.moment, 0.0, 1e-9 * up);
}

/// Half in: the weight of the water that it takes the place of, through that part's centroid; the
/// table falls and rises with time.
TEST(Water, LiftsWhatReachesIntoIt) {
  Loaded l;
  l.add({{0, 0}, {2, 0}, {2, 2}, {0, 2}});
  l.model.waters = {lake({{-9, 0}, {9, 0}})};
  l.model.waters[0].rise = {{0.0, 1.0, 3.0}, {-1.0, 0.5, 1.5}};
  l.attach();
  EXPECT_EQ(l.on(0, 0.0).force, (Vec2{0.0, 0.0}));
  EXPECT_NEAR(l.on(0, 1.0).force.y, 9810.0 * 2.0 * 0.5, 1e-8);
  EXPECT_NEAR(l.on(0, 2.0).force.y, 9810.0 * 2.0 * 1.0, 1e-8);
  EXPECT_NEAR(l.on(0, 9.0).force.y, 9810.0 * 2.0 * 1.5, 1e-8);
  EXPECT_NEAR(l.on(0, 9.0).force.x, 0.0, 1e-8);
}

/// A table with a kink over a rotated block, against brute force: many short pieces of every edge.
TEST(Water, IntegratesUnderAnyTable) {
  Loaded l;
  l.add(odd_shape);
  const std::vector<Vec2> table{{-5, 0.2}, {0.9, 1.4}, {1.1, 0.6}, {2.6, 1.9}};
  l.model.waters = {lake(table)};
  l.attach();
  const auto level = [&](double x) {
    std::size_t k = 1;
    while (k + 1 < table.size() && table[k].x < x) ++k;
    const double part = (x - table[k - 1].x) / (table[k].x - table[k - 1].x);
    return table[k - 1].y + part * (table[k].y - table[k - 1].y);
  };
  // The block has rotated a little and moved: the table stays with the faces it was over.
  std::vector<double> x = l.blocks.vertex_x, y = l.blocks.vertex_y;
  for (std::size_t v = 0; v < x.size(); ++v) {
    const Vec2 p = rotated({x[v], y[v]}, 0.2) + Vec2{0.3, -0.1};
    x[v] = p.x;
    y[v] = p.y;
  }
  Vec2 force;
  for (Id v = 0; v < x.size(); ++v) {
    const Id end = l.blocks.next[v];
    const Vec2 u{x[end] - x[v], y[end] - y[v]};
    constexpr int pieces = 200000;
    for (int k = 0; k < pieces; ++k) {
      const double s = (k + 0.5) / pieces;
      const double x0 = (1 - s) * l.blocks.vertex_x[v] + s * l.blocks.vertex_x[end];
      if (x0 > 2.6) continue;
      const double depth = level(x0) - (y[v] + s * u.y);
      if (depth > 0.0) force -= 9810.0 * depth / pieces * outward_normal(u);
    }
  }
  const auto r = l.on(0, x, y);
  EXPECT_NEAR(r.force.x, force.x, 1e-5 * norm(force));
  EXPECT_NEAR(r.force.y, force.y, 1e-5 * norm(force));
}

/// Of two blocks side by side the joint is pushed apart; faces of an opening stay dry unless it is
/// flooded.
TEST(Water, FillsJointsAndLeavesOpeningsDry) {
  for (const bool flooded : {false, true}) {
    Loaded l;
    l.add({{0, 0}, {1, 0}, {1, 1}, {0, 1}});
    l.add({{1, 0}, {2, 0}, {2, 1}, {1, 1}});
    Opening opening;
    opening.name = "pit";
    opening.polygon = {{2, 0}, {3, 0}, {3, 1}, {2, 1}};
    l.model.openings = {opening};
    l.model.waters = {lake({{0.5, 3}, {2.5, 3}})};
    if (flooded) l.model.waters[0].flooded = {"pit"};
    l.attach();
    const double push = 9810.0 * 2.5;
    EXPECT_NEAR(l.on(0).force.x, -push, 1e-8);
    EXPECT_NEAR(l.on(1).force.x, flooded ? 0.0 : push, 1e-8);
    EXPECT_NEAR(l.on(1).force.y, 9810.0, 1e-8);
  }
}

/// A face that runs on past an opening, or along two of them, is dry just where they are.
TEST(Water, IsDryOnlyAlongTheOpening) {
  auto with = [](std::vector<Ring> openings) {
    Loaded l;
    l.add({{0, 0}, {10, 0}, {10, 4}, {0, 4}});
    for (const Ring& ring : openings) {
      Opening o;
      o.polygon = ring;
      l.model.openings.push_back(o);
    }
    l.model.waters = {lake({{-1, 10}, {11, 10}})};
    l.attach();
    return l.on(0).force.y / 9810.0;
  };
  const Ring pit{{4, 4}, {6, 4}, {6, 6}, {4, 6}}, shaft{{6, 4}, {7, 4}, {7, 9}, {6, 9}};
  EXPECT_NEAR(with({}), 40.0, 1e-9);
  EXPECT_NEAR(with({pit}), 40.0 + 2.0 * 6.0, 1e-9);
  EXPECT_NEAR(with({pit, shaft}), 40.0 + 3.0 * 6.0, 1e-9);
}

}  // namespace
}  // namespace edda::water_test
