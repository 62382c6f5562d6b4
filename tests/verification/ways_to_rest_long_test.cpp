// A wall of 70 x 70 bricks under its weight with default settings.
#include "verification/ways_to_rest.hpp"

namespace edda::ways_to_rest_long_test {
namespace {

using namespace ways_to_rest;

TEST(WaysToRestLong, AWallOfSeventyRowsStandsOnItsBase) {
  const EquilibriumRun found = run_to_equilibrium(wall(70, 70) + until_equilibrium);
  EXPECT_LT(found.outcome.steps, 15000U);
  expect_weight_carried(found, 1e-3);
}

}  // namespace
}  // namespace edda::ways_to_rest_long_test
