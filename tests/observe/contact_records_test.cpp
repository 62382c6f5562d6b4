// Signs of what is reported of joints: compression is positive in force and stress.
#include <gtest/gtest.h>

#include <algorithm>

#include "observe/observe.hpp"
#include "run/prepared.hpp"
#include "step/step.hpp"

namespace edda::contact_records_test {
namespace {

/// Two blocks on each other, bonded, with a joint stiffness of 1 GPa/m; the upper one is let go at
/// that velocity and turns at that rate.
ContactRecord joint_after(int steps, const std::string& motion) {
  PreparedRun ready = testing::prepared(
      "gravity = [0, 0]\nthickness = 2\n[materials.rock]\ndensity = 2500\nyoung = 2e10\n"
      "poisson = 0.2\n[joints.j]\nfriction_angle = 30\ncohesion = 1e7\ntensile_strength = 1e7\n"
      "kn = 1e9\nks = 1e9\n[[block]]\nfixed = true\npolygon = [[-3, -1], [3, -1], [3, 0], [-3, "
      "0]]\n"
      "[[block]]\npolygon = [[-1, 0], [1, 0], [1, 1], [-1, 1]]\n" +
      motion + "\n[solver]\nduration = 1\n");
  start(ready.sim, 1.0);
  for (int k = 0; k < steps; ++k) EXPECT_FALSE(step(ready.sim));
  Instant at;
  observe(ready.sim, at);
  const Picture picture = picture_of(ready.sim, at);
  EXPECT_EQ(picture.contacts.size(), 1u);
  return picture.contacts.empty() ? ContactRecord{} : picture.contacts[0];
}

TEST(ContactRecords, StressesOfAPressedJointArePositive) {
  const ContactRecord c = joint_after(5, "velocity = [0, -0.1]");
  EXPECT_EQ(c.state, ContactState::bonded);
  EXPECT_GT(c.normal_force, 0.0);
  EXPECT_NEAR(c.normal_stress, c.normal_force / (2.0 * c.length), 1e-9 * c.normal_stress);
  // It is pressed evenly: closure times kn.
  EXPECT_GT(c.normal_stress_a, 0.0);
  EXPECT_NEAR(c.normal_stress_a, c.normal_stress, 1e-3 * c.normal_stress);
  EXPECT_NEAR(c.normal_stress_b, c.normal_stress, 1e-3 * c.normal_stress);
  EXPECT_NEAR(c.normal_stress, -1e9 * c.opening, 1e-3 * c.normal_stress);
}

TEST(ContactRecords, StressesOfAJointInTensionAreNegative) {
  const ContactRecord c = joint_after(5, "velocity = [0, 0.1]");
  EXPECT_EQ(c.state, ContactState::bonded);
  EXPECT_LT(c.normal_force, 0.0);
  EXPECT_LT(c.normal_stress, 0.0);
  EXPECT_LT(c.normal_stress_a, 0.0);
  EXPECT_LT(c.normal_stress_b, 0.0);
  EXPECT_GT(c.opening, 0.0);
}

/// A block that turns counter-clockwise presses its left end and lifts its right one.
TEST(ContactRecords, EachEndHasItsOwnStress) {
  const ContactRecord c = joint_after(5, "angular_velocity = 0.1");
  const bool a_is_left = c.a.x < c.b.x;
  EXPECT_GT(a_is_left ? c.normal_stress_a : c.normal_stress_b, 0.0);
  EXPECT_LT(a_is_left ? c.normal_stress_b : c.normal_stress_a, 0.0);
}

}  // namespace
}  // namespace edda::contact_records_test
