// The factor of strength against known answers, and how many programs it takes.
#include "limit/limit_factor.hpp"

#include <gtest/gtest.h>

#include "limit/rigid_model.hpp"

namespace edda::limit_factor_test {
namespace {

using testing::Rigid;
using testing::stone;

constexpr double sine = 0.6, cosine = 0.8, mu = 0.5, cohesion = 1e3;

/// A block of 2 m by 1 m on a plane whose slope is 3 in 4.
std::string block_on_a_plane() {
  const auto at = [](double along, double up) {
    return fmt::format("[{:.15g}, {:.15g}]", along * cosine - up * sine,
                       along * sine + up * cosine);
  };
  return stone(mu, fmt::format("cohesion = {}\n", cohesion)) +
         fmt::format("[[block]]\nfixed = true\npolygon = [{}, {}, {}, {}]\n", at(-5, -1), at(5, -1),
                     at(5, 0), at(-5, 0)) +
         fmt::format("[[block]]\npolygon = [{}, {}, {}, {}]\n", at(-1, 0), at(1, 0), at(1, 1),
                     at(-1, 1));
}

/// F = (c L + W cos(a) tan(phi))/(W sin(a)), from wherever the search begins.
TEST(LimitFactor, OfABlockOnAPlaneTakesFewPrograms) {
  const Rigid model(block_on_a_plane());
  const double weight = 2000.0 * 9.81 * 2.0;
  const double exact = (cohesion * 2.0 + weight * cosine * mu) / (weight * sine);
  const std::vector<char> all(model.blocks.joints.size(), 1);
  constexpr double tolerance = 1e-6;
  for (const double first : {0.1, 0.5, 0.999 * exact, exact, 1.001 * exact, 1.0, 3.0, 20.0}) {
    int programs = 0;
    const auto strength_at = [&](double factor) {
      ++programs;
      return model.strength(factor);
    };
    const StrengthFactor f = strength_factor(model.problem, all, strength_at, tolerance, first);
    ASSERT_EQ(f.end, LimitEnd::found) << first;
    EXPECT_LE(f.holds, exact * (1.0 + tolerance)) << first;
    EXPECT_GE(f.fails, exact * (1.0 - tolerance)) << first;
    EXPECT_LE(f.fails - f.holds, tolerance * f.fails) << first;
    EXPECT_LE(programs, 12) << first;
  }
}

}  // namespace
}  // namespace edda::limit_factor_test
