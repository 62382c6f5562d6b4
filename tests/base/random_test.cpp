// The random numbers: known values, moments, and functions against the library's.
#include "base/random.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <vector>

namespace edda::random_test {
namespace {

TEST(Random, IsSplitMix64) {
  Random random(1234567);
  for (const std::uint64_t expected : {6457827717110365317ULL, 3203168211198807973ULL,
                                       9817491932198370423ULL, 4593380528125082431ULL}) {
    EXPECT_EQ(random.next(), expected);
  }
}

TEST(Random, UniformFillsItsRangeEvenly) {
  Random random(5);
  constexpr int n = 100000;
  std::array<int, 20> bins{};
  for (int i = 0; i < n; ++i) {
    const double u = random.uniform();
    ASSERT_GE(u, 0.0);
    ASSERT_LT(u, 1.0);
    ++bins[static_cast<std::size_t>(u * 20.0)];
  }
  // Chi-squared of 19 degrees of freedom: above 43.8 once in a thousand.
  double chi = 0.0;
  for (const int count : bins) chi += (count - n / 20.0) * (count - n / 20.0) / (n / 20.0);
  EXPECT_LT(chi, 43.8);
}

/// Largest distance of the sample's distribution from the normal one (Kolmogorov and Smirnov).
double distance_from_normal(std::vector<double> sample) {
  std::sort(sample.begin(), sample.end());
  double largest = 0.0;
  for (std::size_t i = 0; i < sample.size(); ++i) {
    const double p = 0.5 * std::erfc(-sample[i] / std::sqrt(2.0));
    const double below = static_cast<double>(i) / static_cast<double>(sample.size());
    largest = std::max(largest, std::abs(p - below));
  }
  return largest;
}

TEST(Random, NormalIsNormal) {
  Random random(11);
  std::vector<double> sample(20000);
  for (double& z : sample) z = random.normal();
  // Above 1.95 / sqrt(n) once in a thousand.
  EXPECT_LT(distance_from_normal(sample), 1.95 / std::sqrt(20000.0));
}

TEST(Random, LogAndExpAgreeWithTheLibrary) {
  Random random(3);
  for (int i = 0; i < 20000; ++i) {
    const double x =
        std::ldexp(1.0 + random.uniform(), static_cast<int>(random.next() % 200) - 100);
    const double log_x = std::log(x);
    ASSERT_NEAR(portable_log(x), log_x, 4e-16 * std::max(1.0, std::abs(log_x))) << x;
    const double y = 100.0 * (2.0 * random.uniform() - 1.0);
    ASSERT_NEAR(portable_exp(y) / std::exp(y), 1.0, 2e-14) << y;
  }
  EXPECT_EQ(portable_log(1.0), 0.0);
  EXPECT_EQ(portable_exp(0.0), 1.0);
}

TEST(Random, KeysDependOnEverything) {
  std::set<std::uint64_t> keys;
  for (const char* name : {"", "a", "b", "ab", "ba"}) {
    for (std::uint64_t seed = 0; seed < 200; ++seed) keys.insert(mixed(mixed(0, seed), name));
  }
  EXPECT_EQ(keys.size(), 1000U);
}

}  // namespace
}  // namespace edda::random_test
