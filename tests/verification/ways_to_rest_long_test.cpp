// A wall of 100 x 100 bricks under its weight, all settings left out.
#include "verification/ways_to_rest.hpp"

namespace edda::ways_to_rest_long_test {
namespace {

using namespace ways_to_rest;

TEST(WaysToRestLong, AWallOfAHundredRowsStandsOnItsBase) {
  const Rested rested = at_rest(wall(100, 100) + until_rest);
  EXPECT_LT(rested.outcome.steps, 15000U);
  expect_borne(rested, 1e-3);
}

}  // namespace
}  // namespace edda::ways_to_rest_long_test
