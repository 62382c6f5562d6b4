// Bonds, glued joints, slip-dependent laws and strength factors, on blocks moved in a prescribed
// way.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <utility>

#include "contacts/moved_blocks.hpp"
#include "contacts/strength.hpp"

namespace edda::face_strength_test {
namespace {

using test::MovedBlocks;
using test::pressed_square;
using test::rough_joint;
using test::square_on_base;

double tangent(double degrees) {
  return std::tan(degrees * std::numbers::pi / 180.0);
}

// For a model 2 m thick: springs, N/m per metre.
constexpr double thickness = 2.0, normal_k = 2e9 * thickness, shear_k = 1e9 * thickness;
constexpr double cohesion = 1e6, tension = 2e5;

/// A square bonded to its base as drawn.
MovedBlocks bonded_square(const JointLaw& joint) {
  MovedBlocks m = square_on_base(joint, thickness);
  m.start();
  m.bond();
  m.evaluate();
  return m;
}
JointLaw weakening_bond() {
  JointLaw joint = rough_joint(30.0, cohesion, tension);
  joint.residual = {20.0, 3e4, 5e4};
  return joint;
}
MovedBlocks bonded_square() {
  return bonded_square(weakening_bond());
}

JointLaw barton_joint() {
  JointLaw joint;
  joint.name = "j";
  joint.type = LawType::barton_bandis;
  joint.jrc = 8.0;
  joint.jcs = 50e6;
  joint.residual_angle = 28.0;
  return joint;
}

std::size_t bonded_face(const MovedBlocks& m) {
  std::size_t k = 0;
  while (k < m.faces.size() && !m.faces.bonded(k)) ++k;
  return k;
}

/// A square that is drawn so far above its base, or in it, and then bonded.
MovedBlocks bonded_as_drawn(double gap) {
  MovedBlocks m = square_on_base(rough_joint(30.0, cohesion, tension), thickness);
  m.start();
  m.put(1, {{0.0, gap}});
  m.bond();
  m.evaluate();
  return m;
}

/// Coordinates with few digits leave gaps and overlaps; up to a thousandth of the block's size a
/// joint has its bond there, and no stress.
TEST(FaceBond, FitsWhatIsDrawnNearly) {
  for (const double gap : {0.0, 3e-4, -3e-4, 0.99e-3}) {
    MovedBlocks m = bonded_as_drawn(gap);
    const std::size_t k = bonded_face(m);
    ASSERT_LT(k, m.faces.size()) << gap;
    EXPECT_NEAR(m.now(k).closure_a, 0.0, 1e-12) << gap;
    EXPECT_NEAR(m.now(k).closure_b, 0.0, 1e-12) << gap;
    EXPECT_NEAR(norm(m.force_on(1)), 0.0, 1e-12 * normal_k) << gap;
    m.go(1, {{0.0, gap - 1e-5}});
    EXPECT_NEAR(m.force_on(1).y, 1e-5 * normal_k, 1e-6 * normal_k) << gap;
  }
  for (const double gap : {1.01e-3, -1.01e-3})
    EXPECT_EQ(bonded_face(bonded_as_drawn(gap)), bonded_as_drawn(gap).faces.size()) << gap;
}

/// One end opens while the other closes by a fifth of it: the bond cracks at the open end, and
/// keeps its cohesion and its peak friction, since the other one is pressed. Its outer fibre has
/// -N/L + 6 M/L^2. With a given kn the stress is linear, and is that of the open end; springs at
/// the ends have N/L = -0.4 k d and 6 M/L^2 = 1.8 k d, 2.2 k d.
TEST(FaceBond, CracksAtTheEndThatOpens) {
  for (const auto& [way, kn] : {std::pair{1.0, 0.0}, {-1.0, 0.0}, {1.0, 2e9}, {-1.0, 2e9}}) {
    const double most = tension * thickness / normal_k / (kn > 0.0 ? 1.0 : 2.2);
    JointLaw joint = weakening_bond();
    joint.kn = joint.ks = kn;
    MovedBlocks m = bonded_square(joint);
    const std::size_t k = bonded_face(m);
    ASSERT_LT(k, m.faces.size());
    EXPECT_EQ(m.faces.stiffness[k], normal_k);
    const auto open = [&m, sign = way](double by) {
      // Closed by 0.2 of that at the other end, by rotation about the middle of the face.
      m.go(1, {{-0.6 * sign * by, 0.4 * by}, 1.2 * sign * by});
    };
    for (int n = 1; n <= 98; ++n) open(0.01 * n * most);
    EXPECT_TRUE(m.faces.bonded(k));
    EXPECT_EQ(m.fracture(), 0.0);
    open(1.02 * most);
    EXPECT_TRUE(m.faces.bonded(k));
    EXPECT_EQ(m.faces.broken, 0u);
    EXPECT_GT(m.fracture(), 0.0);
    EXPECT_FALSE(m.faces.carries_tension(k));  // exceeds the residual tensile strength, too
    EXPECT_NEAR(m.faces.friction[k], tangent(30.0), 1e-12);
    EXPECT_EQ(m.faces.cohesion[k], cohesion * thickness);
    EXPECT_EQ(m.faces.tension[k], 5e4 * thickness);
  }
}

/// The stored energy is released: k d^2/2 of a face that opens uniformly.
TEST(FaceBond, AccountsForItsStoredEnergyAsItFails) {
  MovedBlocks m = bonded_square();
  const std::size_t k = bonded_face(m);
  const double most = tension * thickness / normal_k;
  for (int n = 1; n <= 101; ++n) m.go(1, {{0.0, 0.01 * n * most}});
  m.go(1, {{0.0, 1.01 * most}});
  EXPECT_FALSE(m.faces.bonded(k));
  EXPECT_EQ(m.faces.broken, 1u);
  EXPECT_FALSE(m.faces.is(FaceFlag::fails, k));  // from now on its dissipation is friction
  const double stored = 0.5 * normal_k * most * most;
  EXPECT_NEAR(m.fracture(), stored, 0.03 * stored);
  EXPECT_NEAR(m.balance() + m.work, 0.0, 0.02 * stored);
}

/// From pressure to tension and back within a step: k d_0 d_1/2, which is negative.
TEST(FaceBond, StoresLikeASpringWhereItChangesToTension) {
  MovedBlocks m = bonded_square();
  const double d = 1e-5;
  m.go(1, {{0.0, -d}});
  const double start = m.balance() + m.work, whole = normal_k * d * d;
  for (const double y : {-0.5, 0.5, 1.5, -0.5, -1.5, 0.0, 1.0, 0.0, -1.0}) {
    const double before = -m.now(bonded_face(m)).closure_a;
    m.go(1, {{0.0, y * d}});
    EXPECT_NEAR(m.stored(), 0.5 * normal_k * y * d * before, 1e-6 * whole) << y;
    EXPECT_NEAR(m.balance() + m.work, start, 1e-6 * whole) << y;
  }
}

/// While loads come on a bond has many times its cohesion and its tensile strength; then its own.
TEST(FaceBond, HoldsWhileItsStrengthIsRaised) {
  MovedBlocks m = bonded_square();
  const std::size_t k = bonded_face(m);
  const double by_shear = cohesion * thickness / shear_k, by_pull = tension * thickness / normal_k;
  m.faces.bond_strength = 3.0;
  for (int n = 1; n <= 29; ++n) m.go(1, {{0.1 * n * by_shear, 0.0}});
  EXPECT_TRUE(m.faces.bonded(k));
  for (int n = 28; n >= 0; --n) m.go(1, {{0.1 * n * by_shear, 0.0}});
  for (int n = 1; n <= 29; ++n) m.go(1, {{0.0, 0.1 * n * by_pull}});
  EXPECT_TRUE(m.faces.bonded(k));
  m.faces.bond_strength = 1.0;
  m.go(1, {{0.0, 2.9 * by_pull}});
  EXPECT_FALSE(m.faces.bonded(k));
}

TEST(FaceBond, ShearsAtItsCohesionAndFriction) {
  MovedBlocks m = bonded_square();
  const std::size_t k = bonded_face(m);
  const double depth = 1e-5, normal = normal_k * depth;
  const double limit = cohesion * thickness + tangent(30.0) * normal;
  for (int n = 0; n <= 99; ++n) m.go(1, {{0.01 * n * limit / shear_k, -depth}});
  EXPECT_TRUE(m.faces.bonded(k));
  EXPECT_NEAR(-m.force_on(1).x, 0.99 * limit, 1e-3 * limit);
  m.go(1, {{1.01 * limit / shear_k, -depth}});
  EXPECT_FALSE(m.faces.bonded(k));
  EXPECT_NEAR(-m.force_on(1).x, 3e4 * thickness + tangent(20.0) * normal, 1e-3 * normal);
  // Only the residual tensile strength remains.
  const double left = 5e4 * thickness / normal_k;
  EXPECT_TRUE(m.faces.carries_tension(k));
  m.go(1, {{1.01 * limit / shear_k, 0.98 * left}});
  EXPECT_NEAR(-m.force_on(1).y, 0.98 * 5e4 * thickness, 1.0);
  m.go(1, {{1.01 * limit / shear_k, 1.02 * left}});
  m.go(1, {{1.01 * limit / shear_k, 0.9 * left}});
  EXPECT_EQ(m.force_on(1).y, 0.0);
}

TEST(Glue, ReleasesWhatItCarried) {
  MovedBlocks m = pressed_square(rough_joint(30.0), 1e-6);
  m.change([](FaceSet& faces, const FaceStates& states) { glue_faces(faces, states); });
  const double apart = 1e-4, stored = 0.5 * 2e9 * apart * apart;
  for (int n = 0; n <= 200; ++n) m.go(1, {{0.0, -1e-6 + 0.005 * n * (apart + 1e-6)}});
  m.go(1, {{0.0, apart}});
  EXPECT_NEAR(-m.force_on(1).y, 2e9 * apart, 1e-3 * 2e9 * apart);
  m.change([&](FaceSet& faces, FaceStates&) { unglue_faces(faces, m.blocks, m.pose); });
  EXPECT_NEAR(m.fracture(), stored, 1e-2 * stored);
  m.evaluate_from(m.step);
  EXPECT_EQ(m.force_on(1).y, 0.0);
}

/// It is glued neither as it stands there nor later, until it lies flat.
TEST(Glue, ACornerOnAnEdgeKeepsItsFriction) {
  MovedBlocks m = pressed_square(rough_joint(30.0), 1e-6);
  const double turned = 0.05, depth = 1e-5,
               down = 0.5 * (1.0 - std::cos(turned) - std::sin(turned)) + depth;
  m.put_still(1, {{0.0, -down}, turned});
  m.change([](FaceSet& faces, const FaceStates& states) { glue_faces(faces, states); });
  for (int n = 1; n <= 100; ++n) m.go(1, {{1e-5 * n, -down}, turned});
  const Vec2 force = m.force_on(1);
  EXPECT_GT(force.y, 1e3);
  EXPECT_NEAR(-force.x, tangent(30.0) * force.y, 1e-3 * force.y);
  for (int n = 1; n <= 3; ++n) m.go(1, {{1e-3, -depth}});
  for (int n = 1; n <= 100; ++n) m.go(1, {{1e-3 + 1e-5 * n, -depth}});
  EXPECT_GT(-m.force_on(1).x, 10.0 * m.force_on(1).y);
}

/// Slides the square by `way` in steps of 1e-5 m, with the closure `depth`.
void slide(MovedBlocks& m, double way, double depth) {
  const int steps = static_cast<int>(way / 1e-5);
  for (int n = 1; n <= steps; ++n) m.go(1, {{1e-5 * n, -depth}});
}

TEST(SlipWeakening, AllStrengthFallsWithSlip) {
  JointLaw joint;
  joint.name = "j";
  joint.type = LawType::slip_weakening;
  joint.peak = {40.0, 1e5, 2e5};
  joint.residual = {20.0, 2e4, 5e4};
  joint.slip_distance = 0.004;
  joint.dilation_angle = 5.0;
  MovedBlocks m = bonded_square(joint);
  const double depth = 1e-4, elastic = tangent(40.0) * normal_k * depth / shear_k + 1e5 / 1e9;
  slide(m, 2e-3, depth);
  const std::size_t k = m.main_face();
  const double slip_so_far = m.faces.slip_so_far[k], part = slip_so_far / 0.004;
  EXPECT_NEAR(slip_so_far, 2e-3 - elastic, 0.1 * 2e-3);
  const auto between = [&](double peak, double residual) {
    return peak + part * (residual - peak);
  };
  EXPECT_NEAR(m.faces.friction[k], between(tangent(40.0), tangent(20.0)), 1e-12);
  EXPECT_NEAR(m.faces.cohesion[k], thickness * between(1e5, 2e4), 1e-6);
  EXPECT_NEAR(m.faces.tension[k], thickness * between(2e5, 5e4), 1e-6);
  // Its dilation decreases, too: by (1 - u/D) tan(psi) du.
  const double opened = tangent(5.0) * slip_so_far * (1.0 - 0.5 * part);
  EXPECT_NEAR(m.faces.locked_closure_a[k] + m.faces.dilation_left[k], opened, 1e-2 * opened);
}

JointLaw dilating_joint(double friction_angle, double dilation_angle) {
  JointLaw joint = rough_joint(friction_angle);
  joint.dilation_angle = dilation_angle;
  joint.slip_distance = 0.01;
  return joint;
}

TEST(Dilation, OpensByTheTangentOfItsAngleAndAccountsForTheWork) {
  const double depth = 1e-4;
  MovedBlocks m = pressed_square(dilating_joint(30.0, 5.0), depth);
  for (int n = 1; n <= 2; ++n) m.go(1, {{1e-6 * n, -depth}});
  const double start = m.balance() + m.work;
  for (int n = 3; n <= 600; ++n) m.go(1, {{1e-6 * n, -depth}});
  const std::size_t k = m.main_face();
  const double slip_so_far = m.faces.slip_so_far[k];
  EXPECT_GT(slip_so_far, 3e-4);
  EXPECT_GT(m.faces.locked_closure_a[k], 0.9 * tangent(5.0) * slip_so_far);
  EXPECT_EQ(m.faces.locked_closure_a[k], m.faces.locked_closure_b[k]);
  EXPECT_NEAR(m.faces.locked_closure_a[k] + m.faces.dilation_left[k], tangent(5.0) * slip_so_far,
              1e-9 * slip_so_far);
  // With the square kept at its height, the closure increases by that much; its energy is taken
  // from friction.
  EXPECT_NEAR(m.force_on(1).y, 2e9 * (depth + m.faces.locked_closure_a[k]), 1e-3 * m.force_on(1).y);
  EXPECT_NEAR(m.balance() + m.work, start, 1e-3 * m.friction());
}

/// With a dilation beyond what friction dissipates, it opens only by what friction provides.
TEST(Dilation, LiftsByNoMoreThanFrictionTakes) {
  MovedBlocks m = pressed_square(dilating_joint(5.0, 40.0), 1e-4);
  for (int n = 1; n <= 200; ++n) {
    m.go(1, {{1e-6 * n, -1e-4}});
    EXPECT_GE(m.friction(), -1e-9);
  }
  EXPECT_GT(m.faces.locked_closure_a[m.main_face()], 0.0);
  EXPECT_GT(m.faces.dilation_left[m.main_face()], 0.0);
}

/// With a tiny gap the joint continues to dilate as it slips.
TEST(Dilation, CountsTheSlipOfAJointThatIsOpenByAHair) {
  MovedBlocks m = pressed_square(dilating_joint(30.0, 5.0), 1e-6);
  m.go(1, {{0.0, -1e-6}});
  m.go(1, {{0.0, 2e-5}});
  m.go(1, {{0.0, 2e-5}});
  const auto most_slid = [&m] {
    const std::vector<double> slip_so_far = m.faces.slip_so_far.values();
    return *std::max_element(slip_so_far.begin(), slip_so_far.end());
  };
  const double before = most_slid();
  for (int n = 1; n <= 10; ++n) m.go(1, {{1e-6 * n, 2e-5}});
  EXPECT_NEAR(most_slid() - before, 1e-5, 1e-9);
}

/// The formulas themselves, against values computed by hand.
TEST(BartonBandis, Formulas) {
  Law law{};
  law.jrc = 10.0;
  law.jcs = 100e6;
  law.residual_angle = 30.0;
  EXPECT_NEAR(barton_angle(law, 1.0, 1e6), 50.0, 1e-12);
  EXPECT_NEAR(barton_angle(law, 0.5, 1e6), 40.0, 1e-12);
  EXPECT_EQ(barton_angle(law, 1.0, 100e6), 30.0);
  EXPECT_EQ(barton_angle(law, 1.0, 1e-3), 70.0);
  EXPECT_EQ(roughness_left(0.5, 1.0), 1.0);
  EXPECT_NEAR(roughness_left(2.0, 1.0), 0.85, 1e-12);
  EXPECT_NEAR(roughness_left(10.0, 1.0), 0.5, 1e-12);
  EXPECT_NEAR(roughness_left(std::sqrt(40.0), 1.0), 0.6, 1e-12);
  EXPECT_EQ(roughness_left(200.0, 1.0), 0.0);
}

/// phi_r + JRC log10(JCS/sigma), its tangent divided by the strength factor; half of the angle
/// above phi_r is the dilation angle.
TEST(BartonBandis, FrictionAndDilationInForce) {
  for (const double factor : {1.0, 2.0}) {
    const JointLaw joint = barton_joint();
    MovedBlocks m = square_on_base(joint, thickness);
    m.start();
    m.laws = divided_laws(m.model, {factor, factor});
    const double depth = 1e-4;
    m.put_still(1, {{0.0, -depth}});
    m.change(
        [&](FaceSet& faces, const FaceStates& states) { put_in_force(faces, states, m.laws); });
    const std::size_t k = m.main_face();
    const double angle = 28.0 + 8.0 * std::log10(50e6 / (2e9 * depth));
    EXPECT_NEAR(m.faces.friction[k], tangent(angle) / factor, 1e-6);
    // At first, before dilation has raised the pressure.
    const double elastic = tangent(angle) / factor * 2e9 * depth / 1e9;
    const int steps = static_cast<int>(1.02 * elastic / 1e-6);
    for (int n = 1; n <= steps; ++n) m.go(1, {{1e-6 * n, -depth}});
    const double slip_so_far = m.faces.slip_so_far[k];
    ASSERT_GT(slip_so_far, 0.0);
    EXPECT_NEAR((m.faces.locked_closure_a[k] + m.faces.dilation_left[k]) / slip_so_far,
                tangent(0.5 * (angle - 28.0)), 1e-2 * tangent(0.5 * (angle - 28.0)));
  }
}

TEST(StrengthFactors, DivideAllStrength) {
  JointLaw joint = rough_joint(40.0, 3e5, 2e5);
  joint.residual = {30.0, 1e5, 5e4};
  Model model;
  model.joints = {joint};
  const Law whole = build_laws(model).rows[0], half = divided_laws(model, {2.0, 2.0}).rows[0];
  EXPECT_EQ(half.peak_friction, 0.5 * whole.peak_friction);
  EXPECT_EQ(half.peak_cohesion, 0.5 * whole.peak_cohesion);
  EXPECT_EQ(half.peak_tension, 0.5 * whole.peak_tension);
  EXPECT_EQ(half.residual_friction, 0.5 * whole.residual_friction);
  EXPECT_EQ(half.residual_cohesion, 0.5 * whole.residual_cohesion);
  EXPECT_EQ(half.residual_tension, 0.5 * whole.residual_tension);
}

/// A face that has carried and is open has no normal stress: its friction is the residual one,
/// whatever it was when it last carried.
TEST(StrengthFactors, AnOpenFaceOfBartonBandisHasItsResidualFriction) {
  JointLaw joint = barton_joint();
  joint.residual.friction_angle = joint.peak.friction_angle = 28.0;
  MovedBlocks m = square_on_base(joint, thickness);
  m.start();
  for (const double depth : {1e-4, 1e-4, 1e-4}) m.go(1, {{0.0, -depth}});
  const std::size_t k = m.main_face();
  EXPECT_GT(m.faces.friction[k], tangent(30.0));
  for (int n = 0; n < 3; ++n) m.go(1, {{0.0, 1e-3}});
  m.change([&](FaceSet& faces, const FaceStates& states) {
    put_in_force(faces, states, divided_laws(m.model, {2.0, 2.0}));
  });
  EXPECT_NEAR(m.faces.friction[k], tangent(28.0) / 2.0, 1e-12);
}

TEST(StrengthFactors, ApplyToTheStrengthInForce) {
  MovedBlocks m = bonded_square();
  const std::size_t k = bonded_face(m);
  const LawTable once = divided_laws(m.model, {1.25, 1.25}),
                 twice = divided_laws(m.model, {2.5, 2.5});
  for (const LawTable* laws : {&once, &twice}) put_in_force(m.faces, m.states(), *laws);
  EXPECT_NEAR(m.faces.friction[k], tangent(30.0) / 2.5, 1e-12);
  EXPECT_NEAR(m.faces.cohesion[k], cohesion * thickness / 2.5, 1e-6);
  EXPECT_NEAR(m.faces.tension[k], tension * thickness / 2.5, 1e-6);
}

}  // namespace
}  // namespace edda::face_strength_test
