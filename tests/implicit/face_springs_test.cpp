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
    if (bonded) bond();
    put_still(1, {{0.0, at}});
    pose.x1 = pose.x;
    pose.y1 = pose.y;
    for (auto* taken : {&faces.friction_work, &faces.damping_work}) {
      taken->fill(0.0);
    }
    keep_trial(tiled.tiles, faces);
  }
  /// A step to there; bonds that do not hold break.
  void implicit_step(const Place& place) {
    const TrialFaces trial{faces, tiled};
    begin_springs(springs, trial, scene());
    const std::vector<double> x = pose.x, y = pose.y;
    put(1, place);
    pose.x1 = x;
    pose.y1 = y;
    BodyVectors on = zero_vectors(blocks);
    evaluate_springs(springs, trial, scene(), step, false, on);
    const std::vector<Id> broken = break_overloaded(springs, trial, scene());
    if (!broken.empty()) evaluate_springs(springs, trial, scene(), step, false, on);
    account_springs(springs, trial, scene(), broken);
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

/// A step that slides and breaks a bond on the way, and is then given up, leaves everything as it
/// was; and the next one is as if it had been the first.
TEST(FaceSprings, AStepThatIsGivenUpLeavesNothing) {
  const double most = 2e5 / 2e9;
  for (const bool bonded : {true, false}) {
    Pressed m(test::rough_joint(30.0, bonded ? 1e6 : 0.0, bonded ? 2e5 : 0.0),
              bonded ? 0.0 : -depth, bonded);
    m.implicit_step({{1e-5, bonded ? 0.5 * most : -depth}});
    const FaceSet was = m.faces;
    const FaceStates states = m.states();
    const std::vector<double> x = m.pose.x, y = m.pose.y;
    const TrialFaces trial{m.faces, m.tiled};
    begin_springs(m.springs, trial, m.scene());
    m.put(1, {{1.0, bonded ? 2.0 * most : -0.5 * depth}});
    BodyVectors on = zero_vectors(m.blocks);
    evaluate_springs(m.springs, trial, m.scene(), m.step, false, {on});
    EXPECT_EQ(break_overloaded(m.springs, trial, m.scene()).size(), bonded ? 1u : 0u);
    go_back(m.springs, trial, m.blocks);
    m.pose.x = m.pose.x1 = x;
    m.pose.y = m.pose.y1 = y;
    recall_work(m.faces, m.tiled.tiles);
    for (const auto& column : face_properties)
      EXPECT_EQ((m.faces.*column.values).values(), (was.*column.values).values()) << column.name;
    EXPECT_EQ(m.faces.flags, was.flags);
    const FaceStates left = m.states();
    for (const FaceField& field : face_fields) {
      for (std::size_t k = 0; k < was.size(); ++k) {
        EXPECT_EQ(left.now[k].*field.value, states.now[k].*field.value) << field.name;
        EXPECT_EQ(left.before[k].*field.value, states.before[k].*field.value) << field.name;
      }
    }
  }
}

}  // namespace
}  // namespace edda::face_springs_test
