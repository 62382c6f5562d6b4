// The mechanism that a search for a factor of safety reports.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "study/sliding_block.hpp"

namespace edda::fos_mechanism_test {
namespace {

using testing::coarse;
using testing::exact;
using testing::found;
using testing::model_of;
using testing::ramp;

/// Between the strength at which the cohesion fails and that at which friction is exceeded.
TEST(Fos, ReportsCohesionThatWasLostBefore) {
  const std::string law = "friction_angle = 40\ncohesion = 100\n";
  const FosResult brittle = found(ramp(law + "residual = { friction_angle = 45 }\n", coarse));
  EXPECT_NEAR(*brittle.factor, exact, 0.05);
  ASSERT_TRUE(brittle.mechanism);
  EXPECT_NEAR(brittle.mechanism->brittle_length, 2.0, 0.01);
  EXPECT_NEAR(brittle.mechanism->cohesion_lost_length, 2.0, 0.01);
  EXPECT_NE(brittle.mechanism->text.find(
                "; all 2 m of its joints had already lost their cohesion before"),
            std::string::npos)
      << brittle.mechanism->text;
  EXPECT_NE(lost_cohesion_text(*brittle.mechanism)
                .find("all 2 m of joints in the mechanism had already lost their cohesion before "
                      "failure. If cohesion should survive, set residual.cohesion (joints with "
                      "fracture energies keep "
                      "none)"),
            std::string::npos);
  EXPECT_NE(fos_summary(model_of(ramp(law)), brittle, 1).find("\"cohesion_lost_length\""),
            std::string::npos);
  // Cohesion that is lost at failure, and residual cohesion.
  const FosResult whole = found(ramp("friction_angle = 45\ncohesion = 3000\n", coarse));
  EXPECT_NEAR(whole.mechanism->brittle_length, 2.0, 0.01);
  EXPECT_EQ(whole.mechanism->cohesion_lost_length, 0.0);
  EXPECT_EQ(lost_cohesion_text(*whole.mechanism), "");
  const FosResult kept =
      found(ramp(law + "residual = { friction_angle = 45, cohesion = 100 }\n", coarse));
  EXPECT_EQ(kept.mechanism->brittle_length, 0.0);
}

/// The corner that moves most lies at the toe of the slope, where its edge has no neighbour: the
/// plane is found nevertheless.
TEST(Fos, TheMechanismHasTheWholePlane) {
  const FosResult r = found(
      "[materials.rock]\ndensity = 2600\nyoung = 1e10\npoisson = 0.25\n"
      "[joints.plane]\nfriction_angle = 30\nkn = 1e10\nks = 4e9\n[joints.crack]\n"
      "friction_angle = 30\n[domain]\njoint = 'crack'\n"
      "outline = [[-20, -10], [60, -10], [60, 20], [7.2794, 20], [0, 0]]\n"
      "[[trace]]\npoints = [[0, 0], [20, 11]]\njoint = 'plane'\n"
      "[[trace]]\npoints = [[20, 11], [20, 20]]\njoint = 'crack'\n[[fixed]]\npoint = [30, -5]\n"
      "[solver]\nduration = 1\n[fos]\nbracket = [1, 1.5]\ntolerance = 0.5\n");
  ASSERT_TRUE(r.mechanism) << r.message;
  const auto plane = std::find_if(r.mechanism->joints.begin(), r.mechanism->joints.end(),
                                  [](const MovingJoint& j) { return j.joint == "plane"; });
  ASSERT_NE(plane, r.mechanism->joints.end());
  double length = 0.0;
  for (const Stretch& s : plane->stretches) length += norm(s.to - s.from);
  // The part that has slid past the toe no longer lies on the plane.
  const double whole = std::hypot(20.0, 11.0), rounding = 0.01;
  EXPECT_LT(plane->slip, 1.0);
  EXPECT_GE(length, whole - plane->slip - rounding);
  EXPECT_LE(length, whole + rounding);
}

/// Feet that lean on the ground at 60 degrees slip along the ground, and lift no more than joints
/// that dilate as they slide.
TEST(Fos, PointedFeetSlipAlongTheGround) {
  const FosResult r = found(
      "gravity = [5, -8.660254]\n[materials.rock]\ndensity = 2500\nyoung = 1e10\npoisson = 0.2\n"
      "[joints.j]\nfriction_angle = 25\n[solver]\nduration = 1\n[[block]]\nfixed = true\n"
      "polygon = [[-9, -1], [9, -1], [9, 0], [-9, 0]]\n[[block]]\npolygon = [[0, 0], [0.4, 0.7], "
      "[2.6, 0.7], [3, 0], [3.4, 0.7], [3.4, 1.5], [-0.4, 1.5], [-0.4, 0.7]]\n");
  ASSERT_TRUE(r.factor && r.mechanism) << r.message;
  EXPECT_NEAR(*r.factor, std::tan(25.0 * std::numbers::pi / 180.0) * std::sqrt(3.0), 0.01);
  ASSERT_EQ(r.mechanism->joints.size(), 1U);
  const MovingJoint& joint = r.mechanism->joints.front();
  EXPECT_NEAR(std::hypot(joint.slip, joint.opening), r.mechanism->blocks.front().largest,
              0.01 * joint.slip);
  EXPECT_NEAR(joint.opening / joint.slip, std::tan(25.0 * std::numbers::pi / 180.0) / *r.fails,
              0.01);
}

/// A block that slides out over the toe of a plane does not topple.
TEST(Fos, WhatGoesOutOverTheToeSlides) {
  const FosResult r = found(
      "[materials.rock]\nunit_weight = '26 kN/m3'\nyoung = '1 GPa'\npoisson = 0.25\n"
      "[joints.bedding]\nfriction_angle = 20\n[joints.cross]\nfriction_angle = 35\n"
      "[domain]\njoint = 'bedding'\n"
      "outline = [[0, 0], [44, 0], [44, 22], [24.4, 22], [20, 10], [20, 8], [0, 8]]\n"
      "[[trace]]\npoints = [[20, 10], [34.301, 22]]\njoint = 'bedding'\n"
      "[[joint_set]]\nangle = -50\nspacing = 8\norigin = [25.6, 10]\njoint = 'cross'\n"
      "region = [[20, 10], [34.301, 22], [24.4, 22]]\n[[fixed]]\npoint = [5, 5]\n" +
      coarse);
  ASSERT_TRUE(r.mechanism) << r.message;
  EXPECT_EQ(r.mechanism->text, "sliding along bedding: 3 blocks");
}

/// An arch of seven voussoirs under a horizontal acceleration, which becomes a mechanism of four
/// hinges at 0.37 g (Oppenheim 1992).
TEST(Fos, AnArchUnderAccelerationHasFourHinges) {
  const FosResult r = found(
      "[materials.stone]\nunit_weight = '24 kN/m3'\nyoung = '10 GPa'\npoisson = 0.2\n"
      "[joints.mortar]\nfriction_angle = 40\n[[arch]]\nradius = 10\nthickness = 1.5\ncount = 7\n"
      "from_angle = 11.25\nto_angle = 168.75\n[[block]]\nfixed = true\n"
      "polygon = [[-9.0722635, 1.8045855], [-10.5434414, 2.0972210], [-12.5, 2.0972210], "
      "[-12.5, 0], [-9.0722635, 0]]\n[[block]]\nfixed = true\n"
      "polygon = [[9.0722635, 1.8045855], [10.5434414, 2.0972210], [12.5, 2.0972210], "
      "[12.5, 0], [9.0722635, 0]]\n[fos]\nvary = 'kh'\n");
  ASSERT_TRUE(r.factor && r.mechanism) << r.message;
  EXPECT_NEAR(*r.factor, 0.3736, 0.01 * 0.3736);
  EXPECT_TRUE(r.message.starts_with("seismic coefficient kh 0.37")) << r.message;
  const Mechanism& m = *r.mechanism;
  EXPECT_TRUE(m.text.starts_with("hinging: 4 hinges at (")) << m.text;
  ASSERT_EQ(m.joints.size(), 4U);
  for (const MovingJoint& joint : m.joints) EXPECT_EQ(joint.motion, JointMotion::hinges);
  EXPECT_GT(m.hinging, 0.9);
}

}  // namespace
}  // namespace edda::fos_mechanism_test
