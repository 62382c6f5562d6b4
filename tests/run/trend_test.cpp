#include "run/trend.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>

#include "run/moved_block.hpp"

namespace edda {
namespace {

/// The trend of a block that is at `place` m (over time, s) along the x axis, in a model that moves
/// with `frequency` (1/s, over time), when it is known for the n-th time.
double to_come(const std::function<double(double)>& place,
               const std::function<double(double)>& frequency, int n) {
  Simulation sim = testing::one_block();
  const State start = sim.motion.state;
  Trend trend;
  trend.begin(sim);
  while (n > 0) {
    testing::move_on(sim, start, place);
    sim.relaxation.estimate.frequency = frequency(sim.motion.state.time);
    if (trend.look(sim)) --n;
  }
  return trend.to_come(0);
}

double steady(double) {
  return 20.0;
}

/// x = 1 - exp(-t/3 s): the distance exp(-t/3 s) remains.
TEST(Trend, OfWhatStops) {
  const auto slows = [](double t) { return 1.0 - std::exp(-t / 3.0); };
  const double pi = std::acos(-1.0);
  for (const auto& [n, half_periods] :
       {std::pair{2, 4.0}, std::pair{6, 16.0}, std::pair{9, 48.0}}) {
    const double left = std::exp(-half_periods * pi / 20.0 / 3.0);
    EXPECT_NEAR(to_come(slows, steady, n), left, 0.1 * left) << half_periods;
  }
}

TEST(Trend, OfWhatGoesOn) {
  const double endless = std::numeric_limits<double>::infinity();
  EXPECT_GT(to_come([](double t) { return 0.1 * t; }, steady, 1), 1e6);
  EXPECT_EQ(to_come([](double t) { return 0.1 * t * t; }, steady, 4), endless);
  EXPECT_EQ(to_come([](double t) { return std::sin(6.0 * t); }, steady, 1), 0.0) << "turns round";
}

/// With twice the damping, from 12 half periods on, the velocity under the same force is half.
TEST(Trend, CountsByTheDrag) {
  const auto heavier = [](double t) { return t < 1.885 ? 20.0 : 40.0; };
  const auto driven = [](double t) { return t < 1.885 ? 0.1 * t : 0.1885 + 0.0495 * (t - 1.885); };
  const double left = to_come(driven, heavier, 6);
  EXPECT_GT(left, 2.0) << "slower by one part of a hundred, not by half";
}

}  // namespace
}  // namespace edda
