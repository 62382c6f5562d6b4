#include "forces/elastic.hpp"

#include <gtest/gtest.h>

#include <random>

namespace edda::elastic_test {
namespace {

TEST(Piola, IsTheGradientOfTheEnergy) {
  std::mt19937 rng(6);
  std::uniform_real_distribution<double> u(-1.0, 1.0);
  const double lambda = 1.3, mu = 0.7, h = 1e-6;
  auto energy = [&](const Deformation& f) {
    const Tensor e = corotated_strain(f, rotation(f));
    return strain_energy(e, e, 1.0, lambda, mu);
  };
  for (int trial = 0; trial < 200; ++trial) {
    const double a = 3.0 * u(rng);
    Deformation f{std::cos(a) + 0.2 * u(rng), -std::sin(a) + 0.2 * u(rng),
                  std::sin(a) + 0.2 * u(rng), std::cos(a) + 0.2 * u(rng)};
    const PiolaStress p = piola(f, rotation(f), lambda, mu);
    const double got[4] = {p.xx, p.xy, p.yx, p.yy};
    double* entries[4] = {&f.xx, &f.xy, &f.yx, &f.yy};
    for (int k = 0; k < 4; ++k) {
      const double kept = *entries[k];
      *entries[k] = kept + h;
      const double up = energy(f);
      *entries[k] = kept - h;
      const double down = energy(f);
      *entries[k] = kept;
      EXPECT_NEAR(got[k], (up - down) / (2.0 * h), 1e-8);
    }
  }
}

TEST(Piola, RotationMakesNoStress) {
  for (double a = -3.0; a < 3.1; a += 0.1) {
    const Deformation f{std::cos(a), -std::sin(a), std::sin(a), std::cos(a)};
    const PiolaStress p = piola(f, rotation(f), 1e9, 1e9);
    EXPECT_NEAR(std::abs(p.xx) + std::abs(p.xy) + std::abs(p.yx) + std::abs(p.yy), 0.0, 2e-6);
  }
}

}  // namespace
}  // namespace edda::elastic_test
