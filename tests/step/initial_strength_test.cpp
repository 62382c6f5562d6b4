// The initial stress is compared with, and cut to, the strength of a joint at the start: the peak
// strength with slip weakening, the strength at its normal stress with Barton-Bandis, and the
// strength factor of the first stage.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "contacts/face_reading.hpp"
#include "model/read_model.hpp"
#include "step/faces_now.hpp"
#include "step/simulation.hpp"

namespace edda::initial_strength_test {
namespace {

/// Two blocks of 4 m x 2 m pressed together by 2 MPa, sheared along their joint by `shear` Pa.
Simulation pressed(const std::string& joint, double shear, const std::string& more = "") {
  const std::string text = R"(
gravity = [0.0, 0.0]
[materials.rock]
density = 2700.0
young = 20e9
poisson = 0.25
[domain]
outline = [[-2, -2], [2, -2], [2, 2], [-2, 2]]
joint = "j"
[[trace]]
points = [[-2, 0], [2, 0]]
[[boundary]]
sides = ["left", "right", "bottom", "top"]
type = "fixed"
[initial_stress]
at_y = 0.0
gradient = [0.0, 0.0, 0.0]
stress = [-3e6, -2e6, )" + std::to_string(shear) +
                           "]\n[joints.j]\n" + joint + more +
                           (more.empty() ? "\n[solver]\nduration = 0.1\n" : "");
  Result<Model> model = read_model_text(text, "test.toml", {});
  EXPECT_TRUE(model.ok()) << (model.ok() ? "" : to_string(model.faults().front()));
  Result<Simulation> sim = Simulation::create(std::move(model.value()));
  EXPECT_TRUE(sim.ok());
  return std::move(sim.value());
}

bool slipped(const Simulation& sim) {
  for (std::size_t k = 0; k < sim.motion.contacts.size(); ++k) {
    if (slides(face_row(sim, k))) return true;
  }
  return false;
}

double tangent(double degrees) {
  return std::tan(degrees * std::numbers::pi / 180.0);
}

const std::string weakening =
    "type = 'slip-weakening'\nfriction_angle = 40.0\nslip_distance = 0.01\n"
    "residual = { friction_angle = 20.0 }\n";

TEST(InitialStrength, ThatOfThePeakWhereAJointWeakens) {
  const Simulation holds = pressed(weakening, 2e6 * tangent(30.0));
  ASSERT_TRUE(holds.accounts.initial);
  EXPECT_EQ(holds.accounts.initial->joints[0].over, 0.0);
  EXPECT_NEAR(holds.accounts.initial->joints[0].mobilised, tangent(30.0) / tangent(40.0), 1e-12);
  EXPECT_FALSE(slipped(holds));
  const Simulation fails = pressed(weakening, 2e6 * tangent(41.0));
  EXPECT_NEAR(fails.accounts.initial->joints[0].over, 4.0, 1e-9);
  EXPECT_TRUE(slipped(fails));
}

// phi = 25 + 10 log10(20/2) = 35 degrees.
TEST(InitialStrength, ThatOfItsNormalStressByBartonAndBandis) {
  const std::string rough =
      "type = 'barton-bandis'\njrc = 10.0\njcs = 20e6\nresidual_angle = 25.0\n";
  const Simulation holds = pressed(rough, 2e6 * tangent(34.9));
  EXPECT_EQ(holds.accounts.initial->joints[0].over, 0.0);
  EXPECT_NEAR(holds.accounts.initial->joints[0].mobilised, tangent(34.9) / tangent(35.0), 1e-6);
  EXPECT_FALSE(slipped(holds));
  EXPECT_TRUE(slipped(pressed(rough, 2e6 * tangent(35.1))));
}

TEST(InitialStrength, ThatOfTheFirstStage) {
  const std::string bonded = "friction_angle = 20.0\ncohesion = 1e6\ntensile_strength = 1e5\n";
  const std::string stage = "[[stage]]\nduration = 0.1\nstrength_factor = ";
  const double shear = 1e6;  // the strength is 1 + 2 tan(20) = 1.73 MPa
  EXPECT_EQ(pressed(bonded, shear, stage + "1.0\n").accounts.initial->joints[0].over, 0.0);
  const Simulation halved = pressed(bonded, shear, stage + "2.0\n");
  EXPECT_NEAR(halved.accounts.initial->joints[0].over, 4.0, 1e-9);
  EXPECT_NEAR(halved.accounts.initial->joints[0].mobilised,
              2.0 * shear / (1e6 + 2e6 * tangent(20.0)), 1e-9);
}

}  // namespace
}  // namespace edda::initial_strength_test
