// Faces within a step of the implicit method, on blocks that are moved by hand: limits of friction,
// and where the work of a step goes.
#include "implicit/face_springs.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "contacts/moved_blocks.hpp"

namespace edda::face_springs_test {
namespace {

using test::MovedBlocks;
using test::Place;

constexpr double depth = 1e-4, normal = 2e9 * depth, shear_k = 1e9;
const double limit = std::tan(std::numbers::pi / 6.0) * normal;

/// A square pressed onto its base, at rest at the start of a step.
struct Pressed : MovedBlocks {
  FaceSprings springs;

  explicit Pressed(const JointLaw& joint, double at = -depth, bool bonded = false)
      : MovedBlocks(test::square_on_base(joint)) {
    start();
    if (bonded) bond_faces(faces, blocks, pose, laws);
    put_still(1, {{0.0, at}});
    for (auto* taken : {&faces.friction_work, &faces.damping_work}) {
      taken->fill(0.0);
    }
  }
  /// A step to there; bonds that do not hold break.
  void implicit_step(const Place& place) {
    begin_springs(springs, faces);
    const std::vector<double> x = pose.x, y = pose.y;
    put(1, place);
    pose.x1 = x;
    pose.y1 = y;
    evaluate_springs(springs, faces, scene(), step, false);
    const std::vector<Id> broken = break_overloaded(springs, faces, blocks, laws);
    if (!broken.empty()) evaluate_springs(springs, faces, scene(), step, false);
    account_springs(springs, faces, pose, broken);
    pose.x1 = pose.x;
    pose.y1 = pose.y;
  }
};

/// Forces of the end of the step work over all of it: of a spring drawn out by du, k du^2/2 is
/// lost to the method.
TEST(FaceSprings, TheMethodTakesHalfOfTheSquareOfAStep) {
  Pressed m(test::rough_joint(60.0));
  const double along = 2e-5, deeper = 1e-5;
  m.implicit_step({{along, -depth}});
  EXPECT_NEAR(-m.force_on(1).x, shear_k * along, 1e-6 * shear_k * along);
  EXPECT_NEAR(m.damping(), 0.5 * shear_k * along * along, 1e-6 * shear_k * along * along);
  m.implicit_step({{2.0 * along, -depth}});
  EXPECT_NEAR(m.damping(), shear_k * along * along, 1e-6 * shear_k * along * along);
  m.implicit_step({{2.0 * along, -depth - deeper}});
  EXPECT_NEAR(m.damping(), shear_k * along * along + 0.5 * 2e9 * deeper * deeper,
              1e-3 * 2e9 * deeper * deeper);
  EXPECT_EQ(m.friction(), 0.0);
}

/// The limit is that of the normal force at the start of the step; the slip takes T du.
TEST(FaceSprings, FrictionIsThatOfTheStartOfTheStep) {
  Pressed m(test::rough_joint(30.0));
  const double way = 3.0 * limit / shear_k;
  m.implicit_step({{way, -1.5 * depth}});
  EXPECT_NEAR(-m.force_on(1).x, limit, 1e-6 * limit);
  EXPECT_NEAR(m.friction(), limit * (way - limit / shear_k), 1e-6 * limit * way);
  m.implicit_step({{way + 1e-4, -1.5 * depth}});
  EXPECT_NEAR(-m.force_on(1).x, 1.5 * limit, 1e-6 * limit);
}

TEST(FaceSprings, CohesionIsInTheLimit) {
  const double cohesion = 4e4;
  Pressed m(test::rough_joint(30.0, cohesion));
  m.implicit_step({{1e-3, -depth}});
  EXPECT_NEAR(-m.force_on(1).x, limit + cohesion, 1e-6 * limit);
}

/// What a bond held goes with it.
TEST(FaceSprings, BondsGiveUpWhatTheyHeld) {
  Pressed m(test::rough_joint(30.0, 1e6, 2e5), 0.0, true);
  const double most = 2e5 / 2e9;
  m.implicit_step({{0.0, 0.9 * most}});
  EXPECT_EQ(m.fracture(), 0.0);
  EXPECT_NEAR(-m.force_on(1).y, 0.9 * 2e5, 1.0);
  const double held = 0.5 * 2e9 * 0.81 * most * most;
  m.implicit_step({{0.0, 1.1 * most}});
  EXPECT_EQ(m.faces.broken, 1u);
  EXPECT_EQ(m.force_on(1).y, 0.0);
  EXPECT_NEAR(m.fracture(), held, 1e-3 * held);
}

}  // namespace
}  // namespace edda::face_springs_test
