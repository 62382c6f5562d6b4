// A face while its blocks are moved: its forces, and that its energy balance closes.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

#include "contacts/face_stiffness.hpp"
#include "contacts/moved_blocks.hpp"

namespace edda::moving_face_test {
namespace {

using test::MovedBlocks;
using test::Place;
using test::pressed_square;
using test::rough_joint;
using test::square_on_base;

const double mu = std::tan(std::numbers::pi / 6.0);  // of 30 degrees
constexpr double depth = 1e-4;

TEST(MovingFace, IsAsStiffAsItsJoint) {
  MovedBlocks penalty = pressed_square(rough_joint(30.0), depth, 2.0);
  // A spring p at each end, times the thickness.
  EXPECT_NEAR(penalty.force_on(1).y, 2.0 * 2.0 * 1e9 * depth, 1.0);
  JointLaw measured = rough_joint(30.0);
  measured.kn = 3e9;
  MovedBlocks m = square_on_base(measured);
  m.start();
  const double tilt = 2e-5;
  m.put_still(1, {{0.0, -depth}, tilt});
  EXPECT_NEAR(m.force_on(1).y, 3e9 * depth, 1e-4 * 3e9 * depth);
  const std::size_t k = m.main_face();
  EXPECT_EQ(m.faces.shear_stiffness[k], 0.4 * 3e9);  // none is given
  // Moment k L^3 tilt/12 of the pressure about the middle.
  const auto moment = [](const MovedBlocks& of, std::size_t face) {
    return 0.5 * std::abs(of.now(face).normal_a - of.now(face).normal_b);
  };
  EXPECT_NEAR(moment(m, k), 3e9 * tilt / 12.0, 1e-3 * 3e9 * tilt / 12.0);
  EXPECT_NEAR(norm(middle_of(m.row(k), m.pose) - Vec2{0.5, 0.0}), 0.0, 1e-3);
  // A penalty is a spring at either end, k L^3/4; where no corner leans the exact integral holds
  // for it, too.
  const std::size_t q = penalty.main_face();
  penalty.put_still(1, {{0.0, -depth}, tilt});
  EXPECT_NEAR(moment(penalty, q), 4e9 * tilt / 4.0, 1e-3 * 4e9 * tilt);
  penalty.faces.set(FaceFlag::leans, q, false);
  penalty.evaluate();
  EXPECT_NEAR(moment(penalty, q), 4e9 * tilt / 12.0, 1e-3 * 4e9 * tilt);
}

TEST(MovingFace, SlidesAtCoulombsLimitAndUnloadsElastically) {
  const double normal = 2e9 * depth, cohesion = 2e4;
  for (const double c : {0.0, cohesion}) {
    MovedBlocks m = pressed_square(rough_joint(30.0, c), depth);
    const double limit = mu * normal + c;
    const auto shear = [&](double at) {
      m.go(1, {{at, -depth}});
      return -m.force_on(1).x;
    };
    for (int n = 1; n <= 40; ++n) {
      EXPECT_NEAR(shear(1e-5 * n), std::min(1e9 * 1e-5 * n, limit), 1e-3 * limit) << n;
    }
    EXPECT_NEAR(shear(3.5e-4), limit - 1e9 * 5e-5, 1e-3 * limit);
    EXPECT_NEAR(shear(3.0e-4), limit - 1e9 * 1e-4, 1e-3 * limit);
    const std::size_t k = m.main_face();
    EXPECT_TRUE(m.faces.is(FaceFlag::slipped, k));
    m.go(1, {{3.0e-4, -depth}});
    EXPECT_NEAR(m.friction(), limit * (4e-4 - limit / 1e9), 0.03 * limit * 4e-4);
    EXPECT_NEAR(m.transfer(), 0.0, 1e-6 * m.friction());
  }
}

/// (T_n + T_{n-1})/2 over the slip of a step, while the normal force falls: transfer is zero, since
/// the overlap does not change.
TEST(MovingFace, FrictionIsCoulombsWhileTheNormalForceChanges) {
  MovedBlocks m = pressed_square(rough_joint(30.0), depth);
  const auto limit = [](int n) { return mu * 2e9 * depth * (1.0 - 0.01 * n); };
  double before = 0.0, expected = 0.0;
  for (int n = 1; n <= 60; ++n) {
    m.go(1, {{2e-5 * n, -depth * (1.0 - 0.01 * n)}});
    if (n == 20) before = m.friction();
    // As the limit falls the end slips by the elastic slip that the spring loses.
    const double slip = 2e-5 + (limit(n - 2) - limit(n - 1)) / 1e9;
    if (n > 20) expected += slip * 0.5 * (limit(n - 2) + limit(n - 1));
  }
  EXPECT_NEAR(m.friction() - before, expected, 1e-9 * expected);
  EXPECT_NEAR(m.transfer(), 0.0, 1e-9 * expected);
}

/// Moves block 1 and compares the energy balance with the work of the forces. Returns the
/// frictional dissipation.
void expect_closed_books(MovedBlocks& m, int steps, const std::function<Place(int)>& place,
                         double bound) {
  m.put_still(1, place(0));
  for (int n = 1; n <= 2; ++n) m.go(1, place(n));
  const double start = m.balance() + m.work;
  double most = 0.0, scale = 0.0;
  for (int n = 3; n <= steps; ++n) {
    m.go(1, place(n));
    most = std::max(most, std::abs(m.balance() + m.work - start));
    scale = std::max(scale, m.stored() + m.friction() + m.damping());
  }
  EXPECT_LT(most, bound * scale);
  EXPECT_GT(m.friction(), 0.01 * scale);
}

Place wiggle(int n) {
  return {{3e-4 * std::sin(0.021 * n), -depth * (1.0 + 0.4 * std::sin(0.034 * n))},
          2e-5 * std::sin(0.027 * n)};
}

TEST(MovingFace, ClosesTheEnergyBalance) {
  MovedBlocks m = square_on_base(rough_joint(30.0));
  m.start();
  expect_closed_books(m, 600, wiggle, 1e-4);
}

TEST(MovingFace, ClosesTheEnergyBalanceWithDashpots) {
  JointLaw joint = rough_joint(30.0);
  joint.dashpots = {0.2, 0.3, 1e9};
  MovedBlocks m = square_on_base(joint);
  m.start();
  expect_closed_books(m, 600, wiggle, 1e-4);
  EXPECT_GT(m.damping(), 0.0);
}

/// Beyond the end of the base: the overlap grows and shrinks, its ends move.
TEST(MovingFace, ClosesTheEnergyBalanceWhileTheOverlapChanges) {
  MovedBlocks m = square_on_base(rough_joint(30.0));
  m.start(0.2);
  expect_closed_books(
      m, 1500,
      [](int n) {
        return Place{{1.3 - 0.1 * std::cos(0.005 * n), -depth * (1.0 + 0.4 * std::sin(0.034 * n))},
                     1e-5 * std::sin(0.027 * n)};
      },
      1e-3);
  EXPECT_NE(m.transfer(), 0.0);
}

/// Length that the overlap gains is free of stress: each spring grows, and its elastic slip
/// decreases by the same factor.
TEST(MovingFace, SpringsShiftWithTheOverlap) {
  MovedBlocks m = square_on_base(rough_joint(89.99));
  m.start(0.2);
  m.put_still(1, {{1.5, -depth}});
  double force = 0.0;
  for (const double overlap : {0.55, 0.60, 0.65}) {
    m.go(1, {{2.0 - overlap, -depth}});
    force += 1e9 * overlap * 0.05;
    EXPECT_NEAR(m.force_on(1).x, force, 1e-3 * force) << overlap;
  }
}

/// c = 2 zeta sqrt(p m) at each end, p the spring there and m the mass that the corner moves.
TEST(MovingFace, DashpotsAreThePartOfCriticalAskedFor) {
  JointLaw joint = rough_joint(80.0);
  const double across = 0.2, along = 0.1;
  joint.dashpots = {across, along, 1e9};
  MovedBlocks m = pressed_square(joint, depth);
  const double mass = 1.0 / m.masses.point_inverse[m.blocks.vertex_begin[1]];
  const double c = 2.0 * 2.0 * across * std::sqrt(1e9 * mass), d = 1e-7;
  m.go(1, {{0.0, -depth - d}});
  EXPECT_NEAR(m.force_on(1).y - 2e9 * (depth + d), c * d / m.step, 1e-6 * c * d / m.step);
  m.go(1, {{0.0, -depth}});
  EXPECT_NEAR(m.force_on(1).y - 2e9 * depth, -c * d / m.step, 1e-6 * c * d / m.step);
  m.go(1, {{-d, -depth}});
  const double mass_damping = 2.0 * 2.0 * along * std::sqrt(0.5e9 * mass) * d / m.step;
  EXPECT_NEAR(m.force_on(1).x, 1e9 * d + mass_damping, 1e-6 * mass_damping);
  // The implicit method has them in its matrix, too.
  const FaceStiffness s = face_stiffness(m.faces, m.scene(), m.step, {}, m.main_face());
  EXPECT_NEAR(s.normal.aa, 1e9 + 0.5 * c / m.step, 1e-6 * c / m.step);
  EXPECT_NEAR(s.normal.bb, 1e9 + 0.5 * c / m.step, 1e-6 * c / m.step);
  EXPECT_NEAR(s.shear_a, 0.5e9 + 0.5 * mass_damping / d, 1e-6 * mass_damping / d);
}

/// The lower right corner of a block sinks past the upper left corner of a base, from touching it
/// or from a place beside it. The side of the base must hold the block, however inclined its bottom
/// is, and the top of the base by as much as leaves a corner inside when the sides begin to
/// overlap.
void sink_past_a_corner(double bottom, double top, Vec2 corner) {
  const auto slope = [](double degrees) { return std::tan(degrees / 180.0 * std::numbers::pi); };
  MovedBlocks m;
  m.model.joints = {rough_joint(30.0)};
  m.model.contact.normal_stiffness = m.model.contact.shear_stiffness = 1e9;
  m.add({{0, -2}, {2, -2}, {2, -2.0 * slope(top)}, {0, 0}}, true);
  m.add({{-1, slope(bottom)}, {0, 0}, {-0.2, 1}, {-1, 1.2}});
  m.start(0.1);
  m.put_still(1, {corner});
  constexpr double step = 1e-4;
  for (; corner.x < 0.019; corner += step * Vec2{1.9, -1.0}) m.go(1, {corner});
  for (; corner.y > -0.05; corner.y -= step) m.go(1, {corner});
  // The two edges of about 1 m share a spring at each end, of which they use what overlaps.
  const double length = -corner.y, mean_closure = corner.x - 0.5 * 0.2 * length;
  constexpr Id side_of_base = 3, side_of_block = 5;
  const auto& f = m.faces;
  for (std::size_t k = 0; k < f.size(); ++k) {
    if (f.edge[k] != side_of_base || f.facing[k] != side_of_block) continue;
    EXPECT_GT(normal_force(m.row(k)), 0.9 * 2e9 * length * mean_closure) << bottom << " " << top;
  }
  EXPECT_LT(m.force_on(1).x, -0.9 * 2e9 * length * mean_closure) << bottom << " " << top;
  EXPECT_NEAR(m.work + m.balance(), 0.0, 0.01 * m.stored()) << bottom << " " << top;
}

TEST(MovingFace, ACornerThatSinksPastACornerIsHeldByTheSide) {
  for (const Vec2 from : {Vec2{-1e-3, 1e-3}, Vec2{0.019, 0.001}}) {
    for (const double bottom : {5.0, 10.0, 20.0, 30.0}) {
      for (const double top : {0.0, 10.0}) sink_past_a_corner(bottom, top, from);
    }
  }
}

/// A face that carries stays in the list, although its corners lie deeper than the list reaches.
TEST(MovingFace, StaysInTheListAsLongAsItCarries) {
  MovedBlocks m = pressed_square(rough_joint(30.0), depth);
  m.go(1, {{0.0, -depth}});
  const double force = m.force_on(1).y;
  m.search(0.1 * depth);
  EXPECT_EQ(m.force_on(1).y, force);
  m.go(1, {{0.0, 0.5}});
  m.search(0.1 * depth);
  EXPECT_EQ(m.faces.size(), 0u);
}

/// On a block that stands out over the edge of its base the two ends move different masses, and the
/// stiffer dashpot is that of the end which moves more.
TEST(MovingFace, DashpotsMoveTheMassOfTheirOwnEnd) {
  MovedBlocks m;
  m.model.deformation = BlockDeformation::corners;
  m.model.joints.push_back(rough_joint(30.0));
  m.model.joints[0].dashpots = {0.2, 0.0, 1e9};
  m.add({{-3, -1}, {0.4, -1}, {0.4, 0}, {-3, 0}}, true);
  m.add({{0, 0}, {1, 0}, {1, 1}, {0, 1}});
  m.start();
  m.put_still(1, {{0.0, -depth}});
  const double d = 1e-7;
  m.go(1, {{0.0, -depth - d}});
  const std::size_t k = m.main_face();
  const double spring = 0.5 * m.faces.stiffness[k] * m.now(k).length;
  const auto dashpot = [&](double x) {
    const NodeWeights w = weights_at(m.blocks, 1, Vec2{x, 0.0} - m.blocks.origin);
    double per_mass = 0.0;
    for (std::size_t n = 0; n < nodes_per_block; ++n)
      per_mass += w[n] * w[n] * m.masses.node_inverse[n][1];
    const BlockModes modes = m.blocks.modes(1);
    const double h = (1.0 - x) * modes.of(0, 0) + x * modes.of(0, 1);
    per_mass += h * h * m.masses.mode_inverse[1];
    return 0.4 * std::sqrt(spring / per_mass) * d / m.step;
  };
  const double low = std::min(m.now(k).damping_a, m.now(k).damping_b);
  const double high = std::max(m.now(k).damping_a, m.now(k).damping_b);
  EXPECT_GT(high, 1.2 * low);
  EXPECT_NEAR(low / dashpot(0.0), 1.0, 1e-4);
  EXPECT_NEAR(high / dashpot(0.4), 1.0, 1e-4);
  // The edge of the base begins at x = 0.4.
  const bool a_is_high = m.now(k).damping_a > m.now(k).damping_b;
  EXPECT_NEAR(a_is_high ? m.now(k).xi_a : m.now(k).xi_b, 0.0, 1e-3);
}

/// A dashpot that follows the pressure: N rebound v/strike, with the speed at which the end closed,
/// at most the linear one, and the strike is kept as the closing slows down.
TEST(MovingFace, DashpotsOfARestitutionFollowThePressure) {
  JointLaw joint = rough_joint(30.0);
  constexpr double rebound = 1.5;
  joint.dashpots = {50.0, 0.0, 1e9, rebound};
  constexpr double gap = 1e-5, fast = 2e-5, slow = 2e-6;
  MovedBlocks m = pressed_square(joint, -gap);
  m.go(1, {{0.0, gap - fast}});
  m.go(1, {{0.0, gap - fast - slow}});
  const std::size_t k = m.main_face();
  FaceFields now = m.now(k);
  EXPECT_NEAR(now.strike_a * m.step, fast, 1e-2 * fast);
  EXPECT_NEAR(now.damping_a / (rebound * now.normal_a * slow / (now.strike_a * m.step)), 1.0, 1e-9);
  // As it leaves, it is pulled by no more than its pressure.
  m.go(1, {{0.0, -slow}});
  now = m.now(k);
  EXPECT_LT(now.damping_a, 0.0);
  EXPECT_GE(now.damping_a + now.normal_a, 0.0);
}

/// The force of the dashpot does not depend on the distance of the block a step before.
TEST(MovingFace, DashpotsBeginWhereBlocksTouch) {
  JointLaw joint = rough_joint(30.0);
  joint.dashpots = {0.2, 0.0, 1e9};
  MovedBlocks m = pressed_square(joint, -5e-3);
  m.go(1, {{0.0, -1e-7}});
  const double mass = 1.0 / m.masses.point_inverse[m.blocks.vertex_begin[1]];
  const double whole = 2e9 * 1e-7 + 4.0 * 0.2 * std::sqrt(1e9 * mass) * 1e-7 / m.step;
  EXPECT_NEAR(m.force_on(1).y, whole, 1e-6 * whole);
}

/// Cohesion needs surfaces: edges at 3 degrees have all of it, edges at 9 degrees none.
TEST(MovingFace, CohesionNeedsSurfacesThatLieAlongEachOther) {
  for (const double degrees : {0.0, 3.0, 9.0}) {
    MovedBlocks m = square_on_base(rough_joint(0.0, 1e5));
    m.start(0.3);
    const double tilt = degrees * std::numbers::pi / 180.0;
    m.put_still(1, {{0.0, 0.5 * (std::sin(tilt) + std::cos(tilt) - 1.0) - depth}, tilt});
    ASSERT_GT(m.force_on(1).y, 0.0);
    for (int n = 1; n <= 40; ++n) {
      m.go(1, {{1e-5 * n, 0.5 * (std::sin(tilt) + std::cos(tilt) - 1.0) - depth}, tilt});
    }
    const std::size_t k = m.main_face();
    const double cohesion = shear_strength(m.row(k));
    EXPECT_NEAR(cohesion, degrees < 5.0 ? 1e5 : 0.0, 2e-3 * 1e5) << degrees;
    EXPECT_LE(std::abs(shear_force(m.row(k))), (1.0 + 1e-9) * cohesion) << degrees;
  }
}

/// The last step is made shorter: an end that sticks keeps its force, in the next step, too.
TEST(MovingFace, AChangeOfTheStepKeepsTheForceOfWhatSticks) {
  MovedBlocks m = pressed_square(rough_joint(80.0), depth);
  for (int n = 1; n <= 5; ++n) m.go(1, {{1e-6 * n, -depth - 1e-6 * n}});
  const double force = m.force_on(1).x;
  const std::size_t k = m.main_face();
  const std::vector<double> old_x1 = m.pose.x1, old_y1 = m.pose.y1;
  for (std::size_t v = 0; v < m.pose.x.size(); ++v) {
    m.pose.x1[v] = 0.5 * (m.pose.x[v] + m.pose.x1[v]);
    m.pose.y1[v] = 0.5 * (m.pose.y[v] + m.pose.y1[v]);
  }
  m.change([&](const FaceSet& faces, FaceStates& states) {
    correct_last_step(faces, states, m.blocks, m.pose, old_x1, old_y1);
    EXPECT_NEAR(states.before[k].closure_a, depth + 4.5e-6, 1e-12);
    EXPECT_NEAR(states.before[k].closure_b, depth + 4.5e-6, 1e-12);
  });
  m.evaluate_from(0.5 * m.step);
  EXPECT_NEAR(m.force_on(1).x, force, 1e-9 * std::abs(force));
}

/// What touched at neither step has no slip, however the step is changed.
TEST(MovingFace, AChangeOfTheStepLeavesNoSlipWhereNothingTouches) {
  MovedBlocks m = pressed_square(rough_joint(80.0), -1e-3);
  for (int n = 1; n <= 3; ++n) m.go(1, {{1e-4 * n, 1e-3}});
  const std::vector<double> old_x1 = m.pose.x1, old_y1 = m.pose.y1;
  m.pose.x1 = m.pose.x;
  m.change([&](const FaceSet& faces, FaceStates& states) {
    correct_last_step(faces, states, m.blocks, m.pose, old_x1, old_y1);
    for (const FaceFields& before : states.before) {
      EXPECT_EQ(before.slip_a, 0.0);
      EXPECT_EQ(before.slip_b, 0.0);
    }
  });
}

/// Coulomb's limit is that of the part alpha of the normal force.
TEST(MovingFace, IsCutAnewUnderAPartOfItsNormalForce) {
  MovedBlocks m = pressed_square(rough_joint(30.0), depth);
  for (int n = 1; n <= 20; ++n) m.go(1, {{2e-5 * n, -depth}});
  const std::size_t k = m.main_face();
  const FacePoints at = face_points(m.faces, m.pose.x, m.pose.y, k),
                   then = face_points(m.faces, m.pose.x1, m.pose.y1, k);
  const Face face = face_at(m.faces, m.blocks, m.pose.x, m.pose.y, k);
  next_step(m.faces, m.tiled.tiles);
  recall_work(m.faces, m.tiled.tiles);
  const double friction = m.faces.friction_work[k], transfer = m.faces.transfer[k];
  FaceFields before = m.before(k);
  const CornerForces half = recompute_shear(m.faces, before, face, at, then, 0.5, k);
  const double normal = 2e9 * depth, limit = mu * normal;
  const Vec2 on = half.q1 + half.q2;
  EXPECT_NEAR(on.y, 0.5 * normal, 1e-9 * normal);
  EXPECT_NEAR(on.x, -0.5 * limit, 1e-9 * limit);
  // Force by force: half of the pressure, and the shear.
  const CornerForces shear = end_forces(at, face, {}, {before.shear_a, before.shear_b});
  EXPECT_NEAR(norm(half.p1 - 0.5 * face.force.p1 - shear.p1), 0.0, 1e-9 * normal);
  EXPECT_NEAR(norm(half.p2 - 0.5 * face.force.p2 - shear.p2), 0.0, 1e-9 * normal);
  // It slips further by limit/2k, from T_{n-1} = limit to T_n = limit/2; before, both were at the
  // limit.
  const double ks = 1e9, slip = 2e-5;
  const double taken = 0.75 * limit * (slip + 0.5 * limit / ks) - limit * slip;
  EXPECT_NEAR(m.faces.friction_work[k] - friction, taken, 1e-6 * limit * slip);
  // The overlap does not change, so no other energy is lost.
  EXPECT_NEAR(m.faces.transfer[k] - transfer, 0.0, 1e-6 * limit * slip);
}

/// A step that reverses the shear: with u_{n-1} = l, l = limit/k, and a trial slip of -2 l, the
/// energy that the spring loses beyond friction is transfer: k u_n (-3 l - u_n)/2, u_n = -l or,
/// halved, -l/2.
TEST(MovingFace, AccountsForTheTransferOfWhatIsCutAnew) {
  MovedBlocks m = pressed_square(rough_joint(30.0), depth);
  for (int n = 1; n <= 20; ++n) m.go(1, {{2e-5 * n, -depth}});
  const double limit = mu * 2e9 * depth, l = limit / 1e9;
  m.go(1, {{4e-4 - 3.0 * l, -depth}});
  EXPECT_NEAR(m.force_on(1).x, limit, 1e-9 * limit);
  const std::size_t k = m.main_face();
  const FacePoints at = face_points(m.faces, m.pose.x, m.pose.y, k),
                   then = face_points(m.faces, m.pose.x1, m.pose.y1, k);
  const Face face = face_at(m.faces, m.blocks, m.pose.x, m.pose.y, k);
  next_step(m.faces, m.tiled.tiles);
  recall_work(m.faces, m.tiled.tiles);
  const double friction = m.friction(), transfer = m.transfer();
  FaceFields before = m.before(k);
  recompute_shear(m.faces, before, face, at, then, 0.5, k);
  EXPECT_NEAR(m.friction(), friction, 1e-9 * limit * l);
  EXPECT_NEAR(m.transfer() - transfer, (0.625 - 1.0) * limit * l, 1e-6 * limit * l);
}

}  // namespace
}  // namespace edda::moving_face_test
