#include "step/faces_now.hpp"
#include "verification/models.hpp"

namespace edda::sliding_test {
namespace {

class Ramp : public ::testing::TestWithParam<std::pair<double, double>> {};

/// Where friction balances nearly all of the driving force, the error of the sudden start is a
/// larger fraction of the slide.
double more_for_friction(double alpha, double phi) {
  return phi > 19.0 ? std::tan(radians(alpha)) / (std::tan(radians(alpha)) - std::tan(radians(phi)))
                    : 1.0;
}

TEST_P(Ramp, SlidesAsAnalytic) {
  const auto [alpha, phi] = GetParam();
  for (const auto& [young, bound] : {std::pair{"200e6", 2.5e-2}, std::pair{"20e9", 3e-3}}) {
    Simulation sim = scene(ramp(alpha, phi, young));
    EXPECT_LT(expect_slides(sim, 1, ramp_label(alpha, phi, young), alpha, phi,
                            bound * more_for_friction(alpha, phi)),
              1e-5);
  }
}

INSTANTIATE_TEST_SUITE_P(PaperPairs, Ramp,
                         ::testing::Values(std::pair{30.0, 10.0}, std::pair{30.0, 15.0},
                                           std::pair{45.0, 10.0}, std::pair{45.0, 15.0}));
INSTANTIATE_TEST_SUITE_P(RoughRock, Ramp,
                         ::testing::Values(std::pair{30.0, 20.0}, std::pair{30.0, 25.0},
                                           std::pair{45.0, 30.0}, std::pair{45.0, 35.0},
                                           std::pair{45.0, 40.0}, std::pair{55.0, 45.0}));

/// Slides on ten pieces. Returns the largest sum of normal forces over its static value.
double press_in_ten_pieces(double alpha, double phi, const std::string& label,
                           const std::string& solver) {
  Simulation sim = scene(ramp(alpha, phi, "20e9", 10, solver));
  const double weight = 2.0 * 2750.0 * 9.8 * std::cos(radians(alpha));
  Series pressing(17, "normal forces, " + label, {"time", "computed"});
  double largest = 0.0;
  const double bound = 3e-3 * more_for_friction(alpha, phi);
  const double error = expect_slides(sim, 17, label, alpha, phi, bound, [&](Simulation& s) {
    double sum = 0.0;
    for (std::size_t k = 0; k < s.motion.contacts.size(); ++k) sum += normal_force(face_row(s, k));
    pressing.add({s.motion.state.time, sum / weight});
    largest = std::max(largest, sum / weight);
  });
  EXPECT_LT(error, 1e-5);
  return largest;
}

/// Row 17: the same ramp cut into ten blocks, with no jump of force at their boundaries.
TEST(RampInTenPieces, SlidesAsOne) {
  for (const auto& [alpha, phi] :
       {std::pair{30.0, 10.0}, std::pair{30.0, 15.0}, std::pair{45.0, 10.0}, std::pair{45.0, 15.0},
        std::pair{30.0, 20.0}, std::pair{30.0, 25.0}, std::pair{45.0, 30.0},
        std::pair{45.0, 40.0}}) {
    for (const auto& [how, solver] :
         {std::pair{"", ""},
          std::pair{", contact damping 0.02", "damping = { contact = 0.02 }\n"}}) {
      const std::string label = ramp_label(alpha, phi, "20e9") + how;
      const double largest = press_in_ten_pieces(alpha, phi, label, solver);
      expect_at_most({17, label, "largest sum N over W cos a", ""}, largest, 2.1);
    }
  }
}

}  // namespace
}  // namespace edda::sliding_test
