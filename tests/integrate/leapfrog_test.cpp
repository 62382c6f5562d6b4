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
  Nodes fx, fy;

  void advance(double h_old, double h_new, const StepDamping& damping) {
    edda::advance(state, {blocks, masses, fx, fy, state.vx, state.vy, h_old, h_new, damping});
  }
  void book(const Nodes& vx, const Nodes& vy, double h_old, double h_new,
            const StepDamping& damping, DampingWork& work) const {
    account_damping(state, {blocks, masses, fx, fy, vx, vy, h_old, h_new, damping}, work);
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
  for (std::size_t k = 0; k < 3; ++k) o.fx[k] = o.fy[k] = {0.0};
  return o;
}

TEST(Leapfrog, UniformAccelerationIsExact) {
  for (MassKind kind : {MassKind::matched, MassKind::covering, MassKind::consistent}) {
    OneBlock o = one_block(kind, {1.0, 2.0});
    for (std::size_t k = 0; k < 3; ++k) o.fy[k][0] = -9.81 * o.blocks.mass[0] / 3.0;
    const double h = 0.01;
    start_velocities(o.state, o.blocks, o.masses, o.fx, o.fy, h);
    for (int n = 0; n < 100; ++n) o.advance(h, h, {});
    const Vec2 c = centroid(o.state.x, o.state.y, 0);
    EXPECT_NEAR(c.x, 1.0 + 1.0, 1e-12);
    EXPECT_NEAR(c.y, 0.5 + 2.0 - 0.5 * 9.81, 1e-12);
  }
}

TEST(Leapfrog, AChangeOfStepKeepsTheParabola) {
  OneBlock o = one_block();
  for (std::size_t k = 0; k < 3; ++k) o.fy[k][0] = -10.0 * o.blocks.mass[0] / 3.0;
  double h = 0.01, time = 0.0;
  start_velocities(o.state, o.blocks, o.masses, o.fx, o.fy, h);
  for (int n = 0; n < 60; ++n) {
    const double next = n % 7 == 3 ? 0.5 * h : n % 7 == 6 ? 2.0 * h : h;
    o.advance(h, next, {});
    time += next;
    h = next;
  }
  // v_{n+1/2} = v_{n-1/2} + a (h_old + h_new)/2 samples the exact velocity at every half step.
  const double v = centroid(o.state.vx, o.state.vy, 0).y;
  EXPECT_NEAR(v, -10.0 * (time - 0.5 * h), 1e-10);
}

TEST(Leapfrog, MassDampingDecaysAsTheFormulaSays) {
  OneBlock o = one_block(MassKind::matched, {1.0, 0.0});
  const double a = 3.0, h = 0.01;
  DampingWork work{{0.0}};
  const double start = kinetic_energy(o.masses, o.state.vx, o.state.vy, 0);
  for (int n = 0; n < 100; ++n) {
    const Nodes vx = o.state.vx, vy = o.state.vy;
    o.advance(h, h, {a, 0.0});
    o.book(vx, vy, h, h, {a, 0.0}, work);
  }
  const double factor = std::pow((1.0 - 0.5 * a * h) / (1.0 + 0.5 * a * h), 100.0);
  EXPECT_NEAR(centroid(o.state.vx, o.state.vy, 0).x, factor, 1e-12);
  const double end = kinetic_energy(o.masses, o.state.vx, o.state.vy, 0);
  EXPECT_NEAR(work.joules[0] + end, start, 1e-9 * start);
}

TEST(Leapfrog, LocalDampingTakesItsFractionOfTheForce) {
  OneBlock o = one_block(MassKind::matched, {1.0, 0.0});
  for (std::size_t k = 0; k < 3; ++k) o.fx[k][0] = 100.0;
  const double h = 1e-3, before = o.state.vx[0][0];
  o.advance(h, h, {0.0, 0.8});
  EXPECT_NEAR(o.state.vx[0][0] - before, 0.2 * 100.0 * h / o.masses.node[0][0], 1e-12);
}

TEST(Leapfrog, RetreatBringsBackWhereItWas) {
  OneBlock o = one_block(MassKind::matched, {1.0, -3.0});
  o.fx[1][0] = 5e4;
  const State before = o.state;
  o.advance(0.01, 0.01, {1.0, 0.5});
  undo_step(o.state, o.blocks, 0.01, before.vx, before.vy);
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_NEAR(o.state.x[k][0], before.x[k][0], 1e-15);
    EXPECT_NEAR(o.state.y[k][0], before.y[k][0], 1e-15);
    EXPECT_EQ(o.state.vx[k][0], before.vx[k][0]);
  }
}

/// Against the velocity in either component, whatever its sign.
TEST(Leapfrog, LocalDampingIsAgainstTheVelocity) {
  for (const Vec2 v : {Vec2{1.0, 2.0}, Vec2{-1.0, 2.0}, Vec2{1.0, -2.0}, Vec2{-1.0, -2.0}}) {
    OneBlock o = one_block(MassKind::matched, v);
    o.fx[0][0] = 100.0;
    o.fy[0][0] = -300.0;
    const double h = 1e-3, mass = o.masses.node[0][0];
    const State before = o.state;
    o.advance(h, h, {0.0, 0.8});
    const Vec2 sign{std::copysign(1.0, v.x), std::copysign(1.0, v.y)};
    EXPECT_NEAR(o.state.vx[0][0] - before.vx[0][0], (100.0 - 80.0 * sign.x) * h / mass, 1e-12);
    EXPECT_NEAR(o.state.vy[0][0] - before.vy[0][0], (-300.0 - 240.0 * sign.y) * h / mass, 1e-12);
  }
}

/// Force of the damping times (x_{n+1} - x_{n-1})/2, with two steps that differ.
TEST(Leapfrog, BooksTheWorkOfDampingOverBothSteps) {
  const double h_old = 0.01, h_new = 0.03, beta = 0.8, a = 2.0;
  for (const StepDamping& damping : {StepDamping{0.0, beta}, StepDamping{a, 0.0}}) {
    OneBlock o = one_block(MassKind::matched, {1.0, -2.0});
    o.fx[1][0] = 5e4;
    o.fy[1][0] = 3e4;
    const Nodes vx = o.state.vx, vy = o.state.vy;
    DampingWork work{{0.0}};
    o.advance(h_old, h_new, damping);
    o.book(vx, vy, h_old, h_new, damping, work);
    double expected = 0.0;
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec2 before{vx[k][0], vy[k][0]}, after{o.state.vx[k][0], o.state.vy[k][0]};
      const Vec2 moved = 0.5 * (h_old * before + h_new * after);
      const Vec2 local = beta * Vec2{o.fx[k][0], -o.fy[k][0]};  // they move to +x and -y
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
  o.fx[2][0] = 700.0;
  o.fy[2][0] = 900.0;
  const double h = 0.01, a = 3.0, mass = o.masses.node[2][0];
  start_velocities(o.state, o.blocks, o.masses, o.fx, o.fy, h, a);
  EXPECT_NEAR(o.state.vx[2][0], 1.0 - 0.5 * h * (700.0 / mass - a), 1e-12);
  EXPECT_NEAR(o.state.vy[2][0], -2.0 - 0.5 * h * (900.0 / mass + 2.0 * a), 1e-12);
}

}  // namespace
}  // namespace edda::leapfrog_test
