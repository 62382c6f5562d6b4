// A block that slides through a bowl drawn as a polygon strikes its sides one after the other and
// loses a part of its energy in proportion to the angle between them (theory, section 9.10).
#include <algorithm>
#include <cmath>
#include <numbers>

#include "blocks/state.hpp"
#include "step/energy_balance.hpp"
#include "step/step.hpp"
#include "verification/models.hpp"

namespace edda::kink_test {
namespace {

constexpr double pi = std::numbers::pi, radius = 2.0;

std::string point(Vec2 p) {
  return "[" + number(p.x) + ", " + number(p.y) + "]";
}

/// A frictionless bowl of these kinks, degrees, and a block on the side in its middle at 25 to 30
/// degrees.
std::string bowl(double kink, double width) {
  const double step = kink * pi / 180.0;
  std::string text =
      "[materials.rock]\ndensity = 2600\nyoung = 20e9\npoisson = 0.25\n[joints.j]\nfriction_angle "
      "= "
      "0\n";
  const auto at = [&](double r, int k) {
    return Vec2{r * std::sin((k - 0.5) * step), -r * std::cos((k - 0.5) * step)};
  };
  const int sides = static_cast<int>(std::lround(50.0 / kink));
  for (int k = -sides; k <= sides; ++k) {
    text += "[[block]]\nfixed = true\npolygon = [" + point(at(radius, k)) + ", " +
            point(at(1.2 * radius, k)) + ", " + point(at(1.2 * radius, k + 1)) + ", " +
            point(at(radius, k + 1)) + "]\n";
  }
  const double tilt = -std::floor(30.0 / kink) * step, apothem = radius * std::cos(0.5 * step);
  // Not into the sides beside its own.
  const double half = 0.5 * width, lift = radius - std::sqrt(radius * radius - half * half);
  const Vec2 t{std::cos(tilt), std::sin(tilt)}, n{-t.y, t.x}, foot = (lift - apothem) * n;
  text += "[[block]]\npolygon = [" + point(foot - half * t) + ", " + point(foot + half * t) + ", " +
          point(foot + half * t + width * n) + ", " + point(foot - half * t + width * n) + "]\n";
  return text + "[solver]\nduration = 1.4\n[output]\nhistory_every = 0.01\n";
}

/// Part of its energy that the block loses on its way to the other side.
double lost(double kink) {
  Simulation sim = scene(bowl(kink, 0.1));
  const std::size_t block = sim.scene->blocks.size() - 1;
  const auto height = [&] {
    return (centroid(sim.motion.state.position, block) + sim.scene->blocks.origin).y;
  };
  const double first = height();
  double lowest = first, highest = -radius;
  bool passed = false;
  run(sim, [&](Simulation& s) {
    const Vec2 at = centroid(s.motion.state.position, block) + s.scene->blocks.origin;
    lowest = std::min(lowest, at.y);
    passed = passed || at.x > 0.0;
    if (passed) highest = std::max(highest, at.y);
  });
  const EnergyBalance balance = account_energy(sim);
  EXPECT_LT(std::abs(balance.error), 1e-3);
  EXPECT_EQ(balance.friction, 0.0);
  EXPECT_LT(std::abs(balance.transfer), 0.05 * balance.damping);
  return (first - highest) / (first - lowest);
}

TEST(Kinks, TakeEnergyInProportionToTheirAngle) {
  const double coarse = lost(10.0), fine = lost(2.5);
  EXPECT_GT(fine, 0.0);
  EXPECT_GT(coarse, 2.5 * fine);
  EXPECT_LT(coarse, 8.0 * fine);
  // Between the plastic impact of a point and twice that of a corner.
  const double angle = 60.0 * pi / 180.0, plastic = 2.0 / 3.0 * angle * 10.0 * pi / 180.0;
  EXPECT_GT(coarse, 0.7 * plastic);
  EXPECT_LT(coarse, 2.0 * plastic);
}

}  // namespace
}  // namespace edda::kink_test
