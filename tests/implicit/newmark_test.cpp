// Steps of a block that touches nothing: its parabola, its spin, and its books.
#include "implicit/newmark.hpp"

#include <gtest/gtest.h>

#include "forces/bending_forces.hpp"
#include "forces/elastic.hpp"
#include "forces/viscosity.hpp"
#include "implicit/implicit_blocks.hpp"

namespace edda::newmark_test {
namespace {

struct Flying : test::ImplicitBlocks {
  Vec2 gravity;
  std::vector<double> damping_work{0.0};
  ModeVectors locked;

  Flying(double spin, Vec2 velocity, Vec2 g, double mass_damping, const std::string& more = "")
      : ImplicitBlocks(R"(
[materials.rock]
density = 2500.0
young = 2e8
poisson = 0.2
[joints.j]
friction_angle = 30.0
[[block]]
polygon = [[0, 0], [2, 0.2], [1.8, 1.1], [-0.1, 0.9]]
[solver]
duration = 1.0
)" + more),
        gravity(g) {
    const Vec2 c = centroid(state.position, 0);
    for (std::size_t k = 0; k < 3; ++k) {
      state.velocity.x[k][0] = velocity.x - spin * (state.position.y[k][0] - c.y);
      state.velocity.y[k][0] = velocity.y + spin * (state.position.x[k][0] - c.x);
    }
    state.position.modes.set(0, {2e-3, -1e-3});  // it swings
    place();
    pose.x1 = pose.x;
    pose.y1 = pose.y;
    settings.step = 1e-3;
    settings.damping.mass = mass_damping;
    settings.displacement_limit = 0.1;
    settings.balance = 1e-9;
  }
  void go() {
    const ImplicitScene at{blocks, masses, laws, springs, gravity, {}, locked};
    ASSERT_EQ(newmark_step(solver, at, settings, state, pose, trial(), forces, damping_work),
              Attempt::accepted);
    pose.x1 = pose.x;
    pose.y1 = pose.y;
  }
  BodyColumn velocity() const { return column_of(blocks, state.velocity, 0); }
  BodyColumn momentum() const { return body_mass(blocks, masses, 0) * velocity(); }
  double spin_momentum() const {
    const BodyColumn p = momentum(), x = column_of(blocks, state.position, 0);
    double sum = 0.0;
    for (Eigen::Index at = 0; at < p.size(); at += 2) sum += x[at] * p[at + 1] - x[at + 1] * p[at];
    return sum;
  }
  double energy() const {
    return 0.5 * velocity().dot(momentum()) + stored_energy(blocks, state, {&locked}, 0.0, 0) -
           blocks.mass[0] * dot(gravity, centroid(state.position, 0)) +
           boundary_energy(springs, pose);
  }
};

TEST(Newmark, FollowsTheParabola) {
  const Vec2 velocity{1.0, 2.0}, gravity{0.5, -9.81};
  Flying f(0.0, velocity, gravity, 0.0);
  const Vec2 start = centroid(f.state.position, 0);
  for (int n = 0; n < 20; ++n) f.go();
  const double t = 20e-3;
  const Vec2 end = start + t * velocity + 0.5 * t * t * gravity;
  EXPECT_NEAR(norm(centroid(f.state.position, 0) - end), 0.0, 1e-9);
  EXPECT_NEAR(norm(centroid(f.state.velocity, 0) - (velocity + t * gravity)), 0.0, 1e-8);
}

TEST(Newmark, KeepsItsSpin) {
  Flying f(20.0, {1.0, -2.0}, {}, 0.0);
  const double spin = f.spin_momentum();
  for (int n = 0; n < 100; ++n) f.go();
  EXPECT_NEAR(f.spin_momentum(), spin, 1e-7 * std::abs(spin));
}

/// What is kinetic, strain and weight, and what the method and mass damping took.
TEST(Newmark, BooksEveryJoule) {
  for (const double mass_damping : {0.0, 3.0}) {
    Flying f(20.0, {1.0, -2.0}, {0.5, -9.81}, mass_damping);
    const double start = f.energy();
    for (int n = 0; n < 50; ++n) f.go();
    const double taken = start - f.energy();
    EXPECT_NEAR(f.damping_work[0], taken, 1e-6 * std::abs(start)) << mass_damping;
    if (mass_damping == 0.0) continue;
    // It has no other loss worth the name: m a v^2 and I a w^2 in 50 ms.
    EXPECT_GT(f.damping_work[0], 1e-2 * start);
  }
}

/// A force that is locked in its modes, and strain that is damped: momentum and energy stay booked.
TEST(Newmark, BooksWhatIsLockedAndDamped) {
  for (const bool damped : {false, true}) {
    Flying f(20.0, {1.0, -2.0}, {}, 0.0);
    if (damped) fill_viscosity(f.masses, f.blocks, {});
    f.locked.assign(f.blocks.bending.modes(), 0.0);
    f.locked.set(0, {3e5, -2e5});
    const double start = f.energy(), spin = f.spin_momentum();
    for (int n = 0; n < 50; ++n) f.go();
    EXPECT_NEAR(f.damping_work[0], start - f.energy(), 1e-6 * std::abs(start)) << damped;
    EXPECT_GT(f.damping_work[0], 1e-4 * start);
    EXPECT_NEAR(f.spin_momentum(), spin, 1e-6 * std::abs(spin)) << damped;
  }
}

const std::string on_springs =
    "[[boundary]]\nalong = [[0, 0], [2, 0.2]]\ntype = 'fixed'\nstiffness = 2e7\n";

TEST(Newmark, BooksTheSpringsOfBoundaries) {
  Flying f(5.0, {1.0, -2.0}, {0.5, -9.81}, 0.0, on_springs);
  const double start = f.energy();
  for (int n = 0; n < 50; ++n) f.go();
  EXPECT_NEAR(f.damping_work[0], start - f.energy(), 1e-6 * std::abs(start));
  EXPECT_GT(boundary_energy(f.springs, f.pose), 0.0);
}

/// Without dynamics every step ends at rest: all motion is taken.
TEST(Newmark, BooksTheMotionThatItDrops) {
  Flying f(0.0, {}, {0.0, -9.81}, 0.0, on_springs);
  f.settings.dynamic = false;
  const double start = f.energy();
  for (int n = 0; n < 5; ++n) f.go();
  EXPECT_EQ(f.state.velocity.y[0][0], 0.0);
  EXPECT_GT(f.damping_work[0], 0.0);
  EXPECT_NEAR(f.damping_work[0], start - f.energy(), 1e-3 * f.damping_work[0]);
}

}  // namespace
}  // namespace edda::newmark_test
