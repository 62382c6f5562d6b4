// Returns to Hoek and Brown's surface.
#include "zones/hoek_brown.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

namespace edda::hoek_brown_test {
namespace {

constexpr IsotropicElasticity elastic{6e9, 4e9};

double excess(const HoekBrown& r, Principal s) {
  std::sort(s.begin(), s.end(), std::greater<>{});
  const double cut = std::min(r.tension, r.s * r.strength / r.m);
  return std::max(s[0] - cut, distance_from_yield(r, s[0], s[2]));
}

/// s3 - s1 at yield, by the criterion itself.
double distance_at_zero(const HoekBrown& r, double s1) {
  return -r.strength * std::pow(std::max(r.s - r.m * s1 / r.strength, 0.0), r.a);
}

TEST(HoekBrown, StressesAreAdmissible) {
  std::mt19937 rng(1);
  int yielded = 0, edges = 0;
  for (const HoekBrown& r :
       {HoekBrown{30e6, 2.0, 0.004, 0.5, 0.0, 1e9}, HoekBrown{75e6, 10.0, 1.0, 0.5, 0.2, 1e9},
        HoekBrown{20e6, 0.6, 0.0005, 0.52, 0.0, 0.0}}) {
    std::normal_distribution<double> any(0.0, 0.5 * r.strength);
    for (int n = 0; n < 30000; ++n) {
      const Principal trial{any(rng), any(rng), any(rng)};
      const ReturnedStress s = return_to(r, elastic, trial);
      if (excess(r, trial) <= 0.0) {
        EXPECT_EQ(s.count, 0u);
        continue;
      }
      ++yielded;
      edges += s.count > 1;
      ASSERT_NEAR(excess(r, s.stress), 0.0, 1e-8 * r.strength)
          << n << ' ' << trial[0] << ' ' << trial[1] << ' ' << trial[2];
      const Principal relaxed = elastic.stress(s.plastic);
      for (std::size_t k = 0; k < 3; ++k)
        EXPECT_NEAR(s.stress[k] + relaxed[k], trial[k], 1e-9 * r.strength);
      EXPECT_GE(dot(s.stress, s.plastic), -1e-9 * r.strength);
    }
  }
  EXPECT_GT(yielded, 10000);
  EXPECT_GT(edges, 1000);
}

/// sigma_1 = sigma_3 + sigma_ci (m sigma_3/sigma_ci + s)^a in compression.
TEST(HoekBrown, HasItsTriaxialStrength) {
  const HoekBrown r{75e6, 10.0, 1.0, 0.5, 0.0, 1e9};
  for (const double side : {0.0, 5e6, 20e6}) {
    const double strength = side + 75e6 * std::sqrt(10.0 * side / 75e6 + 1.0);
    EXPECT_EQ(return_to(r, elastic, {-side, -0.999 * strength, -side}).count, 0u);
    EXPECT_GT(return_to(r, elastic, {-side, -1.001 * strength, -side}).count, 0u);
  }
  EXPECT_NEAR(return_to(r, elastic, {20e6, 20e6, 20e6}).stress[0], 7.5e6, 1e3);
}

/// A factor divides the envelope in Mohr's plane: circles of stresses that have returned touch it.
TEST(HoekBrown, AFactorDividesItsShearStrength) {
  HoekBrown whole{30e6, 2.0, 0.004, 0.52, 0.1, 1e9}, r = whole;
  for (const double factor : {0.6, 1.3, 2.5}) {
    r.factor = factor;
    for (const double side : {0.0, 1e6, 1e7}) {
      const Principal s = return_to(r, elastic, {-side, -side - 9e7, -side}).stress;
      ASSERT_NEAR(s[0] - s[2], 0.0, 1.0);
      const double centre = 0.5 * (s[0] + s[1]), radius = 0.5 * (s[0] - s[1]);
      // Shear stress of the circle, times the factor, beyond those of all circles at yield.
      double most = -1e9;
      for (int n = 1; n < 400; ++n) {
        const double angle = n * std::numbers::pi / 400.0,
                     normal = centre + radius * std::cos(angle);
        double envelope = 0.0;
        for (int k = 0; k < 2400; ++k) {
          const double t = 6e4 - 100.0 * (std::pow(1.006, k) - 1.0),
                       half = 0.5 * -distance_at_zero(whole, t);
          const double away = normal - (t - half);
          if (std::abs(away) < half)
            envelope = std::max(envelope, std::sqrt(half * half - away * away));
        }
        most = std::max(most, factor * radius * std::sin(angle) - envelope);
      }
      EXPECT_NEAR(most / (factor * radius), 0.0, 2e-3) << factor << ' ' << side;
    }
  }
}

/// Rock of a geological strength index of 50, mi = 10 (Hoek, Carranza-Torres and Corkum 2002).
TEST(HoekBrown, ConstantsOfARockMass) {
  const HoekBrownConstants c = hoek_brown_constants(50.0, 10.0, 0.0);
  EXPECT_NEAR(c.m, 1.677, 1e-3);
  EXPECT_NEAR(c.s, 0.00387, 1e-5);
  EXPECT_NEAR(c.a, 0.5057, 1e-4);
}

}  // namespace
}  // namespace edda::hoek_brown_test
