#include "blocks/masses.hpp"

#include <gtest/gtest.h>

#include "blocks/build_blocks.hpp"
#include "blocks/kinematics.hpp"

namespace edda::masses_test {
namespace {

constexpr MassKind kinds[] = {MassKind::matched, MassKind::covering, MassKind::consistent};

/// A block of 2 m x 1 m.
struct OneBlock {
  BlockSet blocks;
  Masses masses;
  State state;

  explicit OneBlock(MassKind kind, Vec2 velocity = {}, double spin = 0.0) {
    Model model;
    model.solver.mass = kind;
    model.materials.push_back({"rock", 1000.0, 1e9, 0.2, {}});
    BlockPolygon p;
    p.rings = {{{0, 0}, {2, 0}, {2, 1}, {0, 1}}};
    p.joint = {std::vector<Index>(4, none)};
    p.material = 0;
    p.velocity = velocity;
    p.angular_velocity = spin;
    PolygonSet set;
    set.blocks.push_back(p);
    blocks = build_blocks(model, set);
    masses = given_masses(blocks);
    state = initial_state(blocks, set);
  }
};

/// Of a rigid motion, m v^2/2 + I w^2/2; the masses of `covering` turn with more.
TEST(Masses, KineticEnergyOfARigidMotion) {
  const double spin = 3.0;
  for (const MassKind kind : kinds) {
    const OneBlock o(kind, {1.0, -2.0}, spin);
    const double mass = o.blocks.mass[0], exact = 0.5 * mass * (4.0 + 1.0) / 12.0 * spin * spin;
    const double turning =
        kinetic_energy(o.masses, o.blocks, o.state.velocity, 0) - 0.5 * mass * 5.0;
    if (kind == MassKind::covering) {
      EXPECT_GT(turning, exact);
    } else {
      EXPECT_NEAR(turning, exact, 1e-9 * exact);
    }
  }
}

/// M a = f, by the work of both over any motion.
TEST(Masses, AccelerationsBalanceTheForces) {
  const NodeVectors f{Vec2{5e4, -2e4}, Vec2{1e4, 3e4}, Vec2{-7e4, 4e4}},
      v{Vec2{0.3, 1.1}, Vec2{-0.7, 0.2}, Vec2{0.5, -0.9}};
  for (const MassKind kind : kinds) {
    const OneBlock o(kind);
    const NodeVectors a = accelerations(o.masses, 0, f);
    EXPECT_NEAR(mass_product(o.masses, 0, a, v), dot(f, v), 1e-9 * dot(f, f) / norm(f[0]));
    const Vec2 whole = resultant(f) / inertia_of(o.masses, 0), mean = weighted(centroid_weights, a);
    EXPECT_NEAR(mean.x, whole.x, 1e-12 * norm(f[0]));
    EXPECT_NEAR(mean.y, whole.y, 1e-12 * norm(f[0]));
  }
}

/// A force does the same work at its point as its parts do on the nodes.
TEST(Nodes, SpreadForcesDoTheSameWork) {
  const OneBlock o(MassKind::matched, {1.0, -2.0}, 3.0);
  const NodeVectors v = vectors_of(o.state.velocity, 0);
  const NodeWeights w = weights_between(o.blocks, 1, 2, 0.25);
  const Vec2 force{3.0, -4.0}, at{2.0, 0.25}, centre{1.0, 0.5};
  NodeVectors f{};
  spread(f, w, force, 2.0);
  const Vec2 velocity = Vec2{1.0, -2.0} + 3.0 * perp(at - centre);
  EXPECT_NEAR(norm(weighted(w, v) - velocity), 0.0, 1e-12);
  EXPECT_NEAR(norm(resultant(f) - 2.0 * force), 0.0, 1e-12);
  EXPECT_NEAR(dot(f, v), 2.0 * dot(force, velocity), 1e-11);
  EXPECT_TRUE(is_finite(o.blocks, o.state.velocity, 0));
}

}  // namespace
}  // namespace edda::masses_test
