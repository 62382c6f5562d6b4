// What ramps and trials vary: gravity, multipliers of loads, waters and boundaries.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "attachments/ground.hpp"
#include "attachments/loaded_blocks.hpp"

namespace edda::slow_loading_test {
namespace {

using test::Loaded;

constexpr Vec2 down{0.0, -10.0};

void expect_near(Vec2 a, Vec2 b) {
  EXPECT_NEAR(a.x, b.x, 1e-12);
  EXPECT_NEAR(a.y, b.y, 1e-12);
}

SteppedValue steady(double value) {
  return {value, value};
}

/// With gravity downwards forces of a seismic coefficient point to the right and upwards, and a
/// tilted table leans to the right.
TEST(SlowLoading, GravityIsTurnedToTheRightAndLightened) {
  SlowLoading slow;
  expect_near(gravity_at(down, slow, 1.0, {}), down);
  slow.kh = steady(0.3);
  expect_near(gravity_at(down, slow, 1.0, {}), {3.0, -10.0});
  slow.kv = steady(0.2);
  expect_near(gravity_at(down, slow, 1.0, {}), {3.0, -8.0});
  slow.gravity = steady(2.0);
  expect_near(gravity_at(down, slow, 1.0, {}), {6.0, -16.0});
  slow = {};
  slow.tilt = steady(30.0);
  expect_near(gravity_at(down, slow, 1.0, {}), {5.0, -5.0 * std::sqrt(3.0)});
}

/// It changes in proportion to what has been applied; at the instant of a sudden change half of it
/// acts.
TEST(SlowLoading, ChangesGraduallyOrAtOnce) {
  SlowLoading slow;
  slow.kh.change(0.4, 2.0);
  expect_near(gravity_at(down, slow, 2.0, {}), {2.0, -10.0});
  expect_near(gravity_at(down, slow, 2.1, {}), {4.0, -10.0});
  expect_near(gravity_at(down, slow, 2.1, {2.0, 0.25, false}), {1.0, -10.0});
  expect_near(gravity_at(down, slow, 2.1, {1.0, 0.25, false}), {4.0, -10.0});  // another change
  slow.kh.change(0.2, 3.0);
  expect_near(gravity_at(down, slow, 3.1, {3.0, 0.5, false}), {3.0, -10.0});
}

TEST(SlowLoading, MultipliesLoadsAndWater) {
  Loaded l;
  l.add({{0, 0}, {1, 0}, {1, 1}, {0, 1}});
  Load point, body;
  point.point = Vec2{0.5, 0.5};
  point.force = Vec2{10.0, 0.0};
  body.within = {{0, 0}, {0, 2}, {2, 2}, {2, 0}};  // clockwise
  body.body_force = Vec2{0.0, -7.0};
  l.model.loads = {point, body};
  l.model.waters = {test::lake({{-1, 0.5}, {2, 0.5}})};
  l.attach();
  ASSERT_TRUE(l.faults.empty());
  const double uplift = 0.5 * l.model.waters[0].unit_weight;
  expect_near(l.on(0).force, {10.0, uplift - 7.0});
  EXPECT_NEAR(l.on(0).moment, 0.0, 1e-9);
  *slow_value(l.loads.slow, Varied::load, 0) = steady(3.0);
  expect_near(l.on(0).force, {30.0, uplift - 7.0});
  *slow_value(l.loads.slow, Varied::load, 1) = steady(2.0);
  expect_near(l.on(0).force, {30.0, uplift - 14.0});
  *slow_value(l.loads.slow, Varied::water, 0) = steady(0.5);
  expect_near(l.on(0).force, {30.0, 0.5 * uplift - 14.0});
  EXPECT_EQ(slow_value(l.loads.slow, Varied::strength, none), nullptr);
  EXPECT_EQ(slow_value(l.loads.slow, Varied::shaking, 0), nullptr);
}

/// A body force acts on the blocks whose centroids lie in its polygon, and on these whole.
TEST(SlowLoading, BodyForceActsInItsRegion) {
  Loaded l;
  l.add({{0, 0}, {1, 0}, {1, 1}, {0, 1}});
  l.add({{1, 0}, {3, 0}, {3, 1}, {1, 1}});
  l.add({{3, 0}, {4, 0}, {4, 1}, {3, 1}}, true);
  Load body;
  body.within = {{1.4, -1}, {9, -1}, {9, 2}, {1.4, 2}};
  body.body_force = Vec2{5.0, 0.0};
  l.model.loads = {body};
  l.attach();
  ASSERT_TRUE(l.faults.empty());
  expect_near(l.on(0).force, {0.0, 0.0});
  expect_near(l.on(1).force, {10.0, 0.0});
  expect_near(l.on(2).force, {0.0, 0.0});
  l.model.loads[0].within = {{0, 5}, {1, 5}, {1, 6}};
  l.attach();
  ASSERT_EQ(l.faults.size(), 1u);
}

/// The support is displaced by what its factor is at the end of the step, from the ground.
TEST(SlowLoading, DisplacesASupport) {
  Model model;
  Boundary support;
  support.type = BoundaryType::displacement;
  support.displacement = Vec2{0.0, -0.2};
  support.factor = {{0.0, 2.0}, {0.0, 1.0}};
  model.boundaries = {support};
  Loads loads;
  loads.intervals.boundaries = {{1.0}};
  loads.slow.boundaries = {steady(3.0)};
  BoundarySprings springs;
  springs.shift = {{0.0, 0.0}};
  Ground ground;
  ground.shift = {0.5, 0.0};
  EXPECT_TRUE(find_ground(model, {}).moves);
  expect_near(next_ground(model, loads, ground, springs, 0.0, 0.5, 0.5).shifts[0], {0.5, 0.0});
  expect_near(next_ground(model, loads, ground, springs, 1.5, 0.5, 0.5).shifts[0],
              {0.5, 3.0 * 0.5 * -0.2});
}

}  // namespace
}  // namespace edda::slow_loading_test
