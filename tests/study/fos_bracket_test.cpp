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
