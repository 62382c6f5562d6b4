// Which factors the search for a factor of safety tries.
#include "study/fos_bracket.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace edda::fos_bracket_test {
namespace {

/// The factors that a search tries until it ends, if every factor below `limit` holds.
std::vector<double> asked(FosBracket bracket, double limit) {
  std::vector<double> factors;
  while (const auto f = bracket.next()) {
    factors.push_back(*f);
    bracket.take(*f, *f < limit);
  }
  return factors;
}

TEST(FosBracket, Bisects) {
  FosBracket b{1.0, 2.0, 0.25};
  EXPECT_EQ(asked(b, 1.6), (std::vector<double>{1.0, 2.0, 1.5, 1.75}));
}

/// A factor below is tried at last; where it holds, nothing changes.
TEST(FosBracket, LooksBelow) {
  FosBracket b{1.0, 2.0, 0.25};
  b.below = 1.2;
  EXPECT_EQ(asked(b, 1.6), (std::vector<double>{1.0, 2.0, 1.5, 1.75, 1.2}));
  for (const double factor : {1.0, 2.0, 1.5, 1.75}) b.take(factor, factor < 1.6);
  b.take(*b.next(), true);
  EXPECT_EQ(b.next(), std::nullopt);
  EXPECT_EQ(b.low, 1.5);
}
/// Where it fails, the search goes on below it, and factors above that hold no longer count.
TEST(FosBracket, GoesOnBelowAFactorThatFails) {
  FosBracket b{1.0, 2.0, 0.25};
  for (const double factor : {1.0, 2.0, 1.5, 1.75}) b.take(factor, factor < 1.6);
  b.below = 1.2;
  EXPECT_TRUE(b.may_ask(1.2) && b.may_ask(0.6));
  EXPECT_FALSE(b.may_ask(1.3));
  const std::vector<double> factors = asked(b, 1.1), expected{1.2, 0.6, 0.9, 1.05};
  ASSERT_EQ(factors.size(), expected.size());
  for (std::size_t i = 0; i < factors.size(); ++i) EXPECT_DOUBLE_EQ(factors[i], expected[i]);
}

TEST(FosBracket, MovesAnEndThatDoesNotHold) {
  FosBracket b{1.0, 2.0, 0.5};
  EXPECT_EQ(asked(b, 0.3), (std::vector<double>{1.0, 0.5, 0.25, 0.375}));
  EXPECT_EQ(asked(b, 5.0), (std::vector<double>{1.0, 2.0, 4.0, 8.0, 6.0}));
}

/// A factor of 21 takes as many trials as one of 1.05, and one of 0.0525.
TEST(FosBracket, ToleranceIsAPartOfTheFactor) {
  const std::vector<double> near_one = asked({1.0, 2.0, 0.01}, 1.05);
  for (const double times : {0.05, 20.0}) {
    std::vector<double> factors = asked({times, 2.0 * times, 0.01}, 1.05 * times);
    ASSERT_EQ(factors.size(), near_one.size());
    for (std::size_t i = 0; i < factors.size(); ++i)
      EXPECT_NEAR(factors[i], times * near_one[i], 1e-12 * times);
  }
}

/// As far as outcomes are known; with all of them it is complete, wherever its ends had to go.
TEST(FosBracket, FollowsWhatIsKnown) {
  const auto below = [](double factor) { return std::optional(factor < 1.6); };
  const FosBracket last = followed(FosBracket{1.0, 2.0, 0.25}, below);
  EXPECT_EQ(last.low, 1.5);
  EXPECT_EQ(last.high, 1.75);
  EXPECT_EQ(last.next(), std::nullopt);
  const FosBracket some =
      followed(FosBracket{1.0, 2.0, 0.25}, [&](double factor) { return last.shown(factor); });
  EXPECT_EQ(some.next(), std::nullopt);
  FosBracket shown{1.0, 2.0, 0.25};
  shown.take(1.75, false);
  EXPECT_EQ(shown.shown(1.8), false);
  EXPECT_EQ(shown.shown(1.7), std::nullopt);
  EXPECT_EQ(
      followed(FosBracket{1.0, 2.0, 0.25, true}, [&](double factor) { return shown.shown(factor); })
          .next(),
      1.5);
}

/// A factor far away that has been shown to hold, or to fail, is where it goes on instead.
TEST(FosBracket, ComesBackToWhatIsKnownFarAway) {
  const auto ends = [](FosBracket b, double limit) {
    return followed(b, [=](double factor) { return std::optional(factor < limit); });
  };
  FosBracket low{1024.0, 2048.0, 0.01};
  low.held = 1.0;
  EXPECT_LE(ends(low, 1.7).low, 1.7);
  EXPECT_NEAR(ends(low, 1.7).high, 1.7, 0.02);
  EXPECT_FALSE(ends(low, 1.7).gave_up());
  FosBracket high{1.0 / 2048.0, 1.0 / 1024.0, 0.01};
  high.failed = 1.0;
  EXPECT_LE(ends(high, 0.7).low, 0.7);
  EXPECT_NEAR(ends(high, 0.7).high, 0.7, 0.01);
  EXPECT_FALSE(ends(high, 0.7).gave_up());
}

/// But not beyond what it has found since.
TEST(FosBracket, StaysInOrderWhereALowerFactorFails) {
  const auto known = [](double factor) {
    return std::optional(factor < 1.2 && !(factor > 0.6 && factor < 0.9));
  };
  FosBracket b{1024.0, 2048.0, 0.01};
  b.held = 1.0;
  b = followed(b, known);
  EXPECT_NEAR(b.low, 1.2, 0.02);
  b.below = 0.77;
  b.widened = 0;
  b = followed(b, known);
  EXPECT_LT(b.low, b.high);
  EXPECT_NEAR(b.low, 0.6, 0.02);
}

TEST(FosBracket, GivesUp) {
  FosBracket b{1.0, 2.0, 0.5};
  EXPECT_EQ(asked(b, 0.0).back(), 1.0 / 32.0);
  EXPECT_EQ(asked(b, 1e9).back(), 64.0);
}

/// A factor whose outcome is known is not tried again.
TEST(FosBracket, TakesWhatIsKnown) {
  FosBracket b{0.5, 3.0, 0.5};
  b.take(1.0, true);
  EXPECT_EQ(b.next(), 3.0);
  FosBracket c{0.5, 3.0, 0.5};
  c.take(1.0, false);
  EXPECT_EQ(c.next(), 0.5);
  FosBracket d{2.0, 3.0, 0.5};
  d.take(1.0, true);
  EXPECT_EQ(asked(d, 1.4), (std::vector<double>{3.0, 2.0, 1.5}));
}

}  // namespace
}  // namespace edda::fos_bracket_test
