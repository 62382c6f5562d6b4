// Faces under an initial stress, and which faces act.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "contacts/face_preload.hpp"
#include "contacts/moved_blocks.hpp"

namespace edda::preload_test {
namespace {

using test::MovedBlocks;
using test::Place;
using test::rough_joint;

/// A square from x = `from` on, on a base that ends at x = 2; the ground presses it by p0 + p1 (x -
/// from) Pa and shears it by tau.
struct Pressed : MovedBlocks {
  double from, p0, p1, tau;

  Pressed(const JointLaw& joint, double at, double pressure, double more, double shear)
      : MovedBlocks(test::square_on_base(joint)), from(at), p0(pressure), p1(more), tau(shear) {
    set.blocks[1].rings = {{{from, 0}, {from + 1, 0}, {from + 1, 1}, {from, 1}}};
    start(0.2);
    const auto traction = [&](Id edge, double s0, double s1) { return on(edge, s0, s1); };
    change([&](FaceSet& of, FaceStates& states) {
      joints = preload_faces(of, states, blocks, pose, laws, traction);
    });
    evaluate_from(step);
  }
  /// Forces of the stress on the edge from s0 to s1, which must be horizontal at y = 0.
  EndForces on(Id edge, double s0, double s1) const {
    const Vec2 a = blocks.vertex(edge), u = blocks.vertex(blocks.next[edge]) - a;
    if (a.y != 0.0 || u.y != 0.0) return {};
    const double way = u.x > 0.0 ? 1.0 : -1.0;  // on the square; on the base
    const auto traction = [&](double s) {
      return way * Vec2{tau, p0 + p1 * (a.x + s * u.x - from)};
    };
    const double length = (s1 - s0) * std::abs(u.x);
    const Vec2 t0 = traction(s0), t1 = traction(s1);
    return {length / 6.0 * (2.0 * t0 + t1), length / 6.0 * (t0 + 2.0 * t1)};
  }
  std::vector<JointStress> joints;
};

TEST(Preload, PushesBlocksWithTheTractionAndNothingElse) {
  JointLaw measured = rough_joint(40.0);
  measured.kn = 2e9;
  measured.ks = 1e9;
  for (const JointLaw& joint : {rough_joint(40.0), measured}) {
    for (const double p1 : {0.0, 6e5}) {
      const double p0 = 1e6, tau = 2e5;
      const Pressed m(joint, 0.0, p0, p1, tau);
      const std::size_t k = m.main_face();
      const CornerForces on = m.row(k).force;
      EXPECT_NEAR((on.q1 + on.q2).x, tau, (p1 == 0.0 ? 1e-6 : 2e-4) * p0);
      EXPECT_NEAR((on.q1 + on.q2).y, p0 + 0.5 * p1, 1e-6 * p0);
      // On the square's corners, the forces with the same resultant and moment.
      EXPECT_NEAR(on.q1.y, p0 / 2.0 + p1 / 6.0, 2e-4 * p0);
      EXPECT_NEAR(on.q2.y, p0 / 2.0 + p1 / 3.0, 2e-4 * p0);
      EXPECT_NEAR(m.joints[0].mobilised, tau / (p0 + 0.5 * p1) / std::tan(40.0 * M_PI / 180.0),
                  1e-9);
      if (p1 > 0.0) continue;
      // No corner is pushed along the face: k o^2/2 at either end would be 250 N.
      EXPECT_NEAR(on.q1.x, 0.5 * tau, 1.0);
      EXPECT_NEAR(on.q2.x, 0.5 * tau, 1.0);
    }
  }
}

/// Edges keep the pressure at their corners, for faces that form later.
TEST(Preload, LocksThePressureIntoEdges) {
  JointLaw joint = rough_joint(40.0);
  joint.kn = 2e9;
  const double p0 = 1e6, p1 = 6e5;
  const Pressed m(joint, 0.0, p0, p1, 0.0);
  const std::size_t k = m.main_face();
  const Face face = face_at(m.faces, m.blocks, m.pose.x, m.pose.y, k);
  const FaceEnds locked = locked_closure(m.faces, face, k);
  const auto pressure = [&](double eta) { return p0 + p1 * (1.0 - eta); };  // eta from q2
  EXPECT_NEAR(locked.a, pressure(face.eta.a) / 2e9, 1e-9 * p0 / 2e9);
  EXPECT_NEAR(locked.b, pressure(face.eta.b) / 2e9, 1e-9 * p0 / 2e9);
}

/// The square extends by half beyond the end of the base, so that the overlap changes.
TEST(Preload, AccountsForTheForcesThatItRemoves) {
  Pressed m(rough_joint(30.0), 1.4, 4e5, 0.0, 0.0);
  end_at_rest(m.faces, m.tiled.tiles, m.blocks, m.pose);
  const auto place = [](int n) {
    return Place{{4e-2 * std::sin(0.004 * n), -4e-5 * std::sin(0.034 * n)}};
  };
  for (int n = 1; n <= 2; ++n) m.go(1, place(n));
  const double start = m.balance() + m.work;
  double most = 0.0;
  for (int n = 3; n <= 400; ++n) {
    m.go(1, place(n));
    most = std::max(most, std::abs(m.balance() + m.work - start));
  }
  EXPECT_LT(most, 1e-4 * m.friction());
  EXPECT_GT(m.friction(), 0.0);
}

/// Two plates thinner than they are long lie on each other: their far sides are opposed, too, and
/// penetrate each other deeply.
TEST(JudgeFace, FarSidesDoNotAct) {
  MovedBlocks m;
  m.model.joints = {rough_joint(30.0)};
  m.model.contact.normal_stiffness = m.model.contact.shear_stiffness = 1e9;
  m.add({{0, 0}, {1, 0}, {1, 0.02}, {0, 0.02}}, true);
  m.add({{0.2, 0.02}, {0.8, 0.02}, {0.8, 0.04}, {0.2, 0.04}});
  m.start(0.05);
  const double depth = 1e-5;
  m.put_still(1, {{0.0, -depth}});
  EXPECT_NEAR(m.force_on(1).y, 2e9 * depth, 1e-6 * 2e9 * depth);
  int far = 0;
  for (std::size_t k = 0; k < m.faces.size(); ++k) {
    if (m.now(k).closure_a < 0.01) continue;
    ++far;
    EXPECT_FALSE(m.faces.acts(k));
    EXPECT_EQ(m.now(k).energy, 0.0);
  }
  EXPECT_GT(far, 0);
}

/// Between two wedges that meet at a point of five, but are not neighbours, lies a third.
TEST(JudgeFace, NothingLeansAcrossAThirdBlock) {
  MovedBlocks m;
  m.model.joints = {rough_joint(30.0)};
  m.model.contact.normal_stiffness = m.model.contact.shear_stiffness = 1e9;
  const auto ray = [](int q) {
    const double angle = 2.0 * std::numbers::pi * q / 5.0;
    return Vec2{std::cos(angle), std::sin(angle)};
  };
  for (int q = 0; q < 5; ++q) m.add({{0, 0}, ray(q), ray(q + 1)});
  m.start(0.05);
  for (std::size_t i = 0; i < 5; ++i) {
    const Vec2 inwards = -1e-5 * Vec2{m.blocks.centroid_x[i], m.blocks.centroid_y[i]};
    m.put(i, {inwards});
  }
  m.evaluate();
  int across = 0, beside = 0;
  for (std::size_t k = 0; k < m.faces.size(); ++k) {
    if (!(m.now(k).energy > 0.0)) continue;
    const auto [i, j] = blocks_of_face(m.blocks, m.faces, k);
    const bool neighbours = j - i == 1 || j - i == 4;
    EXPECT_EQ(m.faces.leans(k), neighbours) << i << ' ' << j;
    (neighbours ? beside : across) += 1;
  }
  EXPECT_EQ(beside, 5);
  EXPECT_GT(across, 0);
}

}  // namespace
}  // namespace edda::preload_test
