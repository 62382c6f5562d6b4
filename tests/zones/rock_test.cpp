// The strength factor of rock: how far its stress is from its strength.
#include "zones/rock.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

namespace edda::rock_test {
namespace {

constexpr double degree = std::numbers::pi / 180.0;
constexpr IsotropicElasticity elastic{6e9, 4e9};
const ZoneMaterial coulomb = rock_that_yields(elastic, {30 * degree, 0.0, 1e6, 5e5});

using Stress = std::array<double, 4>;  // xx, yy, zz, xy

Stress turned(const Stress& s, double angle) {
  const double c = std::cos(2.0 * angle), d = std::sin(2.0 * angle), mean = 0.5 * (s[0] + s[1]),
               half = 0.5 * (s[0] - s[1]);
  const double x = half * c - s[3] * d;
  return {mean + x, mean - x, s[2], half * d + s[3] * c};
}

TEST(StrengthFactor, IsThatOfMohrsCircle) {
  const double cohesion = 1e6 * std::cos(30 * degree);
  for (const double angle : {0.0, 0.3, 2.0}) {
    const auto factor = [&](const Stress& s) {
      return strength_factor(coulomb, 0.0, turned(s, angle));
    };
    EXPECT_NEAR(factor({-2e6, -6e6, -4e6, 0.0}), (cohesion + 2e6) / 2e6, 1e-9);
    EXPECT_NEAR(factor({-4e6, -4e6, -8e6, 0.0}), (cohesion + 3e6) / 2e6, 1e-9);
    // Tension: the circle from 0 to 0.25 MPa grows until it ends at 0.5 MPa.
    EXPECT_NEAR(factor({2.5e5, 0.0, 0.0, 0.0}), 3.0, 1e-7);
  }
}

TEST(StrengthFactor, HasNoLimitWithoutStrengthOrShear) {
  EXPECT_TRUE(std::isinf(strength_factor({elastic}, 0.0, {1e6, -5e6, 0.0, 2e6})));
  EXPECT_GT(strength_factor(coulomb, 0.0, {-5e6, -5e6, -5e6, 0.0}), 1e6);
}

/// 2 R = sigma_ci sqrt(s + m (P - R)/sigma_ci) under a mean pressure P.
TEST(StrengthFactor, OfHoekAndBrownHasTheCircleThatTouches) {
  const double strength = 75e6, m = 3.43, s = 0.0205;
  const ZoneMaterial rock{elastic, HoekBrown{strength, m, s, 0.5, 0.0, 1e9}};
  for (const double pressure : {0.0, 3e6, 40e6}) {
    const double b = m * strength,
                 radius =
                     (std::sqrt(b * b + 16.0 * (s * strength * strength + b * pressure)) - b) / 8.0;
    const double deviator = 0.3e6;
    EXPECT_NEAR(strength_factor(rock, 0.0, {-pressure, -pressure, -pressure, deviator}),
                radius / deviator, 1e-8 * radius / deviator);
  }
}

/// A circle grown by the factor touches the envelope divided by F in Mohr's plane.
TEST(StrengthFactor, OfReducedHoekAndBrownReachesTheSurface) {
  HoekBrown reduced{75e6, 3.43, 0.0205, 0.5, 0.0, 1e9};
  reduced.factor = 1.4;
  const double pressure = 8e6, deviator = 1e6,
               factor = strength_factor({elastic, reduced}, 0.0,
                                        {-pressure, -pressure, -pressure, deviator}),
               radius = factor * deviator;
  EXPECT_NEAR(distance_from_yield(reduced, radius - pressure, -radius - pressure), 0.0, 1.0);
  EXPECT_LT(factor, strength_factor({elastic, HoekBrown{75e6, 3.43, 0.0205, 0.5, 0.0, 1e9}}, 0.0,
                                    {-pressure, -pressure, -pressure, deviator}));
}

/// Wherever a return ends it is 1: in shear, in tension, at edges and at the apex.
TEST(StrengthFactor, IsOneWhereRockYields) {
  std::mt19937 rng(1);
  std::normal_distribution<double> any(0.0, 2e7);
  int in_shear = 0, in_tension = 0;
  for (const auto& [rock, most] :
       {std::pair{coulomb, 1e-9},
        std::pair{rock_that_yields(elastic, {30 * degree, 10 * degree, 1e6, 0.0}), 1e-9},
        std::pair{rock_that_yields(elastic, {0.0, 0.0, 1e6, 1e9}), 1e-9},
        std::pair{ZoneMaterial{elastic, HoekBrown{30e6, 2.0, 0.004, 0.5, 0.1, 1e9}}, 1e-3}}) {
    for (int n = 0; n < 3000; ++n) {
      const ReturnedStress r = return_to(rock, 0.0, {any(rng), any(rng), any(rng)});
      if (r.count == 0) continue;
      ++(r.tensile > 0 ? in_tension : in_shear);
      const auto [first, second, third] = r.stress;
      const double factor = strength_factor(rock, 0.0, turned({first, second, third, 0.0}, 0.7));
      // At an apex the circle is a point, of which rounding decides.
      const double size = std::max({first, second, third}) - std::min({first, second, third});
      if (size > 1e3) {
        EXPECT_NEAR(factor, 1.0, most) << n << ' ' << first << ' ' << third;
      } else {
        EXPECT_LT(factor, 1.5) << n << ' ' << first << ' ' << third;
      }
    }
  }
  EXPECT_GT(in_shear, 1000);
  EXPECT_GT(in_tension, 1000);
}

TEST(StrengthFactor, FallsWithTheStrength) {
  ZoneMaterial rock = rock_that_yields(elastic, {0.0, 0.0, 1e6, 1e9});
  rock.residual = surface_of(MohrCoulomb{0.0, 0.0, 2e5, 1e9});
  rock.slip = 4e-3;
  const Stress sheared{-1e6, -1e6, -1e6, 1e5};
  EXPECT_NEAR(strength_factor(rock, 0.0, sheared), 10.0, 1e-6);
  EXPECT_NEAR(strength_factor(rock, 2e-3, sheared), 6.0, 1e-6);
  EXPECT_NEAR(strength_factor(rock, 1.0, sheared), 2.0, 1e-6);
}

/// The circle grows about its centre until the traction of the planes reaches their strength.
TEST(StrengthFactor, OfAFoliationIsThatOfItsTraction) {
  const double friction = std::tan(20 * degree);
  for (const double angle : {0.0, 0.4, 1.9}) {
    ZoneMaterial rock{elastic};
    rock.foliation = Foliation{
        {std::cos(angle), std::sin(angle)}, {}, FoliationStrength{friction, 0.0, 3e5, 1e5}};
    const auto factor = [&](const Stress& s) {
      return strength_factor(rock, 0.0, turned(s, angle));
    };
    EXPECT_NEAR(factor({-3e6, -1e6, -9e6, 2e5}), (3e5 + 2e6 * friction) / (2e5 + 1e6 * friction),
                1e-8);
    EXPECT_NEAR(factor({-1e5, 5e4, 0.0, 0.0}), 1.25e5 / 7.5e4, 1e-7);  // opens at 0.1 MPa
    // More pressed than its surroundings, and not sheared: no growth makes it slip.
    EXPECT_TRUE(std::isinf(factor({-1e6, -3e6, 0.0, 0.0})));
    // On the strength.
    EXPECT_NEAR(factor({-3e6, -1e6, 0.0, 3e5 + 1e6 * friction}), 1.0, 1e-9);
    EXPECT_NEAR(factor({-3e6, 1e5, 0.0, 1e5}), 1.0, 1e-9);
  }
}

}  // namespace
}  // namespace edda::rock_test
