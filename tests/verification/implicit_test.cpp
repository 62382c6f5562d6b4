// The implicit method: validation.md rows 1, 4, 9 and 13, and that it agrees with the explicit one.
#include <string>
#include <utility>

#include "verification/implicit_models.hpp"
#include "verification/models.hpp"

namespace edda::implicit_test {
namespace {

class ImplicitRamp : public testing::TestWithParam<std::pair<double, double>> {};

/// Row 1.
TEST_P(ImplicitRamp, SlidesAsAnalytic) {
  const auto [alpha, phi] = GetParam();
  for (const auto& [young, bound] : {std::pair{"200e6", 2e-2}, std::pair{"20e9", 2e-3}}) {
    Simulation sim = scene(ramp(alpha, phi, young, 1, dda(1e-4)));
    const std::string label = ramp_label(alpha, phi, young) + ", implicit";
    EXPECT_LT(expect_slides(sim, 1, label, alpha, phi, bound), 1e-4);
    EXPECT_EQ(sim.accounts.steps.redone, 0u);
  }
}

INSTANTIATE_TEST_SUITE_P(PaperPairs, ImplicitRamp,
                         testing::Values(std::pair{30.0, 10.0}, std::pair{30.0, 15.0},
                                         std::pair{45.0, 10.0}, std::pair{45.0, 15.0}));

/// Row 9, by its own damping, by mass damping, and without dynamics.
TEST(ImplicitColumn, StressAndSettlement) {
  for (const auto& [label, how] :
       {std::pair{"implicit, static", "dynamic = false\ntime_step = 0.1\n"},
        std::pair{"implicit, mass damping", "damping = { mass = 20.0 }\ntime_step = 0.01\n"},
        std::pair{"implicit, its own damping", "time_step = 0.05\n"}}) {
    Simulation sim = scene(column(std::string("method = 'dda'\nduration = 3.0\n") + how));
    run(sim, [](Simulation&) {});
    expect_at_rest(sim, label);
  }
}

/// Row 13.
TEST(ImplicitArch, StandsAndFalls) {
  for (const auto& [ratio, stands] : {std::pair{0.112, true}, std::pair{0.100, false}}) {
    Simulation sim = scene(arch(ratio, "duration = 4.0\n" + dda(2e-3)));
    expect_arch(ratio, stands, sim, ", implicit");
  }
}

/// Row 4: bonds carry and break in the implicit method, too.
TEST(ImplicitBond, HoldsAboveAndGoesBelowTheCriticalCohesion) {
  for (const auto& [factor, holds] : {std::pair{1.01, true}, std::pair{0.99, false}}) {
    std::string toml = ramp(30.0, 15.0, "20e9", 1, "dynamic = false\n" + dda(1e-4));
    const std::string law = "friction_angle = 15";
    const auto at = toml.find(law);
    ASSERT_NE(at, std::string::npos);
    toml.replace(at, law.size(), "cohesion = " + number(7221.2 * factor) + "\n" + law);
    Simulation sim = scene(toml);
    run(sim, [](Simulation&) {});
    EXPECT_EQ(bonded_faces(sim), holds ? 1u : 0u);
    if (holds) {
      EXPECT_LT(slip_so_far(sim, 30.0), 1e-5);
    } else {
      EXPECT_GT(account_energy(sim).fracture, 0.0);
    }
  }
}

/// The explicit and the implicit method agree on a smooth problem as the steps shrink.
TEST(ImplicitAndExplicit, AgreeAtSmallSteps) {
  Simulation a = scene(ramp(30.0, 15.0, "200e6", 1, "time_step = 5e-6\n"));
  Simulation b = scene(ramp(30.0, 15.0, "200e6", 1, dda(5e-6)));
  run(a, [](Simulation&) {});
  run(b, [](Simulation&) {});
  EXPECT_NEAR(slip_so_far(a, 30.0) / slip_so_far(b, 30.0), 1.0, 2e-3);
}

}  // namespace
}  // namespace edda::implicit_test
