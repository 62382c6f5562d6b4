// The factor of strength against known answers, and how many programs it takes.
#include "limit/limit_factor.hpp"

#include <gtest/gtest.h>

#include "limit/rigid_model.hpp"

namespace edda::limit_factor_test {
namespace {

using testing::Rigid;
using testing::stone;

/// A plane with this sine of its slope, and what its joint has.
struct Plane {
  double sine, cosine, mu, cohesion;
};

/// A block of 8 m by 1 m on a plane.
std::string block_on(const Plane& plane) {
  const auto at = [sine = plane.sine, cosine = plane.cosine](double along, double up) {
    return fmt::format("[{:.15g}, {:.15g}]", along * cosine - up * sine,
                       along * sine + up * cosine);
  };
  return stone(plane.mu, fmt::format("cohesion = {}\n", plane.cohesion)) +
         fmt::format("[[block]]\nfixed = true\npolygon = [{}, {}, {}, {}]\n", at(-5, -1), at(5, -1),
                     at(5, 0), at(-5, 0)) +
         fmt::format("[[block]]\npolygon = [{}, {}, {}, {}]\n", at(-4, 0), at(4, 0), at(4, 1),
                     at(-4, 1));
}

/// F = (c L + W cos(a) tan(phi))/(W sin(a)), from wherever the search begins.
TEST(LimitFactor, OfABlockOnAPlaneTakesFewPrograms) {
  const double weight = 2000.0 * 9.81 * 8.0;
  int of_all = 0;
  for (const Plane& plane : {Plane{0.6, 0.8, 0.5, 1e3},
                             {0.6, 0.8, 0.9, 0.0},
                             {0.6, 0.8, 0.0, 3e4},
                             {0.96, 0.28, 0.3, 2e4},
                             {0.96, 0.28, 0.3, 1e6}}) {
    const Rigid model(block_on(plane));
    const double exact =
        (plane.cohesion * 8.0 + weight * plane.cosine * plane.mu) / (weight * plane.sine);
    const std::vector<char> all(model.blocks.joints.size(), 1);
    constexpr double tolerance = 1e-6;
    for (const double first : {0.1, 0.5, 0.999 * exact, exact, 1.001 * exact, 1.0, 3.0, 20.0}) {
      int programs = 0;
      const auto strength_at = [&](double factor) {
        ++programs;
        return model.strength(factor);
      };
      const StrengthFactor f = strength_factor(model.problem, all, strength_at, tolerance, first);
      ASSERT_EQ(f.end, LimitEnd::found) << exact << " from " << first;
      EXPECT_LE(f.holds, exact * (1.0 + tolerance)) << first;
      EXPECT_GE(f.fails, exact * (1.0 - tolerance)) << first;
      EXPECT_LE(f.fails - f.holds, tolerance * f.fails) << first;
      EXPECT_LE(programs, 8) << exact << " from " << first;
      of_all += programs;
    }
  }
  EXPECT_LE(of_all, 160);
}

}  // namespace
}  // namespace edda::limit_factor_test
