// Blocks that are meshed: the mass matrix of their nodes, and points of them.
#include "blocks/meshes.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "attachments/drawn_blocks.hpp"
#include "base/polygon.hpp"
#include "blocks/block_point.hpp"
#include "blocks/kinematics.hpp"
#include "cutting/t_nodes.hpp"
#include "cutting/zone_size.hpp"

namespace edda::meshes_test {
namespace {

/// A pentagon, meshed, beside a square that bends.
struct Meshed : test::DrawnBlocks {
  explicit Meshed(double size = 0.35) {
    add({{0, 0}, {1.2, -0.1}, {1.7, 0.8}, {0.6, 1.5}, {-0.3, 0.7}});
    add({{3, 0}, {4, 0}, {4, 1}, {3, 1}});
    for (const char* name : {"rock", "other"})
      model.materials.push_back({name, 2600.0, 1e9, 0.2, {}});
    model.materials[0].deformation = BlockDeformation::zones;
    model.materials[0].zone_size = size;
    set.blocks[1].material = 1;
    const ZoneSizes sizes(model, set);
    divide_edges(set.blocks[0], [of = sizes.of(set.blocks[0])](Vec2 from, Vec2 to) {
      return divisions(from, to, of);
    });
    blocks = build_blocks(model, set);
    masses = given_masses(blocks);
  }
  std::size_t many() const { return blocks.meshes.nodes_of(0); }
  Vec2 arm(std::size_t j) const { return {blocks.meshes.arm_x[j], blocks.meshes.arm_y[j]}; }
  /// Random forces on the mesh nodes of block 0, with what its three nodes have of them.
  BodyVector forces(unsigned seed) const {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> any(-1e3, 1e3);
    BodyVector f(many());
    for (std::size_t j = 0; j < many(); ++j) put(f, j, {any(random), any(random)});
    return f;
  }
  void put(BodyVector& f, std::size_t j, Vec2 force) const {
    const Vec2 at = arm(j) + Vec2{blocks.centroid_x[0], blocks.centroid_y[0]};
    f.modes.set(j, f.modes[j] + force);
    spread(f.nodes, weights_at(blocks, 0, at), force);
  }
  /// Acceleration of mesh node j.
  Vec2 at_node(const BodyVector& a, std::size_t j) const {
    const Vec2 at = arm(j) + Vec2{blocks.centroid_x[0], blocks.centroid_y[0]};
    return weighted(weights_at(blocks, 0, at), a.nodes) + a.modes[j];
  }
};

TEST(Meshes, CoverTheBlock) {
  const Meshed o;
  EXPECT_TRUE(o.blocks.is_meshed(0));
  EXPECT_FALSE(o.blocks.bends(0));
  EXPECT_TRUE(o.blocks.bends(1));
  EXPECT_GT(o.many(), o.blocks.vertex_begin[1]);
  EXPECT_GT(Meshed(0.1).many(), 4 * o.many());
  double sum = 0.0;
  for (const double share : o.blocks.meshes.share) sum += share;
  EXPECT_NEAR(sum, 1.0, 1e-12);
  for (Id v = 0; v < o.blocks.vertex_begin[1]; ++v)
    EXPECT_NEAR(
        norm(o.arm(v) + Vec2{o.blocks.centroid_x[0], o.blocks.centroid_y[0]} - o.blocks.vertex(v)),
        0.0, 1e-12);
}

/// Rigid motion has the block's exact inertia: a resultant moves the centroid, a moment turns it.
TEST(Meshes, TurnWithTheRightInertia) {
  const Meshed o;
  const BodyVector f = o.forces(1);
  const BodyVector a = accelerations(o.masses, o.blocks, 0, f);
  Vec2 force;
  double moment = 0.0;
  for (std::size_t j = 0; j < o.many(); ++j) {
    force += f.modes[j];
    moment += cross(o.arm(j), f.modes[j]);
  }
  EXPECT_NEAR(norm(resultant(a.nodes) / nodes_per_block - force / o.blocks.mass[0]), 0.0, 1e-9);
  const Moments m = moments(o.set.blocks[0].rings);
  const Deformation l = gradient_of(o.blocks, a.nodes, 0);
  // d/dt of the angular momentum rho int x x a of the affine part.
  const double rate =
      o.blocks.mass[0] / m.area * (m.sxx * l.yx + m.sxy * (l.yy - l.xx) - m.syy * l.xy);
  EXPECT_NEAR(rate, moment, 1e-9 * std::abs(moment));
}

/// The deviations have none of it: sum_j m_j P_j d_j'' = 0.
TEST(Meshes, DeviationsHaveNoAffinePart) {
  const Meshed o;
  const BodyVector a = accelerations(o.masses, o.blocks, 0, o.forces(2));
  AffinePart sum;
  for (std::size_t j = 0; j < o.many(); ++j)
    o.blocks.meshes.add(sum, j, o.blocks.meshes.share[j] * a.modes[j]);
  EXPECT_NEAR(norm(sum.one) + norm(sum.x) + norm(sum.y), 0.0, 1e-11);
}

/// The mass matrix is symmetric, and its product the inverse of the accelerations.
TEST(Meshes, MassesAndAccelerationsBelongTogether) {
  const Meshed o;
  const BodyVector f = o.forces(3), g = o.forces(4);
  const BodyVector a = accelerations(o.masses, o.blocks, 0, f),
                   b = accelerations(o.masses, o.blocks, 0, g);
  EXPECT_NEAR(dot(a, g), dot(b, f), 1e-9 * std::abs(dot(a, g)));
  EXPECT_NEAR(mass_product(o.masses, o.blocks, 0, a, b), dot(a, g), 1e-9 * std::abs(dot(a, g)));
}

/// How much a corner gives way to a unit force on it, or on the next.
TEST(Meshes, InverseMassesOfCorners) {
  const Meshed o;
  for (const Id v : {Id{0}, Id{3}}) {
    BodyVector f(o.many());
    o.put(f, v, {1.0, 0.0});
    const BodyVector a = accelerations(o.masses, o.blocks, 0, f);
    EXPECT_NEAR(o.masses.point_inverse[v], o.at_node(a, v).x, 1e-12);
    EXPECT_NEAR(o.masses.edge_inverse[v], o.at_node(a, o.blocks.next[v]).x, 1e-12);
    EXPECT_NEAR(o.at_node(a, v).y, 0.0, 1e-15);
  }
}

/// M^-1 = M_L^-1 + P Q P^T.
TEST(Meshes, AccelerateBesideTheirLumpedMasses) {
  const Meshed o(0.6);
  const Vec2 force{4e3, -7e3};
  const std::size_t at = 3;
  BodyVector f(o.many());
  o.put(f, at, force);
  const BodyVector a = accelerations(o.masses, o.blocks, 0, f);
  const AffineMotion affine = affine_motion(o.blocks, a.nodes, 0);
  AffinePart part;
  o.blocks.meshes.add(part, at, force);
  const AffinePart beside = beside_lumped(o.masses, o.blocks, 0, part);
  for (std::size_t j = 0; j < o.many(); ++j) {
    Vec2 expected = o.blocks.meshes.at(beside, j);
    if (j == at) expected += force / (o.blocks.meshes.share[j] * o.blocks.mass[0]);
    EXPECT_NEAR(norm(affine.of(o.arm(j).x, o.arm(j).y) + a.modes[j] - expected), 0.0,
                1e-9 * norm(expected));
  }
}

/// Unbalanced forces are masses times accelerations of the nodes; of a block without a mesh, its
/// resultant.
TEST(Meshes, UnbalancedForcesAreThoseOfTheNodes) {
  const Meshed o;
  BodyVectors all = zero_vectors(o.blocks);
  const BodyVector f = o.forces(5);
  store(f, o.blocks, all, 0);
  const BodyVector a = accelerations(o.masses, o.blocks, 0, f);
  double sum = 0.0;
  for (std::size_t j = 0; j < o.many(); ++j)
    sum += o.blocks.mass[0] * o.blocks.meshes.share[j] * norm(o.at_node(a, j));
  const Unbalanced u = unbalanced_forces(o.masses, o.blocks, all, 0);
  EXPECT_EQ(u.count, o.many());
  EXPECT_NEAR(u.sum, sum, 1e-9 * sum);
  store(at_every_node({1.0, 2.0}), all, 1);
  EXPECT_NEAR(unbalanced_forces(o.masses, o.blocks, all, 1).sum, 3.0 * std::sqrt(5.0), 1e-12);
  EXPECT_EQ(unbalanced_forces(o.masses, o.blocks, all, 1).count, 1u);
}

/// Vectors of one block, with thousands of modes or few, are those of the block alone.
TEST(Meshes, VectorsOfABlock) {
  const Meshed o(0.1);
  ASSERT_GT(o.many(), most_modes);
  const std::size_t last = o.many() - 1;
  BodyVectors all = zero_vectors(o.blocks);
  ASSERT_GT(all.modes.size(), o.many());
  const BodyVector f = o.forces(6);
  store(f, o.blocks, all, 0);
  BodyVector g(1);
  g.modes.set(0, {5.0, 6.0});
  store(g, o.blocks, all, 1);
  for (std::size_t j = 0; j < o.many(); ++j)
    EXPECT_EQ(vector_of(o.blocks, all, 0).modes[j], f.modes[j]);
  EXPECT_EQ(vector_of(o.blocks, all, 1).modes[0], (Vec2{5.0, 6.0}));
  const BodyVector twice = 2.0 * f - f / 2.0;
  EXPECT_NEAR(norm(twice.modes[last] - 1.5 * f.modes[last]), 0.0, 1e-12);
  set_zero(o.blocks, all, 0);
  EXPECT_EQ(vector_of(o.blocks, all, 0).modes[last], Vec2{});
  EXPECT_EQ(vector_of(o.blocks, all, 1).modes[0], (Vec2{5.0, 6.0}));
}

/// A point follows the corners of its zone: with deviations that are linear over the block it moves
/// linearly, too.
TEST(Meshes, PointsFollowTheirZone) {
  const Meshed o;
  BodyVectors u = zero_vectors(o.blocks);
  const auto linear = [](Vec2 p) { return Vec2{1.0 + 2.0 * p.x - p.y, 3.0 * p.x + 0.5 * p.y}; };
  BodyVector v(o.many());
  for (std::size_t j = 0; j < o.many(); ++j) v.modes.set(j, linear(o.arm(j)));
  store(v, o.blocks, u, 0);
  const Vec2 centre{o.blocks.centroid_x[0], o.blocks.centroid_y[0]};
  for (const Vec2 p : {Vec2{0.3, 0.4}, Vec2{0.8, 0.1}, Vec2{-0.2, 0.6}, Vec2{0.6, -0.05}})
    EXPECT_NEAR(norm(at_point(o.blocks, u, block_point(o.blocks, 0, p)) - linear(p - centre)), 0.0,
                1e-12);
}

}  // namespace
}  // namespace edda::meshes_test
