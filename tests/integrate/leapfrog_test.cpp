#include "integrate/leapfrog.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "blocks/build_blocks.hpp"

namespace edda::leapfrog_test {
namespace {

struct OneBlock {
  BlockSet blocks;
  Masses masses;
  State state;
  BodyVectors force;

  void advance(double h_old, double h_new, const StepDamping& damping) {
    edda::advance(state, {blocks, masses, force, state.velocity, h_old, h_new, damping});
  }
  void book(const BodyVectors& before, double h_old, double h_new, const StepDamping& damping,
            DampingWork& work) const {
    account_damping(state, {blocks, masses, force, before, h_old, h_new, damping}, work);
  }
};

OneBlock one_block(MassKind kind = MassKind::matched, Vec2 velocity = {}) {
  Model model;
  model.solver.mass = kind;
  model.materials.push_back({"rock", 1000.0, 1e9, 0.2, {}});
  PolygonSet set;
  BlockPolygon p;
  p.rings = {{{0, 0}, {2, 0}, {2, 1}, {0, 1}}};
  p.joint = {std::vector<Index>(4, none)};
  p.material = 0;
  p.velocity = velocity;
  set.blocks.push_back(p);
  OneBlock o;
  o.blocks = build_blocks(model, set);
  o.masses = given_masses(o.blocks);
  o.state = initial_state(o.blocks, set);
  o.force = zero_vectors(o.blocks);
  return o;
}

TEST(Leapfrog, UniformAccelerationIsExact) {
  for (MassKind kind : {MassKind::matched, MassKind::covering, MassKind::consistent}) {
    OneBlock o = one_block(kind, {1.0, 2.0});
    for (std::size_t k = 0; k < 3; ++k) o.force.y[k][0] = -9.81 * o.blocks.mass[0] / 3.0;
    const double h = 0.01;
    start_velocities(o.state, o.blocks, o.masses, o.force, h);
    for (int n = 0; n < 100; ++n) o.advance(h, h, {});
    const Vec2 c = centroid(o.state.position, 0);
    EXPECT_NEAR(c.x, 1.0 + 1.0, 1e-12);
    EXPECT_NEAR(c.y, 0.5 + 2.0 - 0.5 * 9.81, 1e-12);
  }
}

TEST(Leapfrog, AChangeOfStepKeepsTheParabola) {
  OneBlock o = one_block();
  for (std::size_t k = 0; k < 3; ++k) o.force.y[k][0] = -10.0 * o.blocks.mass[0] / 3.0;
  double h = 0.01, time = 0.0;
  start_velocities(o.state, o.blocks, o.masses, o.force, h);
  for (int n = 0; n < 60; ++n) {
    const double next = n % 7 == 3 ? 0.5 * h : n % 7 == 6 ? 2.0 * h : h;
    o.advance(h, next, {});
    time += next;
    h = next;
  }
  // v_{n+1/2} = v_{n-1/2} + a (h_old + h_new)/2 samples the exact velocity at every half step.
  const double v = centroid(o.state.velocity, 0).y;
  EXPECT_NEAR(v, -10.0 * (time - 0.5 * h), 1e-10);
}

TEST(Leapfrog, MassDampingDecaysAsTheFormulaSays) {
  OneBlock o = one_block(MassKind::matched, {1.0, 0.0});
  const double a = 3.0, h = 0.01;
  DampingWork work{{0.0}};
  const double start = kinetic_energy(o.masses, o.blocks, o.state.velocity, 0);
  for (int n = 0; n < 100; ++n) {
    const BodyVectors before = o.state.velocity;
    o.advance(h, h, {a, 0.0});
    o.book(before, h, h, {a, 0.0}, work);
  }
  const double factor = std::pow((1.0 - 0.5 * a * h) / (1.0 + 0.5 * a * h), 100.0);
  EXPECT_NEAR(centroid(o.state.velocity, 0).x, factor, 1e-12);
  const double end = kinetic_energy(o.masses, o.blocks, o.state.velocity, 0);
  EXPECT_NEAR(work.joules[0] + end, start, 1e-9 * start);
}

TEST(Leapfrog, LocalDampingTakesItsFractionOfTheForce) {
  OneBlock o = one_block(MassKind::matched, {1.0, 0.0});
  for (std::size_t k = 0; k < 3; ++k) o.force.x[k][0] = 100.0;
  const double h = 1e-3, before = o.state.velocity.x[0][0];
  o.advance(h, h, {0.0, 0.8});
  EXPECT_NEAR(o.state.velocity.x[0][0] - before, 0.2 * 100.0 * h / o.masses.node[0][0], 1e-12);
}

TEST(Leapfrog, RetreatBringsBackWhereItWas) {
  OneBlock o = one_block(MassKind::matched, {1.0, -3.0});
  o.force.x[1][0] = 5e4;
  const State before = o.state;
  o.advance(0.01, 0.01, {1.0, 0.5});
  undo_step(o.state, 0.01, before.velocity);
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_NEAR(o.state.position.x[k][0], before.position.x[k][0], 1e-15);
    EXPECT_NEAR(o.state.position.y[k][0], before.position.y[k][0], 1e-15);
    EXPECT_EQ(o.state.velocity.x[k][0], before.velocity.x[k][0]);
  }
}

/// Against the velocity in either component, whatever its sign.
TEST(Leapfrog, LocalDampingIsAgainstTheVelocity) {
  for (const Vec2 v : {Vec2{1.0, 2.0}, Vec2{-1.0, 2.0}, Vec2{1.0, -2.0}, Vec2{-1.0, -2.0}}) {
    OneBlock o = one_block(MassKind::matched, v);
    o.force.x[0][0] = 100.0;
    o.force.y[0][0] = -300.0;
    const double h = 1e-3, mass = o.masses.node[0][0];
    const State before = o.state;
    o.advance(h, h, {0.0, 0.8});
    const Vec2 sign{std::copysign(1.0, v.x), std::copysign(1.0, v.y)};
    EXPECT_NEAR(o.state.velocity.x[0][0] - before.velocity.x[0][0],
                (100.0 - 80.0 * sign.x) * h / mass, 1e-12);
    EXPECT_NEAR(o.state.velocity.y[0][0] - before.velocity.y[0][0],
                (-300.0 - 240.0 * sign.y) * h / mass, 1e-12);
  }
}

/// Force of the damping times (x_{n+1} - x_{n-1})/2, with two steps that differ.
TEST(Leapfrog, BooksTheWorkOfDampingOverBothSteps) {
  const double h_old = 0.01, h_new = 0.03, beta = 0.8, a = 2.0;
  for (const StepDamping& damping : {StepDamping{0.0, beta}, StepDamping{a, 0.0}}) {
    OneBlock o = one_block(MassKind::matched, {1.0, -2.0});
    o.force.x[1][0] = 5e4;
    o.force.y[1][0] = 3e4;
    const BodyVectors old = o.state.velocity;
    DampingWork work{{0.0}};
    o.advance(h_old, h_new, damping);
    o.book(old, h_old, h_new, damping, work);
    double expected = 0.0;
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec2 before{old.x[k][0], old.y[k][0]},
          after{o.state.velocity.x[k][0], o.state.velocity.y[k][0]};
      const Vec2 moved = 0.5 * (h_old * before + h_new * after);
      const Vec2 local = beta * Vec2{o.force.x[k][0], -o.force.y[k][0]};  // they move to +x and -y
      const Vec2 mass_damping = a * o.masses.node[k][0] * 0.5 * (before + after);
      expected += dot(damping.local > 0.0 ? local : mass_damping, moved);
    }
    EXPECT_GT(work.joules[0], 0.0);
    EXPECT_NEAR(work.joules[0], expected, 1e-12 * expected);
  }
}

/// v_{-1/2} = v_0 - (f/m - a v_0) h/2.
TEST(Leapfrog, StartsHalfAStepBackWithItsDamping) {
  OneBlock o = one_block(MassKind::matched, {1.0, -2.0});
  o.force.x[2][0] = 700.0;
  o.force.y[2][0] = 900.0;
  const double h = 0.01, a = 3.0, mass = o.masses.node[2][0];
  start_velocities(o.state, o.blocks, o.masses, o.force, h, {.mass = a});
  EXPECT_NEAR(o.state.velocity.x[2][0], 1.0 - 0.5 * h * (700.0 / mass - a), 1e-12);
  EXPECT_NEAR(o.state.velocity.y[2][0], -2.0 - 0.5 * h * (900.0 / mass + 2.0 * a), 1e-12);
}

}  // namespace
}  // namespace edda::leapfrog_test
