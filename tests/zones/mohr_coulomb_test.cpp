// Returns to Mohr and Coulomb's planes and the tension cut-off.
#include "zones/mohr_coulomb.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

namespace edda::mohr_coulomb_test {
namespace {

constexpr double degree = std::numbers::pi / 180.0;
constexpr IsotropicElasticity rock{6e9, 4e9};

MohrCoulomb law(double phi, double psi, double c, double t) {
  return {phi * degree, psi * degree, c, t};
}
double largest_excess(const MohrCoulomb& m, Principal s) {
  std::sort(s.begin(), s.end(), std::greater<>{});
  double most = -1e300;
  for (const YieldPlane& p : yield_planes(m)) most = std::max(most, dot(p.normal, s) - p.limit);
  return most;
}
Principal random_stress(std::mt19937& rng, double size) {
  std::normal_distribution<double> normal(0.0, size);
  return {normal(rng), normal(rng), normal(rng)};
}

/// Inside nothing happens; outside the stress is brought to the surface.
TEST(MohrCoulomb, StressesAreAdmissible) {
  std::mt19937 rng(1);
  int elastic = 0, edges = 0, corners = 0;
  for (const MohrCoulomb& m : {law(30, 0, 3e6, 1e6), law(30, 30, 3e6, 1e6), law(45, 10, 1e5, 0.0),
                               law(0, 0, 2e6, 1e7), law(20, 5, 5e6, 1e9)}) {
    for (int n = 0; n < 40000; ++n) {
      const Principal trial = random_stress(rng, 2e7);
      const ReturnedStress r = return_to(m, rock, trial);
      const double excess = largest_excess(m, trial);
      if (excess <= 0.0) {
        EXPECT_EQ(r.count, 0u);
        EXPECT_EQ(r.stress, trial);
        ++elastic;
        continue;
      }
      ASSERT_GT(r.count, 0u) << n;
      edges += r.count == 2;
      corners += r.count == 3;
      EXPECT_NEAR(largest_excess(m, r.stress), 0.0, 1e-4) << n;
      // What was elastic in the trial is elastic now or plastic.
      const Principal relaxed = rock.stress(r.plastic);
      for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(r.stress[k] + relaxed[k], trial[k], 1e-5);
      // The stresses keep their order, and plastic work is not negative.
      for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t j = 0; j < 3; ++j) {
          if (trial[i] > trial[j]) {
            EXPECT_GE(r.stress[i] - r.stress[j], -1e-5);
          }
        }
      }
      EXPECT_GE(dot(r.stress, r.plastic), -1e-6) << n;
      const ReturnedStress again = return_to(m, rock, r.stress);
      for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(again.stress[k], r.stress[k], 1e-4);
    }
  }
  EXPECT_GT(elastic, 1000);
  EXPECT_GT(edges, 1000);
  EXPECT_GT(corners, 1000);
}

/// With associated flow the return is the nearest point in the norm of C^-1: no admissible stress
/// is nearer.
TEST(MohrCoulomb, AssociatedFlowFindsTheNearestPoint) {
  std::mt19937 rng(2);
  const MohrCoulomb m = law(35, 35, 2e6, 5e5);
  const double lambda = rock.lambda, mu = rock.mu;
  const auto square = [&](const Principal& a, const Principal& b) {
    const Principal d{a[0] - b[0], a[1] - b[1], a[2] - b[2]};
    const double trace = d[0] + d[1] + d[2];
    return (dot(d, d) - lambda / (3.0 * lambda + 2.0 * mu) * trace * trace) / (2.0 * mu);
  };
  for (int n = 0; n < 300; ++n) {
    const Principal trial = random_stress(rng, 1e7);
    const ReturnedStress r = return_to(m, rock, trial);
    if (r.count == 0) continue;
    const double found = square(trial, r.stress);
    for (int k = 0; k < 300; ++k) {
      Principal other = random_stress(rng, k % 2 == 0 ? 1e7 : 1e5);
      for (std::size_t i = 0; k % 2 == 1 && i < 3; ++i) other[i] += r.stress[i];
      if (largest_excess(m, other) <= 0.0) {
        EXPECT_GE(square(trial, other), found * (1.0 - 1e-9));
      }
    }
  }
}

/// Uniaxial strength 2 c cos phi/(1 - sin phi), triaxial by the factor (1 + sin)/(1 - sin), tension
/// T.
TEST(MohrCoulomb, HasItsStrengths) {
  const MohrCoulomb m = law(30, 0, 3e6, 1e6);
  const double sine = 0.5, uniaxial = 2.0 * 3e6 * std::cos(30 * degree) / (1.0 - sine);
  for (const double side : {0.0, -2e6}) {
    const double strength = -uniaxial + side * (1.0 + sine) / (1.0 - sine);
    EXPECT_EQ(return_to(m, rock, {side, 0.999 * strength, side}).count, 0u);
    EXPECT_GT(return_to(m, rock, {side, 1.001 * strength, side}).count, 0u);
  }
  EXPECT_NEAR(return_to(m, rock, {5e6, 0.0, 0.0}).stress[0], 1e6, 1.0);
}

/// Dilation: the plastic volume strain over the largest shear strain is sin psi.
TEST(MohrCoulomb, DilatesByPsi) {
  const MohrCoulomb m = law(30, 12, 3e6, 1e6);
  const ReturnedStress r = return_to(m, rock, {-1e6, -8e6, -3e7});
  ASSERT_EQ(r.count, 1u);
  const double volume = r.plastic[0] + r.plastic[1] + r.plastic[2],
               shear = r.plastic[0] - r.plastic[2];
  EXPECT_NEAR(volume / shear, std::sin(12 * degree), 1e-12);
}

}  // namespace
}  // namespace edda::mohr_coulomb_test
