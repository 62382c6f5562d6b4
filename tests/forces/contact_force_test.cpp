#include "forces/contact_forces.hpp"

#include <gtest/gtest.h>

#include <array>
#include <random>

#include "contacts/gap.hpp"
#include "forces/elastic.hpp"

namespace edda::contact_force_test {
namespace {

struct Points {
  Vec2 p1, p2, p3;
};

double normal_energy(const Points& p, double kn) {
  const double d = gap_to(edge_frame(p.p2, p.p3), p.p1).depth;
  return 0.5 * kn * d * d;
}

double shear_energy(const Points& p, double ks, double anchor) {
  const EdgeFrame e = edge_frame(p.p2, p.p3);
  const double s = gap_to(e, p.p1).foot - anchor * e.length;
  return 0.5 * ks * s * s;
}

/// Minus the gradient by central differences.
template <class Energy>
std::array<Vec2, 3> descent(Points p, Energy energy) {
  std::array<Vec2, 3> f;
  const double h = 1e-6;
  Vec2* points[3] = {&p.p1, &p.p2, &p.p3};
  for (std::size_t k = 0; k < 3; ++k) {
    for (double Vec2::*c : {&Vec2::x, &Vec2::y}) {
      const double kept = points[k]->*c;
      points[k]->*c = kept + h;
      const double up = energy(p);
      points[k]->*c = kept - h;
      const double down = energy(p);
      points[k]->*c = kept;
      f[k].*c = -(up - down) / (2.0 * h);
    }
  }
  return f;
}

TEST(ContactForce, IsTheGradientOfTheSprings) {
  std::mt19937 rng(5);
  std::uniform_real_distribution<double> u(-1.0, 1.0);
  for (int trial = 0; trial < 200; ++trial) {
    const Points p{{u(rng), u(rng)}, {u(rng) - 1.5, u(rng)}, {u(rng) + 1.5, u(rng)}};
    const EdgeFrame e = edge_frame(p.p2, p.p3);
    const Gap gap = gap_to(e, p.p1);
    const double kn = 3.0, ks = 2.0, anchor = 0.3 + 0.2 * u(rng);
    const double slip = gap.foot - anchor * e.length;
    const ContactForce f =
        contact_force(e.t, e.length, gap.foot, gap.depth, anchor, kn * gap.depth, -ks * slip);
    const auto expected = descent(
        p, [&](const Points& q) { return normal_energy(q, kn) + shear_energy(q, ks, anchor); });
    for (const auto& [got, want] : {std::pair{f.f1, expected[0]}, std::pair{f.f2, expected[1]},
                                    std::pair{f.f3, expected[2]}}) {
      EXPECT_NEAR(got.x, want.x, 1e-7);
      EXPECT_NEAR(got.y, want.y, 1e-7);
    }
    // No resultant, no moment.
    EXPECT_NEAR(norm(f.f1 + f.f2 + f.f3), 0.0, 1e-13);
    EXPECT_NEAR(cross(p.p1, f.f1) + cross(p.p2, f.f2) + cross(p.p3, f.f3), 0.0, 1e-12);
  }
}

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
}  // namespace edda::contact_force_test
