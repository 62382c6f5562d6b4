// Blocks that come loose in a stage until equilibrium, and where they come to rest.
#include <gtest/gtest.h>

#include <string>

#include "run/prepared.hpp"

namespace edda {
namespace {

/// What falls to a floor far below has come loose, though it comes to rest there; not where the
/// stage waits for what falls.
TEST(Stages, WhatFallsFarIsLooseWhereverItLands) {
  for (const double height : {0.5, 3.0}) {
    for (const char* detached : {"report", "wait"}) {
      const std::string high = std::to_string(height), top = std::to_string(height + 1.0);
      const Outcome o =
          testing::ran(
              "[materials.rock]\ndensity = 2600\nyoung = 1e9\npoisson = 0.25\n[joints.j]\n"
              "friction_angle = 30\n[[block]]\nfixed = true\npolygon = [[-9, -1], [9, -1], [9, 0], "
              "[-9, 0]]\n[[block]]\npolygon = [[0, " +
              high + "], [1, " + high + "], [1, " + top + "], [0, " + top +
              "]]\n[[stage]]\nuntil = 'equilibrium'\ndetached = '" + detached + "'\n")
              .outcome;
      const bool is_lost = height > 1.0 && detached[0] == 'r';
      EXPECT_EQ(o.status, is_lost ? Status::collapsed : Status::equilibrium) << o.message;
      EXPECT_EQ(o.loose, is_lost ? 1U : 0U) << height << detached;
    }
  }
}

/// So has what slides out of the roof and is stopped by the floor before it has gone its own way.
/// On its way it slides past corners at which the outline of the rock is straight.
TEST(Stages, APlugThatTheFloorStopsIsLoose) {
  const auto plug = [](const std::string& stage) {
    return testing::ran(
        "[materials.rock]\ndensity = 2500\nyoung = 20e9\npoisson = 0.2\n[joints.j]\n"
        "friction_angle = 20\n[domain]\njoint = 'j'\noutline = [[-5, -5], [5, -5], [5, 5], [-5, "
        "5]]\n"
        "[[trace]]\npoints = [[-1, 0], [-1, 2], [1, 2], [1, 0]]\n[[opening]]\nname = 'room'\n"
        "polygon = [[-1, -1.8], [1, -1.8], [1, 0], [-1, 0]]\n[[fixed]]\npoint = [-4, -4]\n"
        "[initial_stress]\nk0 = 0.4\nsurface_y = 5\n[[stage]]\nuntil = 'equilibrium'\n[[stage]]\n"
        "excavate = ['room']\n" +
        stage);
  };
  const testing::Ran held = plug("until = 'equilibrium'\n");
  EXPECT_EQ(held.outcome.status, Status::collapsed) << held.outcome.message;
  EXPECT_EQ(held.outcome.loose, 1U);
  const testing::Ran slides = plug("duration = 0.3\n");
  EXPECT_LT(slides.outcome.largest_transfer, 1e-6);
  EXPECT_LT(slides.outcome.largest_energy_error, 1e-6);
}

/// A block that falls beside another on a slab which is free itself does not bounce on.
TEST(Stages, WhatHasFallenComesToRest) {
  const testing::Ran r = testing::ran(
      "[materials.rock]\ndensity = 2600\nyoung = 20e9\npoisson = 0.25\n[joints.j]\n"
      "friction_angle = 30\nkn = 1e9\n[[block]]\nfixed = true\npolygon = [[-6, -3], [6, -3], "
      "[6, -2], [-6, -2]]\n[[block]]\npolygon = [[-5, -2], [5, -2], [5, 0], [-5, 0]]\n"
      "[[block]]\npolygon = [[-4, 0], [0, 0], [0, 2], [-4, 2]]\n[[block]]\nname = 'falls'\n"
      "polygon = [[2, 3], [3, 3], [3, 4], [2, 4]]\n[[stage]]\nuntil = 'equilibrium'\n"
      "detached = 'wait'\n");
  EXPECT_EQ(r.outcome.status, Status::equilibrium) << r.outcome.message;
  EXPECT_LT(r.outcome.steps, 30000U);
}

}  // namespace
}  // namespace edda
