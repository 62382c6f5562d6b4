// What an initial stress adds to a block's forces is the gradient of an energy, and makes no
// torque.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "forces/elastic.hpp"

namespace edda::initial_stress_test {
namespace {

constexpr double lambda = 8e9, mu = 6e9, volume = 1.7;

Deformation random_deformation(std::mt19937& chance) {
  std::uniform_real_distribution<double> some(-0.2, 0.2);
  const double a = 3.0 * some(chance), c = std::cos(a), s = std::sin(a);
  const Deformation u{1.0 + some(chance), some(chance), some(chance), 1.0 + some(chance)};
  return {c * u.xx - s * u.yx, c * u.xy - s * u.yy, s * u.xx + c * u.yx, s * u.xy + c * u.yy};
}

TEST(InitialStressForce, IsTheGradientOfItsEnergy) {
  std::mt19937 chance(5);
  const Tensor s{-3e6, -2e6, 0.7e6};
  for (int q = 0; q < 20; ++q) {
    const Deformation f = random_deformation(chance);
    const PiolaStress p = initial_stress_term(f, s.xx, s.yy, s.xy);
    const double step = 1e-5;
    const auto slope = [&](double Deformation::*part) {
      Deformation up = f, down = f;
      up.*part += step;
      down.*part -= step;
      return (initial_energy(up, up, s, volume, lambda, mu) -
              initial_energy(down, down, s, volume, lambda, mu)) /
             (2.0 * step);
    };
    EXPECT_NEAR(slope(&Deformation::xx), volume * p.xx, 1e-3 * 1e6);
    EXPECT_NEAR(slope(&Deformation::xy), volume * p.xy, 1e-3 * 1e6);
    EXPECT_NEAR(slope(&Deformation::yx), volume * p.yx, 1e-3 * 1e6);
    EXPECT_NEAR(slope(&Deformation::yy), volume * p.yy, 1e-3 * 1e6);
    // Torque: the skew part of P F^T.
    const double skew = p.xx * f.yx + p.xy * f.yy - (p.yx * f.xx + p.yy * f.xy);
    EXPECT_NEAR(skew, 0.0, 1e-8);
  }
}

/// In the leapfrog's terms: the work of the force of step n over x_{n+1} - x_{n-1} is the change of
/// the energy between steps.
TEST(InitialStressForce, WorksWhatTheLedgerCounts) {
  std::mt19937 chance(6);
  const Tensor s{-3e6, 1e6, -0.4e6};
  for (int q = 0; q < 20; ++q) {
    const Deformation a = random_deformation(chance), b = random_deformation(chance),
                      c = random_deformation(chance);
    const PiolaStress p = initial_stress_term(b, s.xx, s.yy, s.xy);
    const double work =
        0.5 * volume *
        (p.xx * (c.xx - a.xx) + p.xy * (c.xy - a.xy) + p.yx * (c.yx - a.yx) + p.yy * (c.yy - a.yy));
    EXPECT_NEAR(
        initial_energy(b, c, s, volume, lambda, mu) - initial_energy(a, b, s, volume, lambda, mu),
        work, 1e-9 * 1e6);
  }
}

/// With the strain that undoes the stress nothing is left: at sigma = 0 the whole energy is zero.
TEST(InitialStressForce, EnergyIsThatOfTheWholeStress) {
  const Tensor s{-3e6, -1e6, 0.0};
  // eps = -C^-1 s, small.
  const double trace = s.xx + s.yy, part = lambda / (2.0 * (lambda + mu)) * trace;
  const double exx = -(s.xx - part) / (2.0 * mu), eyy = -(s.yy - part) / (2.0 * mu);
  const Deformation f{1.0 + exx, 0.0, 0.0, 1.0 + eyy}, none{1.0, 0.0, 0.0, 1.0};
  const Tensor e{exx, eyy, 0.0};
  const double start = initial_energy(none, none, s, volume, lambda, mu);
  const double end =
      strain_energy(e, e, volume, lambda, mu) + initial_energy(f, f, s, volume, lambda, mu);
  EXPECT_NEAR(start, 0.5 * volume * (s.xx * (s.xx - part) + s.yy * (s.yy - part)) / (2.0 * mu),
              1e-9 * start);
  EXPECT_NEAR(end / start, 0.0, 1e-3);
}

}  // namespace
}  // namespace edda::initial_stress_test
