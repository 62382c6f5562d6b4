#include "observe/overstress.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "model/read_model.hpp"
#include "observe/summary.hpp"
#include "run/run_model.hpp"

namespace edda::overstress_test {
namespace {

constexpr RockStrength rock{90e6, 6e6};

TEST(Utilisation, IsOneAtBothStrengths) {
  EXPECT_NEAR(utilisation(rock, {-90e6, 0.0, 0.0, 0.0}), 1.0, 1e-12);
  EXPECT_NEAR(utilisation(rock, {0.0, -45e6, 0.0, 0.0}), 0.5, 1e-12);
  EXPECT_NEAR(utilisation(rock, {6e6, 0.0, 0.0, 0.0}), 1.0, 1e-12);
  EXPECT_NEAR(utilisation(rock, {0.0, 0.0, 6e6, 0.0}), 1.0, 1e-12);
  EXPECT_EQ(utilisation(rock, {0.0, 0.0, 0.0, 0.0}), 0.0);
  EXPECT_NEAR(utilisation(rock, {-50e6, -50e6, -50e6, 0.0}), 0.0, 1e-12);
}

/// On the curve of Hoek and Brown for any confinement, and in proportion to the stress.
TEST(Utilisation, IsOneOnTheCurve) {
  const double m = 90.0 / 6.0 - 6.0 / 90.0;
  for (const double least : {-4e6, 1e6, 5e6, 20e6, 60e6}) {
    const double largest = least + 90e6 * std::sqrt(m * least / 90e6 + 1.0);
    const BlockStress s{-largest, -least, -0.5 * (least + largest), 0.0};
    EXPECT_NEAR(utilisation(rock, s), 1.0, 1e-12) << least;
    EXPECT_NEAR(utilisation(rock, {0.3 * s.xx, 0.3 * s.yy, 0.3 * s.zz, 0.0}), 0.3, 1e-12);
  }
}

TEST(Utilisation, DoesNotDependOnTheAxes) {
  const double a = 0.7, c = std::cos(a), s = std::sin(a), p = -70e6, q = -3e6;
  const BlockStress turned{p * c * c + q * s * s, p * s * s + q * c * c, -20e6, (p - q) * c * s};
  EXPECT_NEAR(utilisation(rock, turned), utilisation(rock, {p, q, -20e6, 0.0}), 1e-12);
}

TEST(Overstress, OfABlockByItsMaterial) {
  const std::string text = R"(
gravity = [0, 0]
[materials.hard]
density = 2700
young = 2e10
poisson = 0.25
strength = { ucs = "50 MPa", tension = "5 MPa" }
[materials.other]
density = 2700
young = 2e10
poisson = 0.25
[joints.j]
friction_angle = 30
[[block]]
material = "hard"
polygon = [[0, 0], [1, 0], [1, 1], [0, 1]]
[[block]]
material = "other"
polygon = [[1, 0], [2, 0], [2, 1], [1, 1]]
[initial_stress]
stress = [-20e6, -60e6, 0]
k0_out = 0.5
[[boundary]]
sides = ["left", "right", "top", "bottom"]
[solver]
duration = 1e-5
)";
  Result<Model> model = read_model_text(text, "m.toml", {});
  ASSERT_TRUE(model.ok()) << to_string(model.faults()[0]);
  Result<PreparedRun> run = prepare_run(std::move(model.value()));
  ASSERT_TRUE(run.ok());
  const Simulation& sim = run.value().sim;
  const RockStrength hard{50e6, 5e6};
  EXPECT_NEAR(overstress(sim, sim.motion.state, 0), utilisation(hard, {-20e6, -60e6, -30e6, 0.0}),
              1e-9);
  EXPECT_EQ(overstress(sim, sim.motion.state, 1), 0.0);
  Outcome outcome;
  bool found = false;
  for (const Check& c : checks_of(sim, outcome)) {
    if (c.name != "largest part of the rock's strength used in a block") continue;
    found = true;
    EXPECT_NEAR(c.value, overstress(sim, sim.motion.state, 0), 1e-12);
    EXPECT_EQ(c.pass, c.value <= 1.0);
  }
  EXPECT_TRUE(found);
}

}  // namespace
}  // namespace edda::overstress_test
