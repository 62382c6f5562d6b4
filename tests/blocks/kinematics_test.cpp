// What follows from the nodes of a block by the weights and gradients of all but its first node.
#include "blocks/kinematics.hpp"

#include <gtest/gtest.h>

#include "blocks/build_blocks.hpp"
#include "blocks/edge_forces.hpp"
#include "blocks/pose.hpp"

namespace edda::kinematics_test {
namespace {

/// A block with a skew outline far from the origin, in a cover of each kind.
BlockSet one_block(MassKind kind) {
  Model model;
  model.solver.mass = kind;
  model.materials.push_back({"rock", 1000.0, 1e9, 0.2, {}});
  BlockPolygon p;
  p.rings = {{{100, 50}, {102.3, 50.2}, {102.1, 51.4}, {100.4, 51.1}}};
  p.joint = {std::vector<Index>(4, none)};
  p.material = 0;
  PolygonSet set;
  set.blocks.push_back(p);
  return build_blocks(model, set);
}
constexpr MassKind kinds[] = {MassKind::matched, MassKind::covering, MassKind::consistent};

/// F = I + H at the node X is X + H X + c.
constexpr Deformation gain{0.03, -0.2, 0.11, 0.07};
constexpr Vec2 shift{0.4, -0.9};
Vec2 moved_by(Vec2 x) {
  return {gain.xx * x.x + gain.xy * x.y + shift.x, gain.yx * x.x + gain.yy * x.y + shift.y};
}
NodeVectors nodes_of(const BlockSet& b) {
  return vectors_of(b.node_x, b.node_y, 0);
}
NodeVectors affine(const BlockSet& b) {
  NodeVectors u = nodes_of(b);
  for (Vec2& of_node : u) of_node = moved_by(of_node);
  return u;
}

TEST(Kinematics, GradientOfAnAffineMotion) {
  for (const MassKind kind : kinds) {
    const BlockSet b = one_block(kind);
    const Deformation h = gradient_of(b, affine(b), 0);
    EXPECT_NEAR(h.xx, gain.xx, 1e-12);
    EXPECT_NEAR(h.xy, gain.xy, 1e-12);
    EXPECT_NEAR(h.yx, gain.yx, 1e-12);
    EXPECT_NEAR(h.yy, gain.yy, 1e-12);
  }
}

/// A motion as a whole has none to the last digit, wherever the block is.
TEST(Kinematics, NoGradientWithoutDeformation) {
  const BlockSet b = one_block(MassKind::matched);
  const Deformation h = gradient_of(b, at_every_node({0.1, -1e5}), 0);
  EXPECT_EQ(h.xx, 0.0);
  EXPECT_EQ(h.xy, 0.0);
  EXPECT_EQ(h.yx, 0.0);
  EXPECT_EQ(h.yy, 0.0);
}

/// sum f_k . u_k = factor P : L, and no resultant.
TEST(Kinematics, StressDoesItsWorkOnTheGradient) {
  const Deformation p{3.0, -1.0, 5.0, 2.0};
  constexpr double factor = -0.7;
  for (const MassKind kind : kinds) {
    const BlockSet b = one_block(kind);
    const NodeVectors f = nodal_forces_of(b, p, factor, 0);
    const double work = p.xx * gain.xx + p.xy * gain.xy + p.yx * gain.yx + p.yy * gain.yy;
    EXPECT_NEAR(dot(f, affine(b)), factor * work, 1e-11);
    EXPECT_NEAR(norm(resultant(f)), 0.0, 1e-14);
  }
}

TEST(Kinematics, VerticesAreWhereTheirWeightsSay) {
  for (const MassKind kind : kinds) {
    const BlockSet b = one_block(kind);
    Nodes x = zero_nodes(1), y = x;
    store(nodes_of(b) + affine(b), x, y, 0);
    Pose pose{b.vertex_x, b.vertex_y, b.vertex_x, b.vertex_y};
    State state;
    state.position.x = x;
    state.position.y = y;
    state.position.modes.assign(b.bending.modes(), 0.0);
    const double farthest = place_next(b, state, pose, 0, 1);
    double expected = 0.0;
    for (Id v = 0; v < 4; ++v) {
      EXPECT_EQ(b.weight[0][v], 1.0 - b.weight[1][v] - b.weight[2][v]);
      const Vec2 moved = moved_by(b.vertex(v));
      EXPECT_NEAR(pose.x1[v], b.vertex_x[v] + moved.x, 1e-11);
      EXPECT_NEAR(pose.y1[v], b.vertex_y[v] + moved.y, 1e-11);
      expected = std::max(expected, dot(moved, moved));
    }
    EXPECT_NEAR(farthest, expected, 1e-9 * expected);
    std::vector<double> px(4), py(4);
    place_vertices(b, state.position, 0, px, py);
    EXPECT_EQ(px, pose.x1);
    EXPECT_EQ(py, pose.y1);
  }
}

/// The nodal forces do the work that the forces on edges do on the vertices.
TEST(Kinematics, ForcesOnEdgesDoTheirWorkOnTheNodes) {
  const Four forces[2] = {{3.0, -2.0, 1.0, 4.0}, {-5.0, 1.0, 2.0, -7.0}};
  constexpr Id edges[2] = {1, 3};
  for (const MassKind kind : kinds) {
    const BlockSet b = one_block(kind);
    BodyVectors forces_on = zero_vectors(b);
    const EdgeForcesView view = edge_forces_view(b, forces_on);
    EdgeForces on(view, 0);
    double work = 0.0;
    Vec2 sum;
    for (std::size_t q = 0; q < 2; ++q) {
      const Id e = edges[q], to = b.next[e];
      on.set(e, forces[q]);
      const Vec2 at_start{forces[q][0], forces[q][1]}, at_end{forces[q][2], forces[q][3]};
      work += dot(at_start, moved_by(b.vertex(e))) + dot(at_end, moved_by(b.vertex(to)));
      sum += at_start + at_end;
    }
    for (const Id e : {0u, 2u}) on.set_none(e);
    on.store();
    const NodeVectors f = vectors_of(forces_on, 0);
    EXPECT_NEAR(dot(f, affine(b)), work, 1e-10);
    EXPECT_NEAR(norm(resultant(f) - sum), 0.0, 1e-13);
  }
}

}  // namespace
}  // namespace edda::kinematics_test
