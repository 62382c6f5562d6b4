// Whether single blocks are at rest.
#include "judge/rest.hpp"

#include <gtest/gtest.h>

#include "run/prepared.hpp"

namespace edda {
namespace {

/// The mass of a chip is scaled up so far, beside a block of 10 m, that what still moves it is less
/// than the last digit of its coordinates. It was never at rest.
TEST(Rest, AChipWhoseCoordinatesDoNotChangeIsAtRest) {
  const testing::Ran r = testing::ran(
      "[materials.rock]\ndensity = 2600\nyoung = 15e9\npoisson = 0.25\n"
      "[joints.j]\nfriction_angle = 36\nkn = '10 GPa/m'\n"
      "[[block]]\nfixed = true\npolygon = [[100, 60], [180, 60], [180, 70], [100, 70]]\n"
      "[[block]]\npolygon = [[130, 70], [140, 70], [140, 80], [130, 80]]\n"
      "[[block]]\nname = 'chip'\npolygon = [[139.9, 80], [139.9003, 80], [139.9, 80.00024]]\n"
      "[[stage]]\nuntil = 'equilibrium'\n");
  EXPECT_EQ(r.outcome.status, Status::equilibrium) << r.outcome.message;
  EXPECT_LT(r.outcome.steps, 30000U);
}

}  // namespace
}  // namespace edda
