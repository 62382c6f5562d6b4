#include "verification/scene.hpp"

namespace edda {
namespace {

/// validation.md row 1: the paper's ramp; pieces > 1 cuts the ramp itself into that many blocks
/// (row 17).
std::string ramp(double alpha, double phi, const std::string& young, int pieces = 1) {
  std::string toml = "gravity = [0.0, -9.8]\n[materials.rock]\ndensity = 2750.0\nyoung = " + young +
                     "\npoisson = 0.25\n[joints.ramp]\nfriction_angle = " + number(phi) +
                     "\n[solver]\nduration = 0.1\n[output]\nhistory_every = 0.001\n";
  auto box = [&](double u0, double u1, double v0, double v1) {
    return "[" + on_slope(alpha, u0, v0) + "," + on_slope(alpha, u1, v0) + "," +
           on_slope(alpha, u1, v1) + "," + on_slope(alpha, u0, v1) + "]";
  };
  const double from = -4.0, to = 6.0;
  for (int p = 0; p < pieces; ++p) {
    const double a = from + (to - from) * p / pieces, b = from + (to - from) * (p + 1) / pieces;
    toml += "[[block]]\nname = 'ramp" + std::to_string(p) +
            "'\nfixed = true\npolygon = " + box(a, b, -1.0, 0.0) + "\n";
  }
  toml += "[[block]]\nname = 'slider'\npolygon = " + box(0.0, 2.0, 0.0, 1.0) + "\n";
  return toml;
}

double sliding(double alpha, double phi, double t) {
  const double a = radians(alpha);
  return 0.5 * 9.8 * t * t * (std::sin(a) - std::tan(radians(phi)) * std::cos(a));
}

double slid(const Simulation& sim, double alpha) {
  const Vec2 u = displacement(sim, sim.blocks.size() - 1);
  return u.x * std::cos(radians(alpha)) - u.y * std::sin(radians(alpha));
}

class Ramp : public testing::TestWithParam<std::pair<double, double>> {};

TEST_P(Ramp, SlidesAsAnalytic) {
  const auto [alpha, phi] = GetParam();
  for (const auto& [young, bound] : {std::pair{"200e6", 2e-2}, std::pair{"20e9", 2e-3}}) {
    Simulation sim = scene(ramp(alpha, phi, young));
    double drift = 0.0;
    run(sim, [&](Simulation& s) { drift = std::max(drift, std::abs(s.ledger().drift)); });
    const double exact = sliding(alpha, phi, 0.1);
    RecordProperty(std::string("error_") + young, number(slid(sim, alpha) / exact - 1.0));
    EXPECT_NEAR(slid(sim, alpha) / exact, 1.0, bound) << young;
    EXPECT_LT(drift, 1e-5);
  }
}

INSTANTIATE_TEST_SUITE_P(PaperPairs, Ramp,
                         testing::Values(std::pair{30.0, 10.0}, std::pair{30.0, 15.0},
                                         std::pair{45.0, 10.0}, std::pair{45.0, 15.0}));

/// Row 17: the same ramp cut into ten blocks, none of whose seams may kick.
TEST(RampInTenPieces, SlidesAsOne) {
  for (const auto& [alpha, phi] : {std::pair{30.0, 15.0}}) {
    Simulation sim = scene(ramp(alpha, phi, "20e9", 10));
    const double weight = 2.0 * 2750.0 * 9.8 * std::cos(radians(alpha));
    double drift = 0.0, largest = 0.0;
    run(
        sim, [&](Simulation& s) { drift = std::max(drift, std::abs(s.ledger().drift)); },
        [&](Simulation& s) {
          double sum = 0.0;
          for (std::size_t k = 0; k < s.contacts.size(); ++k) {
            sum += s.contacts.share[k] * s.contacts.alpha[k] * s.contacts.normal[k];
          }
          largest = std::max(largest, sum / weight);
        });
    const double exact = sliding(alpha, phi, 0.1);
    RecordProperty("error", number(slid(sim, alpha) / exact - 1.0));
    RecordProperty("largest_normal", number(largest));
    EXPECT_NEAR(slid(sim, alpha) / exact, 1.0, 2e-3);
    EXPECT_LE(largest, 2.1);
    EXPECT_LT(drift, 1e-5);
  }
}

}  // namespace
}  // namespace edda
