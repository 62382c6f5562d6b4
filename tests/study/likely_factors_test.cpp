// Which factors are tried beside the one that the search needs.
#include "study/likely_factors.hpp"

#include <gtest/gtest.h>

#include <map>

namespace edda::likely_factors_test {
namespace {

/// Those that are likely if these outcomes are known.
std::vector<double> likely(const FosBracket& bracket, std::size_t most,
                           const std::map<double, bool>& known = {}) {
  return likely_factors(bracket, most, [&](double factor) -> std::optional<bool> {
    const auto found = known.find(factor);
    return found == known.end() ? std::nullopt : std::optional<bool>(found->second);
  });
}

/// The ends are expected to do what they were given for.
TEST(LikelyFactors, EndsAreAsExpected) {
  EXPECT_EQ(likely({1.0, 3.0, 0.1}, 3), (std::vector<double>{1.0, 3.0, 2.0}));
  EXPECT_EQ(likely({1.0, 3.0, 0.1, true}, 3), (std::vector<double>{3.0, 2.0, 1.5}));
}

/// After either outcome, that of failure first.
TEST(LikelyFactors, BothHalves) {
  const FosBracket bracket{1.0, 3.0, 0.1, true, true};
  EXPECT_EQ(likely(bracket, 1), (std::vector<double>{2.0}));
  EXPECT_EQ(likely(bracket, 4), (std::vector<double>{2.0, 1.5, 1.25, 2.5}));
}

/// What is known leads on to what follows from it, and is not tried again.
TEST(LikelyFactors, GoesOnFromWhatIsKnown) {
  const FosBracket bracket{1.0, 3.0, 0.1, true, true};
  EXPECT_EQ(likely(bracket, 2, {{1.5, true}}), (std::vector<double>{2.0, 1.75}));
  EXPECT_EQ(likely(bracket, 2, {{2.0, false}, {1.5, true}}), (std::vector<double>{1.75, 1.625}));
}

/// Every factor that the search may ask for is among them, the one that it needs always first.
TEST(LikelyFactors, AreAllInTheEnd) {
  const FosBracket bracket{1.0, 3.0, 0.3, true, true};
  EXPECT_EQ(likely(bracket, 100).size(), 5U);
  EXPECT_EQ(likely({1.0, 1.05, 0.1, true, true}, 100).size(), 0U);
}

}  // namespace
}  // namespace edda::likely_factors_test
