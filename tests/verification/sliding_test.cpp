#include "verification/models.hpp"

namespace edda {
namespace {

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
