// A wall of 70 x 70 bricks under its weight, all settings left out.
#include "verification/ways_to_rest.hpp"

namespace edda::ways_to_rest_long_test {
namespace {

using namespace ways_to_rest;

TEST(WaysToRestLong, AWallOfSeventyRowsStandsOnItsBase) {
  const Rested rested = at_rest(wall(70, 70) + until_rest);
  EXPECT_LT(rested.outcome.steps, 15000U);
  expect_borne(rested, 1e-3);
}

}  // namespace
}  // namespace edda::ways_to_rest_long_test
