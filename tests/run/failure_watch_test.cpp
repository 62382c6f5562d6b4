#include "run/failure_watch.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "run/moved_block.hpp"

namespace edda {
namespace {

/// A boundary supports the block, so that it is watched.
const char* const supported = R"([joints.j]
friction_angle = 30
[[boundary]]
along = [[0, 0], [1, 0]]
)";

/// Whether the block, which has moved by `place` m (over time, s) along the x axis within 4 s, will
/// move beyond 0.1 m: judged from 0.03 m on, and beyond 0.1 m for 0.03 m more.
bool goes_beyond(const std::function<double(double)>& place, double slowest = 0.0) {
  Simulation sim = testing::one_block(supported);
  const State start = sim.motion.state;
  Watch watch(sim);
  watch.begin(sim);
  sim.relaxation.estimate.frequency = 20.0;
  while (sim.motion.state.time < 4.0) {
    testing::move_on(sim, start, place);
    watch.look_at_trend(sim);
    place_vertices(sim.scene->blocks, sim.motion.state.x, sim.motion.state.y, 0, sim.motion.pose.x,
                   sim.motion.pose.y);
    watch.velocity(sim);
  }
  return watch.goes_beyond(sim, {0.03, slowest}, {0.03, slowest}, 0.1, 0.03) != no_id;
}

double approach(double t) {
  return 1.0 - std::exp(-t / 0.2);
}

TEST(Watch, WhatHasMovedFarAndStoppedDoesNotContinue) {
  EXPECT_FALSE(goes_beyond([](double t) { return 0.5 * approach(t); }));
  EXPECT_TRUE(goes_beyond([](double t) { return 0.5 * approach(t) + 0.01 * t; }));
}

TEST(Watch, OnTheWayTheTrendMustReachTheDisplacement) {
  EXPECT_TRUE(goes_beyond([](double t) { return 0.01 * t; }));
  EXPECT_FALSE(goes_beyond([](double t) { return 0.09 * approach(t); }));
  EXPECT_FALSE(goes_beyond([](double t) { return 0.007 * t; })) << "not asked yet";
  EXPECT_TRUE(goes_beyond([](double t) { return 0.01 * t; }, 0.009));
  EXPECT_FALSE(goes_beyond([](double t) { return 0.01 * t; }, 0.011)) << "as slow as at rest";
}

}  // namespace
}  // namespace edda
