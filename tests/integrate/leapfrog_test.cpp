#include "integrate/leapfrog.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "blocks/build_blocks.hpp"

namespace edda::leapfrog_test {
namespace {

struct OneBlock {
  BlockSet blocks;
  State state;
  Nodes fx, fy;
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
  o.state = initial_state(o.blocks, set);
  for (std::size_t k = 0; k < 3; ++k) o.fx[k] = o.fy[k] = {0.0};
  return o;
}

TEST(Leapfrog, UniformAccelerationIsExact) {
  for (MassKind kind : {MassKind::matched, MassKind::covering, MassKind::consistent}) {
    OneBlock o = one_block(kind, {1.0, 2.0});
    for (std::size_t k = 0; k < 3; ++k) o.fy[k][0] = -9.81 * o.blocks.mass[0] / 3.0;
    const double h = 0.01;
    start_velocities(o.state, o.blocks, o.fx, o.fy, h);
    for (int n = 0; n < 100; ++n) advance(o.state, o.blocks, o.fx, o.fy, h, h, {});
    const Vec2 c = centroid(o.state.x, o.state.y, 0);
    EXPECT_NEAR(c.x, 1.0 + 1.0, 1e-12);
    EXPECT_NEAR(c.y, 0.5 + 2.0 - 0.5 * 9.81, 1e-12);
  }
}

TEST(Leapfrog, AChangeOfStepKeepsTheParabola) {
  OneBlock o = one_block();
  for (std::size_t k = 0; k < 3; ++k) o.fy[k][0] = -10.0 * o.blocks.mass[0] / 3.0;
  double h = 0.01, time = 0.0;
  start_velocities(o.state, o.blocks, o.fx, o.fy, h);
  for (int n = 0; n < 60; ++n) {
    const double next = n % 7 == 3 ? 0.5 * h : n % 7 == 6 ? 2.0 * h : h;
    advance(o.state, o.blocks, o.fx, o.fy, h, next, {});
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
  const double start = kinetic_energy(o.blocks, o.state.vx, o.state.vy, 0);
  for (int n = 0; n < 100; ++n) {
    const Nodes vx = o.state.vx, vy = o.state.vy;
    advance(o.state, o.blocks, o.fx, o.fy, h, h, {a, 0.0});
    book_damping(o.state, o.blocks, o.fx, o.fy, vx, vy, h, h, {a, 0.0}, work);
  }
  const double factor = std::pow((1.0 - 0.5 * a * h) / (1.0 + 0.5 * a * h), 100.0);
  EXPECT_NEAR(centroid(o.state.vx, o.state.vy, 0).x, factor, 1e-12);
  const double end = kinetic_energy(o.blocks, o.state.vx, o.state.vy, 0);
  EXPECT_NEAR(work.joules[0] + end, start, 1e-9 * start);
}

TEST(Leapfrog, LocalDampingTakesItsFractionOfTheForce) {
  OneBlock o = one_block(MassKind::matched, {1.0, 0.0});
  for (std::size_t k = 0; k < 3; ++k) o.fx[k][0] = 100.0;
  const double h = 1e-3, before = o.state.vx[0][0];
  advance(o.state, o.blocks, o.fx, o.fy, h, h, {0.0, 0.8});
  EXPECT_NEAR(o.state.vx[0][0] - before, 0.2 * 100.0 * h / o.blocks.node_mass[0][0], 1e-12);
}

TEST(Leapfrog, RetreatBringsBackWhereItWas) {
  OneBlock o = one_block(MassKind::matched, {1.0, -3.0});
  o.fx[1][0] = 5e4;
  const State before = o.state;
  advance(o.state, o.blocks, o.fx, o.fy, 0.01, 0.01, {1.0, 0.5});
  retreat(o.state, o.blocks, 0.01, before.vx, before.vy);
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_NEAR(o.state.x[k][0], before.x[k][0], 1e-15);
    EXPECT_EQ(o.state.vx[k][0], before.vx[k][0]);
  }
}

}  // namespace
}  // namespace edda::leapfrog_test
