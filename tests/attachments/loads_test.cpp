#include "attachments/loads.hpp"

#include <gtest/gtest.h>

#include <string>

#include "attachments/loaded_blocks.hpp"

namespace edda::loads_test {
namespace {

using test::Loaded;

TEST(Load, ActsAtItsPoint) {
  Loaded l;
  l.add({{0, 0}, {2, 0}, {2, 2}, {0, 2}});
  Load load;
  load.point = Vec2{1.5, 2.0};
  load.force = Vec2{10.0, -30.0};
  load.factor = {{1.0, 2.0}, {0.0, 1.0}};
  l.model.loads = {load};
  l.attach();
  ASSERT_TRUE(l.faults.empty());
  EXPECT_EQ(l.on(0, 0.5).force, (Vec2{0.0, 0.0}));
  const auto r = l.on(0, 1.5);
  EXPECT_NEAR(r.force.x, 5.0, 1e-12);
  EXPECT_NEAR(r.force.y, -15.0, 1e-12);
  EXPECT_NEAR(r.moment, 0.5 * -15.0 - 1.0 * 5.0, 1e-12);
}

/// A traction keeps its direction and the length it was given for; a pressure rotates with the
/// face. Both act where the line lies on the face and nowhere else.
TEST(Load, ActsAlongALine) {
  Loaded l;
  l.add({{0, 0}, {2, 0}, {2, 2}, {0, 2}});
  l.add({{2, 0}, {4, 0}, {4, 2}, {2, 2}});
  Load traction, pressure;
  traction.along = {{0.5, 2}, {3, 2}, {3, 9}};
  traction.force = Vec2{0.0, -100.0};
  pressure.along = {{0, -1}, {0, 3}};
  pressure.pressure = 40.0;
  l.model.loads = {traction, pressure};
  l.attach();
  ASSERT_TRUE(l.faults.empty());
  const auto left = l.on(0), right = l.on(1);
  EXPECT_NEAR(left.force.x, 80.0, 1e-12);
  EXPECT_NEAR(left.force.y, -150.0, 1e-12);
  EXPECT_NEAR(left.moment, -150.0 * 0.25, 1e-12);
  EXPECT_NEAR(right.force.y, -100.0, 1e-12);
  EXPECT_NEAR(right.moment, 100.0 * 0.5, 1e-12);
  // Rotated by a quarter turn: the pressure acts downwards, the traction as before.
  std::vector<double> x, y;
  for (std::size_t v = 0; v < l.blocks.vertex_count(); ++v) {
    x.push_back(-l.blocks.vertex_y[v]);
    y.push_back(l.blocks.vertex_x[v]);
  }
  const auto turned = l.on(0, x, y);
  EXPECT_NEAR(turned.force.x, 0.0, 1e-12);
  EXPECT_NEAR(turned.force.y, -150.0 + 80.0, 1e-12);
}

/// A traction acts where the face is free: what a neighbour covers, at either end, in the middle or
/// from a lower block, is left out.
TEST(Load, LeavesOutWhatANeighbourCovers) {
  struct Case {
    Ring neighbour;
    double left;  ///< of the ten metres
  };
  for (const Case& c :
       {Case{{{0, 1}, {2, 1}, {2, 2}, {0, 2}}, 8.0}, Case{{{4, 1}, {7, 1}, {7, 2}, {4, 2}}, 7.0},
        Case{{{8, 1}, {10, 1}, {10, 2}, {8, 2}}, 8.0},
        Case{{{-3, 1}, {6, 1}, {6, 2}, {-3, 2}}, 4.0}}) {
    for (const bool held : {false, true}) {
      Loaded l;
      l.add({{0, 0}, {10, 0}, {10, 1}, {0, 1}});
      l.add(c.neighbour, held);
      Load load;
      load.along = {{-1, 1}, {11, 1}};
      load.force = Vec2{0.0, -100.0};
      l.model.loads = {load};
      l.attach();
      ASSERT_TRUE(l.faults.empty());
      EXPECT_NEAR(l.on(0).force.y, -100.0 * c.left, 1e-9);
    }
  }
}

/// A line that turns back loads no face twice.
TEST(Load, CountsAFaceOnce) {
  Loaded l;
  l.add({{0, 0}, {2, 0}, {2, 2}, {0, 2}});
  Load load;
  load.along = {{0, 2}, {2, 2}, {1, 2}, {3, 2}};
  load.pressure = 10.0;
  l.model.loads = {load};
  l.attach();
  ASSERT_TRUE(l.faults.empty());
  EXPECT_NEAR(l.on(0).force.y, -20.0, 1e-12);
}

/// Far from the origin, along a face that no axis is parallel to.
TEST(Load, FindsFacesFarAway) {
  Loaded l;
  const Vec2 far{5e6, 3e6};
  Ring ring;
  for (const Vec2 p : {Vec2{0, 0}, Vec2{0.05, 0}, Vec2{0.05, 0.05}, Vec2{0, 0.05}})
    ring.push_back(rotated(p, 0.7));
  l.add(ring);
  l.set.origin = far;
  Load load;
  load.along = {far + ring[2], far + ring[3]};
  load.pressure = 100.0;
  l.model.loads = {load};
  l.attach();
  ASSERT_TRUE(l.faults.empty());
  EXPECT_NEAR(norm(l.on(0).force), 5.0, 1e-6);
}

/// Where a free and a fixed block meet, the load is the free one's.
TEST(Load, PrefersTheFreeBlock) {
  Loaded l;
  l.add({{0, 0}, {2, 0}, {2, 2}, {0, 2}}, true);
  l.add({{2, 0}, {4, 0}, {4, 2}, {2, 2}});
  Load load;
  load.point = Vec2{2.0, 1.0};
  load.force = Vec2{3.0, 0.0};
  l.model.loads = {load};
  l.attach();
  ASSERT_TRUE(l.faults.empty());
  EXPECT_NEAR(l.on(1).force.x, 3.0, 1e-12);
}

TEST(Load, PressureInAJointActsOnBothFaces) {
  Loaded l;
  l.add({{0, 0}, {2, 0}, {2, 2}, {0, 2}});
  l.add({{2, 0}, {4, 0}, {4, 2}, {2, 2}});
  Load jack;
  jack.along = {{2, 0.5}, {2, 1.0}};
  jack.pressure = 10.0;
  l.model.loads = {jack};
  l.attach();
  ASSERT_TRUE(l.faults.empty());
  EXPECT_NEAR(l.on(0).force.x, -5.0, 1e-12);
  EXPECT_NEAR(l.on(1).force.x, 5.0, 1e-12);
}

/// What a load that acts on nothing says.
TEST(Load, RefusesWhatItCannotActOn) {
  struct Case {
    Load load;
    std::string key, problem;
  };
  Load nowhere, held, joint, outside;
  nowhere.point = Vec2{1, 9};
  nowhere.force = Vec2{1, 0};
  held.point = Vec2{5, 1};
  held.force = Vec2{1, 0};
  joint.along = {{2, 0}, {2, 2}};
  joint.force = Vec2{1, 0};
  outside.along = {{0, 7}, {2, 7}};
  outside.pressure = 1.0;
  for (const Case& c :
       {Case{nowhere, "load.0.point", "lies in no block"}, Case{held, "load.0.point", "is fixed"},
        Case{joint, "load.0.along", "along a joint"},
        Case{outside, "load.0.along", "no face of a free block"}}) {
    Loaded l;
    l.add({{0, 0}, {2, 0}, {2, 2}, {0, 2}});
    l.add({{2, 0}, {4, 0}, {4, 2}, {2, 2}});
    l.add({{4, 0}, {6, 0}, {6, 2}, {4, 2}}, true);
    l.model.loads = {c.load};
    l.model.loads[0].where.key = "load.0";
    l.attach();
    ASSERT_EQ(l.faults.size(), 1u) << c.problem;
    EXPECT_EQ(l.faults[0].where.key, c.key);
    EXPECT_NE(l.faults[0].problem.find(c.problem), std::string::npos) << l.faults[0].problem;
  }
}

/// Of a model 2 m thick.
TEST(Load, GrowsWithTheThickness) {
  Loaded l;
  l.model.thickness = 2.0;
  l.add({{0, 0}, {3, 0}, {3, 1}, {0, 1}});
  Load pressure;
  pressure.along = {{0, 1}, {3, 1}};
  pressure.pressure = 1e4;
  l.model.loads = {pressure};
  l.attach();
  ASSERT_TRUE(l.faults.empty());
  EXPECT_NEAR(l.on(0).force.y, -2.0 * 3.0 * 1e4, 1e-6);
}

}  // namespace
}  // namespace edda::loads_test
