#include "run/fos_watch.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "run/moved_block.hpp"

namespace edda {
namespace {

/// Something holds the block, so that it is watched.
const char* const held = R"([joints.j]
friction_angle = 30
[[boundary]]
along = [[0, 0], [1, 0]]
)";

/// Whether the block, which has gone `place` m (over time, s) along the x axis by 4 s, goes beyond
/// 0.1 m: asked from 0.03 m on, and past 0.1 m for 0.03 m more.
bool goes_beyond(const std::function<double(double)>& place) {
  Simulation sim = testing::one_block(held);
  const State start = sim.state;
  Watch watch(sim);
  watch.begin(sim);
  sim.pace.frequency = 20.0;
  while (sim.state.time < 4.0) {
    testing::move_on(sim, start, place);
    watch.look_at_trend(sim);
  }
  place_vertices(sim.blocks, sim.state.x, sim.state.y, 0, sim.pose.x, sim.pose.y);
  return watch.goes_beyond(sim, 0.03, 0.1, 0.03);
}

double rested(double t) {
  return 1.0 - std::exp(-t / 0.2);
}

TEST(Watch, WhatHasGoneFarAndRestsDoesNotGoOn) {
  EXPECT_FALSE(goes_beyond([](double t) { return 0.5 * rested(t); }));
  EXPECT_TRUE(goes_beyond([](double t) { return 0.5 * rested(t) + 0.01 * t; }));
}

TEST(Watch, OnTheWayTheTrendMustReachTheDisplacement) {
  EXPECT_TRUE(goes_beyond([](double t) { return 0.01 * t; }));
  EXPECT_FALSE(goes_beyond([](double t) { return 0.09 * rested(t); }));
  EXPECT_FALSE(goes_beyond([](double t) { return 0.007 * t; })) << "not asked yet";
}

}  // namespace
}  // namespace edda
